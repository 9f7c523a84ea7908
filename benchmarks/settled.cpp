#include "settled.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <memory>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/assemble.hpp"
#include "jostle/simulation/start.hpp"

using namespace jostle;

namespace {

Scene scene_of(const Crowd& crowd) {
    Scene scene;
    scene.seed = 1;
    scene.box.volume_fraction = crowd.volume_fraction;
    scene.rods.count = crowd_count;
    scene.rods.length = crowd.length;
    scene.time.rms_step = crowd_rms_step;
    scene.time.production = 1.0;
    return scene;
}

std::unique_ptr<Simulation> made(const Crowd& crowd) {
    const Scene scene = scene_of(crowd);
    const double volume =
        static_cast<double>(crowd_count) * rod_volume(crowd.length, scene.rods.diameter) / crowd.volume_fraction;
    const double edge = std::cbrt(volume);
    const Box box{{edge, edge, edge}};
    auto simulation = std::make_unique<Simulation>(assemble(scene, box, make_start(scene, box), {}));
    for (int k = 0; k < settling_steps; ++k) {
        if (simulation->step().status == LcpStatus::converged) continue;
        fmt::print(stderr, "{}: a settling step was not solved\n", name_of(crowd));
        std::exit(1);
    }
    return simulation;
}

}  // namespace

std::vector<Crowd> all_crowds() {
    std::vector<Crowd> crowds;
    for (const double length : {5.0, 0.0})
        for (const double volume_fraction : {0.05, 0.2, 0.4}) crowds.push_back({length, volume_fraction});
    return crowds;
}

std::string name_of(const Crowd& crowd) {
    return fmt::format("{}/{:.2f}", crowd.length > 0.0 ? "rods" : "spheres", crowd.volume_fraction);
}

Simulation& settled(const Crowd& crowd) {
    static std::map<std::string, std::unique_ptr<Simulation>> simulations;
    parallel::set_thread_count(1);
    auto& simulation = simulations[name_of(crowd)];
    if (!simulation) simulation = made(crowd);
    return *simulation;
}
