#include "settled.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <stdexcept>

#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

struct Assembly {
    Box box;
    Rods rods;
};

Scene scene_of(const Crowd& crowd) {
    Scene scene;
    if (crowd.in_fluid) {
        scene.mobility.model = MobilityModel::hydrodynamic;
        scene.solver.tolerance = 1e-4;  // as docs/guide/hydrodynamics.md advises
    }
    scene.seed = 1;
    scene.box.volume_fraction = crowd.volume_fraction;
    scene.rods.count = settled_count;
    scene.rods.length = crowd.length;
    scene.rods.start = crowd.start;
    scene.rods.axis = {0, 0, 1};
    scene.time.rms_step = rms_step;
    scene.time.production = 1.0;
    if (crowd.self_propulsion > 0.0) {
        Rods one;
        one.push_back(0, {}, {1, 0, 0}, crowd.length, 1.0);
        scene.motion.self_propulsion = crowd.self_propulsion * make_mobility(scene)->at(one, {})->of_rod(0).parallel;
    }
    return scene;
}

Simulation simulation_of(const Scene& scene, Assembly assembly, Clock clock) {
    return assemble(scene, {assembly.box, std::move(assembly.rods), clock});
}

const Assembly& settled_assembly(const Crowd& crowd) {
    static std::map<std::string, Assembly> assemblies;
    const auto found = assemblies.find(crowd.name);
    if (found != assemblies.end()) return found->second;
    Scene scene = scene_of(crowd);
    scene.mobility.model = MobilityModel::capsule;  // where rods are in equilibrium does not depend on the fluid
    const double edge =
        std::cbrt(static_cast<double>(settled_count) * rod_volume(crowd.length, 1.0) / crowd.volume_fraction);
    const Box box{{edge, edge, edge}};
    Simulation simulation = simulation_of(scene, {box, make_start(scene, box)}, {});
    for (int k = 0; k < crowd.settling_steps; ++k) {
        const StepReport report = simulation.step();
        if (report.status == LcpStatus::converged) continue;
        fmt::print(stderr, "{}: settling step {} was not solved: residual {:.2g} after {} iterations, overlap {:.2g}\n",
                   crowd.name, k, report.residual, report.iterations, report.max_overlap);
        std::exit(1);
    }
    return assemblies[crowd.name] = {box, simulation.rods()};
}

/// The largest divisor of `number` that is not above `limit`.
std::uint64_t largest_divisor(std::uint64_t number, double limit) {
    std::uint64_t largest = 1;
    for (std::uint64_t divisor = 2; static_cast<double>(divisor) <= limit + 1e-9; ++divisor)
        if (number % divisor == 0) largest = divisor;
    return largest;
}

/// Copies side by side, that many times: along x, y and z as evenly as the number divides.
Assembly copied(const Assembly& one, std::uint64_t times) {
    const std::uint64_t along_x = largest_divisor(times, std::cbrt(static_cast<double>(times)));
    const std::uint64_t in_layer = times / along_x;
    const std::uint64_t along_y = largest_divisor(in_layer, std::sqrt(static_cast<double>(in_layer)));
    const std::uint64_t along_z = in_layer / along_y;
    Assembly all{Box(one.box.displacement({static_cast<std::int32_t>(along_x), static_cast<std::int32_t>(along_y),
                                           static_cast<std::int32_t>(along_z)}),
                     one.box.periodic()),
                 {}};
    for (std::uint64_t x = 0; x < along_x; ++x)
        for (std::uint64_t y = 0; y < along_y; ++y)
            for (std::uint64_t z = 0; z < along_z; ++z) {
                const Vec3 offset = one.box.displacement(
                    {static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), static_cast<std::int32_t>(z)});
                for (std::size_t i = 0; i < one.rods.size(); ++i)
                    all.rods.push_back(all.rods.size(), one.rods.centre[i] + offset, one.rods.axis[i],
                                       one.rods.length[i], one.rods.diameter[i]);
            }
    return all;
}

}  // namespace

const std::vector<Crowd>& all_crowds() {
    using enum StartKind;
    static const std::vector<Crowd> crowds = {
        {"rods/0.05", 5.0, 0.05, random, 0.0, 1000},     {"rods/0.10", 5.0, 0.10, random, 0.0, 1000},
        {"rods/0.20", 5.0, 0.20, random, 0.0, 1000},     {"rods/0.30", 5.0, 0.30, random, 0.0, 1000},
        {"rods/0.40", 5.0, 0.40, random, 0.0, 1000},     {"rods/nematic", 5.0, 0.55, lattice, 0.0, 1000},
        {"rods/active", 5.0, 0.30, random, 300.0, 3000}, {"spheres/0.05", 0.0, 0.05, random, 0.0, 1000},
        {"spheres/0.20", 0.0, 0.20, random, 0.0, 1000},  {"spheres/0.40", 0.0, 0.40, random, 0.0, 1000},
        {"spheres/0.60", 0.0, 0.60, random, 0.0, 200},   {"spheres/0.63", 0.0, 0.63, random, 0.0, 100},
    };
    return crowds;
}

const std::vector<Crowd>& crowds_in_fluid() {
    using enum StartKind;
    static const std::vector<Crowd> crowds = {
        {"fluid/rods/0.10", 5.0, 0.10, random, 0.0, 1000, true},
        {"fluid/rods/0.40", 5.0, 0.40, random, 0.0, 1000, true},
        {"fluid/spheres/0.10", 0.0, 0.10, random, 0.0, 1000, true},
    };
    return crowds;
}

const Crowd& crowd_named(const std::string& name) {
    for (const std::vector<Crowd>* crowds : {&all_crowds(), &crowds_in_fluid()})
        for (const Crowd& crowd : *crowds)
            if (crowd.name == name) return crowd;
    throw std::out_of_range("no state of the name " + name);
}

std::unique_ptr<Simulation> settled(const Crowd& crowd, std::uint64_t count) {
    const std::uint64_t times = (count + settled_count - 1) / settled_count;
    return std::make_unique<Simulation>(simulation_of(scene_of(crowd), copied(settled_assembly(crowd), times), {}));
}

std::unique_ptr<Simulation> continued(const Crowd& crowd, const Simulation& from, const SolvedBy& how) {
    Scene scene = scene_of(crowd);
    scene.solver.method = how.method;
    scene.solver.tolerance = how.tolerance;
    scene.solver.max_iterations = 20000;
    scene.contact.brownian_correction = how.contacts == ContactKind::compliant;
    if (how.range > 0.0) scene.contact.range = how.range;
    return std::make_unique<Simulation>(simulation_of(scene, {from.box(), from.rods()}, from.clock()));
}
