// The stress field: what it holds in all, and where.

#include <doctest/doctest.h>

#include <cmath>

#include "jostle/error/input_error.hpp"
#include "jostle/stress/orientation_stress.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "jostle/stress/stress_field.hpp"
#include "random_crowd.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

/// Sum over cells (and outside) of the fields times the cell volume.
StressField::Content total_of(const StressField& field) {
    StressField::Content sum;
    for (std::size_t cell = 0; cell < field.size(); ++cell) sum.add(field.cell_volume(), field.mean(cell));
    if (field.has_outside()) sum.add(field.cell_volume(), field.outside_mean());
    return sum;
}

Rods spheres_at(const std::vector<Vec3>& centres) {
    Rods rods;
    for (const Vec3& centre : centres) rods.push_back(rods.size(), centre, {0, 0, 1}, 0.0, 1.0);
    return rods;
}

/// A hat of one edge to either side, of the distance by the nearest periodic image.
double hat(double distance, double edge, double box_edge) {
    distance -= box_edge * std::round(distance / box_edge);
    return std::max(0.0, 1.0 - std::fabs(distance) / edge) / edge;
}

CollisionMoments one_pair(const Vec3& begin, const Vec3& separation, const Vec3& force) {
    CollisionMoments moments;
    moments.pairs.push_back({0, 1, begin + 0.5 * separation, separation, force});
    return moments;
}

std::string refusal(const Box& box, double spacing) {
    try {
        StressField field(box, spacing);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("sums over the cells are V Sigma_col, V Sigma_ori and N, in periodic and open boxes, for any cells") {
    std::mt19937_64 generator(41);
    MESSAGE("seed 41");
    for (const std::array<bool, 3>& periodic :
         {std::array{true, true, true}, {true, false, true}, {false, false, false}})
        for (const double spacing : {0.37, 1.0, 2.9, 50.0}) {
            CAPTURE(spacing);
            const Crowd crowd(generator, periodic);
            const CollisionMoments moments = crowd.moments(ContactDistance::touching);
            const Mat3 total = moments.total(), orientation = sum_of_orientation_stresses(crowd.rods, 0.7);
            StressField field(crowd.box, spacing);
            field.add(moments, crowd.rods, 0.7);
            CHECK(norm(total_of(field).collision - total) < 1e-12 * norm(total));
            CHECK(norm(total_of(field).orientation - orientation) < 1e-12 * norm(orientation));
            CHECK(total_of(field).number_density ==
                  doctest::Approx(static_cast<double>(crowd.rods.size())).epsilon(1e-13));
            CHECK(field.has_outside() == (periodic != std::array{true, true, true}));
            // Two more steps, one of them without contacts: the mean over three.
            field.add({}, crowd.rods, 0.7);
            field.add(moments, {}, 0.7);
            CHECK(norm(total_of(field).collision - (2.0 / 3.0) * total) < 1e-12 * norm(total));
            CHECK(norm(total_of(field).orientation - (2.0 / 3.0) * orientation) < 1e-12 * norm(orientation));
            field.clear();
            field.add(moments, crowd.rods, 0.0);
            CHECK(norm(total_of(field).collision - total) < 1e-12 * norm(total));
            CHECK(total_of(field).orientation.m == Mat3{}.m);  // nothing turns
        }
}

TEST_CASE("the integral along a line is exact: against a sum over many points") {
    const Box box{{6, 5, 4}, {true, true, true}};
    const Vec3 begin = {5.3, 0.2, 3.9}, separation = {2.1, -1.7, 1.3}, force = {0.3, -2.0, 1.1};
    StressField field(box, 0.9);
    CHECK(field.cells() == std::array<std::size_t, 3>{6, 5, 4});
    field.add(one_pair(begin, separation, force), {}, 1.0);
    const int points = 20000;
    double largest = 0.0;
    for (std::size_t cell = 0; cell < field.size(); ++cell) {
        double weight = 0.0;
        for (int k = 0; k < points; ++k) {
            const Vec3 d = begin + (k + 0.5) / points * separation - field.centre(cell);
            weight += hat(d.x, 1.0, 6.0) * hat(d.y, 1.0, 5.0) * hat(d.z, 1.0, 4.0) / points;
        }
        largest = std::max(largest, weight);
        CHECK(norm(field.mean(cell).collision - weight * outer(separation, force)) <
              1e-7);  // the midpoint rule's own error
    }
    CHECK(largest > 0.05);
}

// Cells of edge 1. The line from the centre of the first cell to that of the third puts 1/4, 1/2, 1/4 into the three.
TEST_CASE("a line through three cells, and a point: by hand") {
    StressField field({{4, 1, 1}, {true, true, true}}, 1.0);
    CollisionMoments moments = one_pair({0.5, 0.5, 0.5}, {2, 0, 0}, {3, 0, 0});
    moments.bodies.push_back({0, {3.75, 0.5, 0.5}, Mat3{{0, 0, 0, 0, 8, 0, 0, 0, -8}}});
    Rods rods;
    rods.push_back(0, {1.75, 0.1, 0.9}, {1, 0, 0}, 5.0, 1.0);
    field.add(moments, rods, 0.5);
    const double along[] = {1.5, 3.0, 1.5, 0.0}, across[] = {2.0, 0.0, 0.0, 6.0}, density[] = {0.0, 0.75, 0.25, 0.0};
    const double of_rod = -2.0 * 0.5 * moment_anisotropy(5.0);  // -3 kT B (1 - 1/3)
    for (std::size_t cell = 0; cell < 4; ++cell) {
        CHECK(field.centre(cell) == Vec3{0.5 + static_cast<double>(cell), 0.5, 0.5});
        const StressField::Content mean = field.mean(cell);
        CHECK(mean.collision(0, 0) == doctest::Approx(along[cell]));
        CHECK(mean.collision(1, 1) == doctest::Approx(across[cell]));
        CHECK(mean.number_density == doctest::Approx(density[cell]));
        CHECK(mean.orientation(0, 0) == doctest::Approx(of_rod * density[cell]));
        CHECK(mean.orientation(1, 1) == doctest::Approx(-0.5 * of_rod * density[cell]));
    }
}

// Along x the box is open: of a line from -1 to 3 a quarter lies outside, and the first cell takes what lies within
// half a cell of its edge.
TEST_CASE("open edges: what lies beyond them is counted apart") {
    StressField field({{4, 1, 1}, {false, true, true}}, 1.0);
    field.add(one_pair({-1, 0.5, 0.5}, {4, 0, 0}, {1, 0, 0}), spheres_at({{-0.1, 0, 0}, {0.0, 0, 0}, {4.0, 0, 0}}),
              1.0);
    CHECK(field.outside_mean().collision(0, 0) == doctest::Approx(1.0));
    const double along[] = {1.0, 1.0, 0.875, 0.125};
    for (std::size_t cell = 0; cell < 4; ++cell)
        CHECK(field.mean(cell).collision(0, 0) == doctest::Approx(along[cell]));
    CHECK(field.outside_mean().number_density == 1.0);
    CHECK(field.mean(0).number_density == 1.0);
    CHECK(field.mean(3).number_density == 1.0);
}

TEST_CASE("moved by one cell, the same field one cell further; through a face, too") {
    const Box box{{5, 5, 5}, {true, true, true}};
    StressField here(box, 1.0), there(box, 1.0);
    here.add(one_pair({4.3, 4.8, 0.1}, {1.5, -0.9, -0.7}, {1, 2, 3}), {}, 1.0);
    there.add(one_pair({0.3, 4.8, 0.1}, {1.5, -0.9, -0.7}, {1, 2, 3}), {}, 1.0);
    for (std::size_t cell = 0; cell < 125; ++cell)
        CHECK(norm(here.mean(cell).collision - there.mean((cell + 25) % 125).collision) < 1e-14);
}

// Copies above along y are displaced by two cells, so that a field moved through that face is the same one, two cells
// back along x there.
TEST_CASE("in a sheared box: moved through the face that the copies slide along") {
    const Box box = Box{{5, 4, 3}, {true, true, true}}.sheared(2.0);
    const Vec3 separation = {1.5, 0.9, -0.7}, force = {1, 2, 3};
    Rods one, other;
    one.push_back(0, {4.8, 2.7, 0.2}, {0, 0, 1}, 2.0, 1.0);
    other.push_back(0, {2.8, 0.7, 0.2}, {0, 0, 1}, 2.0, 1.0);  // two cells up, wrapped
    for (const Vec3& begin : {Vec3{4.3, 2.8, 0.1}, {0.2, 3.7, 2.9}, {1.0, -0.3, 0.4}}) {
        StressField here(box, 1.0), there(box, 1.0);
        for (StressField* each : {&here, &there}) each->fit(box);
        here.add(one_pair(begin, separation, force), one, 1.0);
        there.add(one_pair(begin + Vec3{0, 2, 0}, separation, force), other, 1.0);
        CHECK(norm(total_of(here).collision - outer(separation, force)) < 1e-13);
        for (std::size_t x = 0; x < 5; ++x)
            for (std::size_t y = 0; y < 4; ++y)
                for (std::size_t z = 0; z < 3; ++z) {
                    const std::size_t back = y + 2 < 4 ? 0 : 2;
                    const auto before = here.mean((x * 4 + y) * 3 + z);
                    const auto after = there.mean(((x + 5 - back) % 5 * 4 + (y + 2) % 4) * 3 + z);
                    CHECK(norm(before.collision - after.collision) < 1e-14);
                    CHECK(before.number_density == doctest::Approx(after.number_density).epsilon(1e-13));
                }
    }
}

TEST_CASE("through a checkpoint to the bit") {
    std::mt19937_64 generator(42);
    MESSAGE("seed 42");
    const Crowd crowd(generator);
    StressField field(crowd.box, 1.3);
    field.add(crowd.moments(ContactDistance::touching), crowd.rods, 1.0);
    const NamedNumbers numbers = field.to_named();
    StressField again = StressField::from_named(numbers);
    CHECK(again.cells() == field.cells());
    CHECK(again.to_named() == numbers);
    for (StressField* each : {&field, &again}) each->add(crowd.moments(ContactDistance::at_start), crowd.rods, 1.0);
    CHECK(again.to_named() == field.to_named());
    CHECK(again.mean(7).collision.m == field.mean(7).collision.m);
    CHECK_THROWS_AS(StressField::from_named({}), InputError);
    for (const auto& [name, values] : numbers) {
        NamedNumbers other = numbers;
        other[name].pop_back();
        CHECK_THROWS_AS(StressField::from_named(other), InputError);
        other.erase(name);
        CHECK_THROWS_AS(StressField::from_named(other), InputError);
    }
    NamedNumbers other = numbers;
    other["cells"][0] = 1e9;
    CHECK_THROWS_AS(StressField::from_named(other), InputError);
}

TEST_CASE("spacings that make no grid are refused") {
    const Box box{{100, 100, 100}, {true, true, true}};
    CHECK(refusal(box, 1.0).empty());
    CHECK(refusal(box, 0.99).find("field_spacing = 0.99: makes too many cells (allowed: at most 1000000") !=
          std::string::npos);
    for (const double spacing : {0.0, -1.0, std::nan(""), HUGE_VAL})
        CHECK(refusal(box, spacing).find("is no distance") != std::string::npos);
}
