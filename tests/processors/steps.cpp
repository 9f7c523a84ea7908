// Prints every bit of some steps of rods that swim, tumble and collide: tests/processors/test_processor_families.cpp.

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

int main() try {
    parallel::set_thread_count(1);
    Scene scene;
    scene.seed = 3;
    scene.box.volume_fraction = 0.35;
    scene.rods.count = 300;
    scene.rods.length = 3.0;
    scene.time.rms_step = 0.05;
    scene.time.production = 1.0;
    scene.motion.self_propulsion = 20.0;
    scene.motion.tumble_rate = 2.0;
    const Box box{box_edges(scene)};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    for (int k = 0; k < 100; ++k) {
        const StepReport report = simulation.step();
        const Mat3& virial = report.collision_virial;
        fmt::print("{} {} {} {:a} {:a} {:a}\n", k, report.iterations, report.contacts, virial(0, 0), virial(1, 2),
                   report.residual);
    }
    const Rods& rods = simulation.rods();
    for (std::size_t i = 0; i < rods.size(); ++i)
        for (const Vec3& vector : {rods.centre[i], rods.axis[i]})
            fmt::print("{:a} {:a} {:a}\n", vector.x, vector.y, vector.z);
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "steps: {}\n", error.what());
    return 1;
}
