#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

#include "jostle/rods/box.hpp"

using namespace jostle;

TEST_CASE("wrapping puts a centre into the box and counts the edges crossed") {
    const Box box{{10, 5, 2}, {true, true, false}};
    Vec3 centre{-0.5, 12.0, 7.0};
    Image image{1, 0, 0};
    box.wrap(centre, image);
    CHECK(centre.x == doctest::Approx(9.5));
    CHECK(centre.y == doctest::Approx(2.0));
    CHECK(centre.z == 7.0);  // open: left alone
    CHECK(image == Image{0, 2, 0});
    // centre + image * edges is where it was
    const Vec3 unwrapped = centre + box.displacement(image);
    CHECK(unwrapped.x == doctest::Approx(-0.5 + 10.0));
}

TEST_CASE("a centre that leaves a sheared box across y comes back displaced along x") {
    const Box box = Box({10, 5, 2}).sheared(3.0);
    //      +----------+
    //   +--|-------+ o|   a copy above lies 3 to the right: o is at (9, 5.5),
    //   |  +----- /|--+   and its copy in the box at (6, 0.5)
    Vec3 centre{9.0, 5.5, 1.0};
    Image image{0, 0, 0};
    box.wrap(centre, image);
    CHECK(centre.x == doctest::Approx(6.0));
    CHECK(centre.y == doctest::Approx(0.5));
    CHECK(image == Image{0, 1, 0});

    const Vec3 out{-1.0, -5.5, 3.0};  // across all faces
    centre = out;
    image = {0, 0, 0};
    box.wrap(centre, image);
    CHECK(centre == Vec3{5.0, 4.5, 1.0});
    CHECK(image == Image{0, -2, 1});
    CHECK(centre + box.displacement(image) == out);
}

TEST_CASE("a sheared box is told by an offset of at most half an edge") {
    const Box box({10, 5, 2});
    CHECK(box.sheared(4.0).offset() == 4.0);
    CHECK(box.sheared(16.0).offset() == -4.0);
    CHECK(box.sheared(-26.0).offset() == 4.0);
    CHECK(std::fabs(box.sheared(5.0 + 1e-12).offset()) <= 5.0);
    CHECK(box.sheared(20.0).offset() == 0.0);
}

TEST_CASE("a centre a hair below the lower face stays inside") {
    const Box box{{10, 10, 10}, {true, true, true}};
    for (const double x : {-1e-18, -1e-300, -0.0, 10.0, std::nextafter(10.0, 0.0), std::nextafter(0.0, -1.0)}) {
        Vec3 centre{x, 5, 5};
        Image image{0, 0, 0};
        box.wrap(centre, image);
        CHECK(centre.x >= 0.0);
        CHECK(centre.x < 10.0);
        CHECK(std::fabs(centre.x + 10.0 * image[0] - x) < 1e-14);
    }
}

TEST_CASE("volumes") {
    CHECK(rod_volume(0.0, 2.0) == doctest::Approx(4.0 / 3.0 * std::numbers::pi));
    CHECK(rod_volume(5.0, 1.0) == doctest::Approx(4.450589593));  // virial table of L/D = 5
    Rods rods;
    rods.push_back(0, {}, {1, 0, 0}, 0.0, 2.0);
    rods.push_back(1, {}, {1, 0, 0}, 5.0, 1.0);
    CHECK(total_volume(rods) == doctest::Approx(4.0 / 3.0 * std::numbers::pi + 4.450589593));
}
