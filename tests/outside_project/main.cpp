#include <cstdio>

#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/stress/rigid_body_stress.hpp"
#include "jostle/stress/shape_moments.hpp"

// The stress of two boxes that meet with friction; and, where a scene is named, that of its first step.
int main(int count, char** arguments) {
    using namespace jostle;
    const RigidBody box = rigid_body(box_moments({1.0, 2.0, 3.0})), other = {{1.0, 0.2, 0.0}, box.second_moment};
    const PairStress stress = pair_stress(box, other, {0.5, 0.3, 0.1}, {-0.5, 0.1, 0.1}, {2.0, 1.0, 0.0});
    for (const double element : stress.total().m) std::printf("%.17g ", element);
    if (count < 2) return 0;
    const Scene scene = read_scene(arguments[1]);
    const StepReport report = assemble(scene, beginning_of(scene, arguments[1]).state).step();
    for (const double element : report.collision_virial.m) std::printf("%.17g ", element);
}
