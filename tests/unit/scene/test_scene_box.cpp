#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene_box.hpp"

using namespace jostle;

TEST_CASE("close packing: spheres, and rods that stand in hexagonal layers") {
    CHECK(close_packing(0.0, 3) == doctest::Approx(std::numbers::pi / std::sqrt(18.0)).epsilon(1e-14));
    CHECK(close_packing(1e8, 3) == doctest::Approx(std::numbers::pi / std::sqrt(12.0)).epsilon(1e-7));
    // hexagonal layers of standing rods: cylinder parts of height L, caps as in close-packed spheres. Cell of 1 rod:
    // area sqrt(3)/2 times height L + sqrt(2/3)
    CHECK(close_packing(5.0, 3) ==
          doctest::Approx(rod_volume(5.0, 1.0) / (std::sqrt(0.75) * (5.0 + std::sqrt(2.0 / 3.0)))).epsilon(1e-14));
}

TEST_CASE("edges and volume fraction follow from each other") {
    Scene scene;
    scene.box.volume_fraction = 0.2;
    scene.rods.count = 100;
    scene.rods.length = 5.0;
    scene.rods.diameter = 2.0;
    scene.box.shape = {4, 1, 1};
    const Vec3 edges = box_edges(scene);
    CHECK(edges.x == doctest::Approx(4.0 * edges.y).epsilon(1e-14));
    CHECK(edges.y == doctest::Approx(edges.z).epsilon(1e-14));
    CHECK(rods_volume(scene) == doctest::Approx(100.0 * std::numbers::pi * (5.0 + 8.0 / 6.0)).epsilon(1e-14));
    CHECK(edges.x * edges.y * edges.z == doctest::Approx(rods_volume(scene) / 0.2).epsilon(1e-13));
    scene.box.volume_fraction.reset();
    scene.box.edges = edges;
    CHECK(volume_fraction(scene) == doctest::Approx(0.2).epsilon(1e-13));
}
