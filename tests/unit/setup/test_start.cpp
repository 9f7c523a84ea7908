#include <doctest/doctest.h>

#include <cmath>

#include "jostle/error/input_error.hpp"
#include "jostle/rods/wall.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/lattice.hpp"
#include "jostle/setup/scattered_rods.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/statistics/order_parameter.hpp"

using namespace jostle;

namespace {

Scene scene_of(std::uint64_t count, double length, StartKind start) {
    Scene scene;
    scene.rods.count = count;
    scene.rods.length = length;
    scene.rods.start = start;
    return scene;
}

Box box_of(const Scene& scene, double volume_fraction, const Vec3& shape = {1, 1, 1}) {
    const double volume =
        static_cast<double>(scene.rods.count) * rod_volume(scene.rods.length, scene.rods.diameter) / volume_fraction;
    const double scale = std::cbrt(volume / (shape.x * shape.y * shape.z));
    return {scale * shape, {true, true, true}};
}

}  // namespace

TEST_CASE("random starts reach phi = 0.40 at L/D = 5 and 0.50 for spheres, without overlap and without order") {
    // S of 250 random axes is 0.05 +- 0.014; 0.15 is seven standard deviations away. Rods at phi = 0.40 are near the
    // nematic phase, and turn together: in equilibrium S of 250 is 0.146 +- 0.036 (a run of 1200 mu D^3/kT), and 0.33
    // is five standard deviations away.
    constexpr double of_random_axes = 0.15, near_nematic = 0.33;
    struct Case {
        double length, volume_fraction;
        Vec3 shape;
        double max_order;
    };
    for (const auto& [length, volume_fraction, shape, max_order] :
         {Case{0.0, 0.50, {1, 1, 1}, of_random_axes}, Case{5.0, 0.40, {1, 1, 1}, near_nematic},
          Case{5.0, 0.25, {6, 1, 1}, of_random_axes}, Case{1.0, 0.45, {1, 1, 1}, of_random_axes}}) {
        CAPTURE(length);
        const Scene scene = scene_of(250, length, StartKind::random);
        const Box box = box_of(scene, volume_fraction, shape);
        const Rods rods = make_start(scene, box);
        CHECK(rods.size() == 250);
        CHECK(largest_overlap(rods, box) == 0.0);
        CHECK(nematic_order(rods.axis).order < max_order);
        for (std::size_t i = 0; i < rods.size(); ++i) {
            CHECK(rods.id[i] == i);
            CHECK(std::fabs(norm(rods.axis[i]) - 1.0) < 1e-12);
        }
    }
}

TEST_CASE("drawing anew alone leaves no overlap where rods are dilute, in thin boxes and of many lengths too") {
    struct Case {
        double length, length_deviation;
        Vec3 edges;
    };
    for (const auto& [length, length_deviation, edges] :
         {Case{5.0, 0.0, {40, 40, 40}}, Case{5.0, 0.0, {120, 120, 3}}, Case{4.0, 1.5, {30, 40, 50}},
          Case{0.0, 0.0, {25, 25, 25}}, Case{60.0, 0.0, {70, 70, 70}}}) {
        CAPTURE(length);
        CAPTURE(edges.z);
        Scene scene = scene_of(600, length, StartKind::random);
        if (length > 10.0) scene.rods.count = 60;
        scene.rods.length_deviation = length_deviation;
        const Box box{edges, {true, true, true}};
        const Rods rods = scattered_rods(scene, box, std::nullopt);
        CHECK(largest_overlap(rods, box) == 0.0);
        for (std::size_t i = 0; i < rods.size(); ++i) CHECK(rods.id[i] == i);
    }
}

TEST_CASE("a start is reproducible from the seed, and another seed gives another") {
    Scene scene = scene_of(100, 5.0, StartKind::random);
    const Box box = box_of(scene, 0.2);
    const Rods first = make_start(scene, box), second = make_start(scene, box);
    CHECK(first.centre == second.centre);
    CHECK(first.axis == second.axis);
    scene.seed = 2;
    CHECK_FALSE(make_start(scene, box).centre == first.centre);
}

TEST_CASE("aligned starts keep their axis, any axis, up to phi = 0.50") {
    Scene scene = scene_of(200, 5.0, StartKind::aligned);
    scene.rods.axis = {1, 2, 0.5};
    const Box box = box_of(scene, 0.50);
    const Rods rods = make_start(scene, box);
    CHECK(largest_overlap(rods, box) == 0.0);
    CHECK(nematic_order(rods.axis).order == doctest::Approx(1.0).epsilon(1e-9));
}

TEST_CASE("random starts of rods that should order are warned of, and others are not") {
    // Where simulations have the isotropic phase end: 0.405 to 0.42 for L/D = 5 (McGrother et al. 1996).
    CHECK(isotropic_limit(5.0, 3) == doctest::Approx(0.412).epsilon(0.02));
    CHECK(std::isinf(isotropic_limit(3.0, 3)));
    // Onsager's limit of long rods, (pi/4) n L^2 D = 3.29, and 5 % more: phi (L/D) = 3.45 where phi is small.
    CHECK(isotropic_limit(1e5, 3) * 1e5 == doctest::Approx(3.45).epsilon(0.01));
    Scene scene = scene_of(100, 5.0, StartKind::random);
    CHECK(start_warning(scene, 0.40).empty());
    CHECK(start_warning(scene, 0.43).find("about 0.41") != std::string::npos);
    scene.motion.self_propulsion = 1.0;
    CHECK(start_warning(scene, 0.43).empty());
    CHECK(start_warning(scene_of(100, 5.0, StartKind::aligned), 0.43).empty());
}

TEST_CASE("lattice starts fit close to their packing limit, and say so beyond it") {
    Scene scene = scene_of(216, 0.0, StartKind::lattice);
    CHECK(largest_overlap(make_start(scene, box_of(scene, 0.52)), box_of(scene, 0.52)) <= 1e-12);  // simple cubic: pi/6
    CHECK_THROWS_AS(make_start(scene, box_of(scene, 0.53)), InputError);
    scene = scene_of(180, 5.0, StartKind::lattice);
    scene.rods.axis = {0, 0, 1};
    const Box box = box_of(scene, 0.5, {1, 1, 2});
    const Rods rods = make_start(scene, box);
    CHECK(rods.size() == 180);
    CHECK(largest_overlap(rods, box) <= 1e-12);
    scene.rods.axis = {1, 1, 0};
    CHECK_THROWS_AS(make_start(scene, box), InputError);
}

// By hand. In a sphere whose centres reach sqrt(3) from the middle: 8 at (1/2, 1/2, 1/2) and 24 at (3/2, 1/2, 1/2),
// while a grid with a line through the middle has 27. Across a tube whose centres reach to (3/2, 1/2): 4 x 4 without
// corners.
TEST_CASE("lattice starts in containers: rods lie inside, as many as the sites of touching rods hold, and no more") {
    const auto in = [](Container container, const Vec3& edges, bool periodic_along_x) {
        return Box{edges, {periodic_along_x, false, false}, {{false, false, false}, container, 0}};
    };
    const double nook = 2.0 * (std::sqrt(3.0) + 0.5), round = 2.0 * (std::sqrt(2.5) + 0.5);
    struct Case {
        Box box;
        std::uint64_t most;
        double length;
    };
    for (const auto& [box, most, length] : {Case{in(Container::sphere, {nook, nook, nook}, false), 32, 0.0},
                                            Case{in(Container::tube, {5.0, round, round}, true), 60, 0.0},
                                            Case{in(Container::tube, {6.0, round, round}, true), 24, 2.0}}) {
        for (const std::uint64_t count : {std::uint64_t{1}, most / 3, most}) {
            const Rods rods = make_start(scene_of(count, length, StartKind::lattice), box);
            CHECK(rods.size() == count);
            CHECK(largest_overlap(rods, box) <= 1e-8);
            for (std::size_t i = 0; i < rods.size(); ++i)
                CHECK(overlap_with_walls(walls_of(box), box.walls(), rods, i) <= 1e-8);
        }
        try {
            make_start(scene_of(most + 1, length, StartKind::lattice), box);
            FAIL("not refused");
        } catch (const InputError& error) {
            CAPTURE(error.what());
            CHECK(std::string(error.what()).find("it holds " + std::to_string(most)) != std::string::npos);
        }
    }
}

TEST_CASE("a few spheres in a vast lattice are placed at once") {
    const Rods rods = make_start(scene_of(10, 0.0, StartKind::lattice), {{4e6, 4e6, 4e6}, {true, true, true}});
    CHECK(rods.size() == 10);
}

TEST_CASE("in a box of just their width, rods do not overlap their own images by rounding") {
    const Box box{{20, 20, 1}, {true, true, true}};
    CHECK(largest_overlap(make_start(scene_of(40, 5.0, StartKind::aligned), box), box) < 1e-12);
}

TEST_CASE("rods from a file must not overlap") {
    const Scene scene = scene_of(0, 5.0, StartKind::file);
    const Box box{{20, 20, 20}, {true, true, true}};
    Rods rods;
    rods.push_back(0, {5, 5, 5}, {1, 0, 0}, 5.0, 1.0);
    rods.push_back(1, {25, 6.5, 5}, {1, 0, 0}, 5.0, 1.0);  // outside: wrapped to x = 5
    CHECK(make_start(scene, box, rods).centre[1].x == doctest::Approx(5.0));
    rods.centre[1].y = 5.9;
    CHECK_THROWS_AS(make_start(scene, box, rods), InputError);
}
