#include <cstdio>
#include <memory>

#include "constant_force.hpp"  // from docs/guide/extending.md
#include "free_draining.hpp"   // from there, too
#include "jostle/setup/assemble.hpp"

using namespace jostle;

namespace {

void drag(Simulation& simulation) {
    simulation.add(std::make_unique<ConstantForce>(Vec3{3, 0, 0}));
    for (int step = 0; step < 10; ++step) simulation.step();
    for (const Vec3& centre : simulation.rods().centre) std::printf("%.17g ", centre.x - 2.0);
}

}  // namespace

// A sphere and a rod of L/D = 1, far apart, that a force of 3 drags along x without noise: how far they go in a time of
// 1, for viscosity 1, with the mobility of the scene and with that of the guide.
int main() {
    Scene scene;
    scene.motion.brownian = false;
    scene.time.step = 0.1;
    Rods rods;
    rods.push_back(0, {2, 2, 2}, {0, 0, 1}, 0.0, 1.0);
    rods.push_back(1, {2, 8, 8}, {1, 0, 0}, 1.0, 1.0);
    const State state{Box({10, 10, 10}), rods};
    Simulation of_the_scene = assemble(scene, state);
    Simulation of_the_guide(state, free_draining(), {}, of_the_scene.settings());
    drag(of_the_scene);
    drag(of_the_guide);
}
