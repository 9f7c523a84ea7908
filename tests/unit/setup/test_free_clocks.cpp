// Clocks of rods alone, and how much a crowd slows them, against hand calculations and measured decays.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "jostle/scene/scene_walls.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/free_clocks.hpp"

using namespace jostle;

namespace {

FreeClocks clocks_of(const Scene& scene, double length) {
    Rods rods;
    rods.push_back(0, {}, {1, 0, 0}, length, 1.0);
    return free_clocks(scene, *make_mobility(scene)->at(rods, {}), rods, {}, 0.1);
}

}  // namespace

TEST_CASE("a sphere diffuses by Stokes and Einstein, and does not turn") {
    const FreeClocks clocks = clocks_of(Scene{}, 0.0);
    CHECK(clocks.rotation == 0.0);
    CHECK(clocks.diffusion == doctest::Approx(3.0 * std::numbers::pi));  // D^2 3 pi mu D/kT
}

TEST_CASE("a rod turns in 1/(2 D_R); tumbles turn it, too; without noise nothing does") {
    Scene scene;
    Rods rods;
    rods.push_back(0, {}, {1, 0, 0}, 5.0, 1.0);
    const double alone = 0.5 / make_mobility(scene)->at(rods, {})->of_rod(0).rotational;
    CHECK(clocks_of(scene, 5.0).rotation == doctest::Approx(alone));
    scene.motion.self_propulsion = 1.0;
    scene.motion.tumble_rate = 1.0 / alone;
    CHECK(clocks_of(scene, 5.0).rotation == doctest::Approx(0.5 * alone));
    scene = {};
    scene.motion.brownian = false;
    CHECK(clocks_of(scene, 5.0).rotation == 0.0);
    CHECK(clocks_of(scene, 5.0).diffusion == 0.0);
}

TEST_CASE("two rods pass each other in L^2/(4 D_t), swimmers by how far they swim, too") {
    Scene scene;
    CHECK(clocks_of(scene, 0.0).passing == 0.0);
    const double alone = clocks_of(scene, 5.0).diffusion * 25.0 / 4.0;  // of D^2/D_t
    CHECK(clocks_of(scene, 5.0).passing == doctest::Approx(alone));
    scene.motion.self_propulsion = 1.0;
    const double by_swimming = clocks_of(scene, 5.0).rotation / 3.0;  // U^2 t_p/3, t_p = 1/(2 D_R)
    CHECK(clocks_of(scene, 5.0).passing == doctest::Approx(1.0 / (1.0 / alone + 4.0 * by_swimming / 25.0)));
    scene.motion.brownian = false;
    CHECK(clocks_of(scene, 5.0).passing == 0.0);
}

TEST_CASE("the clocks know how dense rods are, by their mean L/D") {
    Scene scene;
    Rods rods;
    for (std::uint64_t id : {0, 1}) rods.push_back(id, {}, {1, 0, 0}, 5.0, 1.0);
    const auto slowdown = [&] {
        return free_clocks(scene, *make_mobility(scene)->at(rods, {}), rods, {}, 0.46).slowdown;
    };
    CHECK(slowdown() == crowding_slowdown(0.46, 5.0, 3));
    rods.length = {4.5, 5.5};
    CHECK(slowdown() == crowding_slowdown(0.46, 5.0, 3));
    scene.growth.rate = 0.1;  // of cells nothing is judged
    CHECK(slowdown() == 1.0);
}

TEST_CASE("a crowd slows its rods: within a factor of two of measured decays of the order tensor") {
    CHECK(crowding_slowdown(0.0, 5.0, 3) == doctest::Approx(1.0));
    const auto within_two = [](double estimate, double measured) {
        return estimate < 2.0 * measured && estimate > 0.5 * measured;
    };
    // 1/(6 D_R) alone: 11.7, 29.4 and 128 kT^-1 D^3 mu for L/D = 3, 5 and 10; measured 27.5, 209, 56, 380 to 470, 490
    // to 660.
    CHECK(within_two(crowding_slowdown(0.3, 3.0, 3), 2.34));
    CHECK(within_two(crowding_slowdown(0.5, 3.0, 3), 17.8));
    CHECK(within_two(crowding_slowdown(0.2, 5.0, 3), 1.9));
    CHECK(within_two(crowding_slowdown(0.35, 5.0, 3), 14.8));
    CHECK(within_two(crowding_slowdown(0.2, 10.0, 3), 4.5));
    // Of S about its mean in a nematic, from 24 runs together: 190 +- 20.
    CHECK(within_two(crowding_slowdown(0.46, 5.0, 3), 7.4));
    CHECK(crowding_slowdown(0.2, 0.0, 3) < 2.0);
    for (const double phi : {0.1, 0.3, 0.5, 0.7, 0.9})
        for (const double ratio : {0.0, 1.0, 5.0, 20.0, 100.0}) {
            CHECK(crowding_slowdown(phi, ratio, 3) >= 1.0);
            CHECK(crowding_slowdown(phi, ratio, 3) <= 100.0);
        }
}

TEST_CASE("between walls spheres spread in H^2/(pi^2 D_c), or sink in H/(mu f)") {
    Scene scene;
    scene.walls.faces = {false, false, true};
    Rods rods;
    rods.push_back(0, {}, {1, 0, 0}, 0.0, 1.0);
    const Box box({10, 10, 20}, {true, true, false}, scene_walls(scene));
    const auto time = [&](double phi) {
        return free_clocks(scene, *make_mobility(scene)->at(rods, {}), rods, box, phi).spreading;
    };
    const double alone = 400.0 * 3.0 / std::numbers::pi;  // H^2/(pi^2 D), D = 1/(3 pi)
    CHECK(time(0.0) == doctest::Approx(alone));
    // d(n Z)/dn = (1 + 4 phi + 4 phi^2 - 4 phi^3 + phi^4)/(1 - phi)^4 = 1.9296/0.4096 at 0.2
    CHECK(time(0.2) == doctest::Approx(alone * 0.4096 / 1.9296));
    scene.forces.on_rods = {5.0, 0.0, -2.0};
    CHECK(time(0.0) == doctest::Approx(20.0 * 3.0 * std::numbers::pi / 2.0));
    scene.motion.brownian = false;
    CHECK(time(0.2) == doctest::Approx(20.0 * 3.0 * std::numbers::pi / 2.0));
    scene.forces.on_rods = {5.0, 0.0, 0.0};
    CHECK(time(0.2) == 0.0);  // nothing moves them across
}

TEST_CASE("a box under pressure relaxes the faster the harder its rods are to compress") {
    Scene scene;
    scene.pressure.external = 2.0;
    scene.pressure.relaxation_time = 30.0;
    Rods rods;
    rods.push_back(0, {}, {1, 0, 0}, 0.0, 1.0);
    const auto mobility = make_mobility(scene)->at(rods, {});
    CHECK(free_clocks(scene, *mobility, rods, {}, 0.2).volume == doctest::Approx(30.0 * 0.4096 / 1.9296));
}

TEST_CASE("the stiffness of spheres is that of the ideal gas and the second virial coefficient where they are few") {
    CHECK(stiffness_of_spheres(0.0, 3) == 1.0);
    CHECK(stiffness_of_spheres(1e-6, 3) == doctest::Approx(1.0 + 8e-6).epsilon(1e-9));  // 1 + 2 B2 n, B2 = 4 v
    CHECK(stiffness_of_spheres(1e-6, 2) == doctest::Approx(1.0 + 4e-6).epsilon(1e-9));  // of discs B2 = 2 a
}

TEST_CASE("swimmers that nothing turns but their neighbours have axes that turn, and no clock for them") {
    Scene scene;
    scene.motion.brownian = false;
    CHECK(!clocks_of(scene, 3.0).axes_turn);
    scene.motion.self_propulsion = 1.0;
    CHECK(clocks_of(scene, 3.0).axes_turn);
    CHECK(clocks_of(scene, 3.0).rotation == 0.0);
    CHECK(!clocks_of(scene, 0.0).axes_turn);  // how spheres lie matters to none
}

TEST_CASE("spheres that swim keep their direction, for ever where nothing turns them") {
    Scene scene;
    scene.motion.brownian = false;
    scene.motion.self_propulsion = 1.0;
    CHECK(std::isinf(clocks_of(scene, 0.0).rotation));
    scene.motion.tumble_rate = 0.01;
    CHECK(clocks_of(scene, 0.0).rotation == doctest::Approx(100.0));
    CHECK(!clocks_of(scene, 0.0).axes_turn);
}

TEST_CASE("reversals turn no axis") {
    Scene scene;
    const double alone = clocks_of(scene, 5.0).rotation;
    scene.motion.self_propulsion = 0.01;
    scene.motion.reversal_rate = 10.0;
    CHECK(clocks_of(scene, 5.0).rotation == doctest::Approx(alone));
}

TEST_CASE("swimmers in an aligning field have to cross its barrier to turn round, other rods not") {
    // The smallest eigenvalues of Smoluchowski's equation, by finite differences, are 1/1.531, 1/4.243 and 1/135.8 of 2
    // D_R at 1, 3 and 8 kT; in the plane 1/1.702, 1/5.968 and 1/314.8 of D_R.
    Scene scene;
    const double alone = clocks_of(scene, 5.0).rotation;
    scene.forces.alignment_energy = 8.0;
    CHECK(clocks_of(scene, 5.0).rotation == doctest::Approx(alone));
    scene.motion.self_propulsion = 1.0;
    for (const auto& [barrier, slower] : {std::pair{1.0, 1.531}, {3.0, 4.243}, {8.0, 135.8}}) {
        scene.forces.alignment_energy = barrier;
        CHECK(clocks_of(scene, 5.0).rotation == doctest::Approx(slower * alone).epsilon(0.09));
    }
    scene.box.dimensions = 2;
    scene.forces.alignment_energy = 0.0;
    const double in_plane = clocks_of(scene, 5.0).rotation;
    for (const auto& [barrier, slower] : {std::pair{1.0, 1.702}, {3.0, 5.968}, {8.0, 314.8}}) {
        scene.forces.alignment_energy = barrier;
        CHECK(clocks_of(scene, 5.0).rotation == doctest::Approx(slower * in_plane).epsilon(0.12));
    }
    scene.forces.alignment_energy = -8.0;  // across the axis: rods go round it
    CHECK(clocks_of(scene, 5.0).rotation == doctest::Approx(in_plane));
}

TEST_CASE("rods of a file or a run may be uneven along a long periodic edge; unequal ones have to change places") {
    Scene scene;
    Rods rods;
    for (std::uint64_t id : {0, 1}) rods.push_back(id, {}, {1, 0, 0}, 0.0, 1.0);
    const auto time = [&] {
        return free_clocks(scene, *make_mobility(scene)->at(rods, {}), rods, Box({5, 5, 200}), 0.2).spreading;
    };
    CHECK(time() == 0.0);
    const double alone = 40000.0 * 3.0 / (4.0 * std::numbers::pi);  // L^2/(4 pi^2 D)
    for (const StartKind start : {StartKind::file, StartKind::run}) {
        scene.rods.start = start;
        CHECK(time() == doctest::Approx(alone * 0.4096 / 1.9296));
    }
    rods.diameter[1] = 0.5;
    CHECK(time() == doctest::Approx(alone));
}

TEST_CASE("a dense crowd is asked for more diffusion times, unless it begins as a lattice") {
    CHECK(diffusion_arrest(0.40, 3) == 1.0);
    CHECK(diffusion_arrest(0.47, 3) == 1.0);
    CHECK(diffusion_arrest(0.55, 3) > 4.0);
    CHECK(diffusion_arrest(0.60, 3) > 100.0);
    CHECK(diffusion_arrest(0.60, 2) == 1.0);
    Scene scene;
    Rods rods;
    rods.push_back(0, {}, {1, 0, 0}, 0.0, 1.0);
    const auto arrest = [&] { return free_clocks(scene, *make_mobility(scene)->at(rods, {}), rods, {}, 0.57).arrest; };
    for (const StartKind start : {StartKind::random, StartKind::aligned, StartKind::file, StartKind::run}) {
        scene.rods.start = start;
        CHECK(arrest() == diffusion_arrest(0.57, 3));
    }
    scene.rods.start = StartKind::lattice;  // a crystal keeps its places
    CHECK(arrest() == 1.0);
}
