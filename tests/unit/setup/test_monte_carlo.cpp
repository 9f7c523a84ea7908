#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "jostle/math/random.hpp"
#include "jostle/math/random_direction.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/setup/monte_carlo.hpp"

using namespace jostle;

namespace {

Rods scattered(const Box& box, std::uint64_t count, double length, double diameter = 1.0) {
    Rods rods;
    for (std::uint64_t id = 0; id < count; ++id) {
        const auto u = uniform4({1, 0, Stream::test, id}, 0), v = uniform4({1, 0, Stream::test, id}, 1);
        rods.push_back(id, box.point_at({u[0], u[1], u[2]}), random_direction(v[0], v[1]), length, diameter);
    }
    return rods;
}

/// Volume from which one rod keeps the centre of another, mean over directions (Onsager 1949).
double excluded_volume(double length, double diameter) {
    using std::numbers::pi;
    return 0.5 * pi * length * length * diameter + 2.0 * pi * length * diameter * diameter +
           4.0 / 3.0 * pi * std::pow(diameter, 3.0);
}

}  // namespace

// Of two rods in a box V the odds of overlapping are v exp(-price)/(V - v), v the excluded volume. With `placings` the
// rods are put down elsewhere, without they walk; the domains' borders move from sweep to sweep.
TEST_CASE("two rods overlap as often as Boltzmann's factor says") {
    struct Case {
        double length, edge, price;
        int placings, sweeps;
    };
    for (const auto& [length, edge, price, placings, sweeps] :
         {Case{0.0, 3.0, 1.0, 1, 40000}, Case{0.0, 5.0, 0.3, 0, 200000}, Case{3.0, 10.0, 0.5, 1, 40000},
          Case{2.0, 7.0, 1.0, 0, 200000}}) {
        CAPTURE(length);
        CAPTURE(placings);
        const Box box{{edge, edge, edge}, {true, true, true}};
        Rods rods = scattered(box, 2, length);
        MonteCarlo monte_carlo(rods, box, 7);
        // Means of 100 blocks: their scatter gives the error, with all correlation shorter than a block.
        constexpr int blocks = 100;
        double sum = 0.0, squares = 0.0;
        for (int block = 0; block < blocks; ++block) {
            double mean = 0.0;
            for (int k = 0; k < sweeps / blocks; ++k) {
                monte_carlo.sweep(price, placings);
                mean += monte_carlo.overlapping_rods() > 0 ? 1.0 / (sweeps / blocks) : 0.0;
            }
            sum += mean;
            squares += mean * mean;
        }
        const double share = sum / blocks;
        const double error = std::sqrt((squares / blocks - share * share) / (blocks - 1));
        const double weight = excluded_volume(length, 1.0) * std::exp(-price);
        const double expected = weight / (std::pow(edge, 3.0) - excluded_volume(length, 1.0) + weight);
        CHECK(error < 0.1 * expected);
        CHECK(std::fabs(share - expected) < 4.5 * error);  // false alarm 3e-5 a case
    }
}

TEST_CASE("overlaps are counted as they are, in thin boxes and of many sizes too") {
    for (const Vec3& edges : {Vec3{20, 20, 20}, Vec3{30, 4, 12}}) {
        const Box box{edges, {true, true, edges.y > 10.0}};
        Rods rods = scattered(box, 150, 5.0);
        for (std::size_t i = 0; i < rods.size(); i += 3) rods.length[i] = rods.diameter[i] = 1.5;
        MonteCarlo monte_carlo(rods, box, 2);
        for (int k = 0; k < 20; ++k) monte_carlo.sweep(1.0, 4);
        const std::size_t counted = monte_carlo.overlapping_rods();
        CHECK(counted > 10);
        CHECK(counted == MonteCarlo(rods, box, 2).overlapping_rods());
        for (std::size_t i = 0; i < rods.size(); ++i) {
            CHECK(std::fabs(norm(rods.axis[i]) - 1.0) < 1e-12);
            for (int k = 0; k < 3; ++k) CHECK((rods.centre[i][k] >= 0.0 && rods.centre[i][k] <= edges[k]));
        }
    }
}

TEST_CASE("as the price rises overlaps become few, and rods are still put down elsewhere") {
    const Box box{{30, 30, 30}, {true, true, true}};
    Rods rods = scattered(box, 500, 5.0);
    const Rods before = rods;
    MonteCarlo monte_carlo(rods, box, 3);
    const std::size_t at_first = monte_carlo.overlapping_rods();
    MonteCarlo::Moves moves;
    for (int k = 0; k < 40; ++k) moves = monte_carlo.sweep(0.2 * (k + 1), 4);
    CHECK(moves.placings == 2000);
    CHECK(moves.shifts == 500);
    CHECK(moves.placed > 10);
    CHECK(at_first > 200);
    CHECK(monte_carlo.overlapping_rods() < at_first / 4);
    CHECK(rods.id == before.id);
    CHECK(rods.length == before.length);
}
