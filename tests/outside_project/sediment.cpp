#include <cstdio>
#include <memory>

#include "constant_force.hpp"  // from docs/guide/extending.md
#include "jostle/setup/assemble.hpp"

// Two spheres, far apart, that a force of 3 drags along x without noise: how far they go in a time of 1, for
// viscosity 1.
int main() {
    using namespace jostle;
    Scene scene;
    scene.motion.brownian = false;
    scene.time.step = 0.1;
    Rods rods;
    rods.push_back(0, {2, 2, 2}, {0, 0, 1}, 0.0, 1.0);
    rods.push_back(1, {2, 8, 8}, {1, 0, 0}, 0.0, 1.0);
    Simulation simulation = assemble(scene, {Box{{10, 10, 10}, {true, true, true}}, rods});
    simulation.add(std::make_unique<ConstantForce>(Vec3{3, 0, 0}));
    for (int step = 0; step < 10; ++step) simulation.step();
    for (const Vec3& centre : simulation.rods().centre) std::printf("%.17g ", centre.x - 2.0);
}
