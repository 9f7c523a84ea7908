#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "jostle/contact_problem/block_problem.hpp"

using namespace jostle;

namespace {

/// A pair of `count` points with the matrix C^T C + ridge of random columns of `rank` numbers.
struct RandomPair {
    BlockMatrix pair;
    Points velocity{}, gamma{};  ///< gap velocities with all forces, and the forces of the pair among them

    RandomPair(std::uint32_t count, int rank, double ridge, std::mt19937& random) {
        std::normal_distribution<double> normal;
        pair.count = count;
        pair.matrix = {};
        for (int r = 0; r < rank; ++r) {
            Points row{};
            for (std::uint32_t a = 0; a < count; ++a) row[a] = normal(random);
            for (std::uint32_t a = 0; a < count; ++a)
                for (std::uint32_t c = 0; c < count; ++c) pair.matrix[a][c] += row[a] * row[c];
        }
        // A gap velocity that the other forces of a pair of dependent points cannot contradict: in the matrix's range.
        Points inner{};
        for (std::uint32_t a = 0; a < count; ++a) {
            pair.matrix[a][a] += ridge;
            gamma[a] = std::max(normal(random), 0.0);
            inner[a] = normal(random);
        }
        for (std::uint32_t a = 0; a < count; ++a)
            for (std::uint32_t c = 0; c < count; ++c) velocity[a] += pair.matrix[a][c] * inner[c];
    }

    /// How far `target` is from 0 <= velocity  perp  gamma >= 0, as a gap velocity.
    double violation(const Points& target) const {
        double largest = 0.0;
        for (std::uint32_t a = 0; a < pair.count; ++a) {
            double here = velocity[a];
            for (std::uint32_t c = 0; c < pair.count; ++c) here += pair.matrix[a][c] * (target[c] - gamma[c]);
            CHECK(target[a] >= 0.0);
            largest = std::max(largest, std::fabs(std::min(pair.matrix[a][a] * target[a], here)));
        }
        return largest;
    }
};

}  // namespace

TEST_CASE("forces of a pair's points solve its own contact problem") {
    std::mt19937 random(1);
    double worst = 0.0;
    int some_push = 0, all_push = 0;
    constexpr int tries = 2000;
    for (const std::uint32_t count : {2U, 3U}) {
        for (int k = 0; k < tries; ++k) {
            const RandomPair example(count, 6, 0.0, random);
            Points target = example.gamma;
            solve_block_problem(example.pair, example.velocity, target);
            worst = std::max(worst, example.violation(target));
            const auto pushing = std::count_if(target.begin(), target.end(), [](double force) { return force > 0.0; });
            some_push += pushing > 0 ? 1 : 0;
            all_push += pushing == count ? 1 : 0;
        }
    }
    CHECK(worst < 1e-11);
    CHECK(some_push > tries);  // of 2 tries
    CHECK(all_push > tries / 10);
}

TEST_CASE("the solution does not depend on the forces that one begins with") {
    std::mt19937 random(2);
    for (int k = 0; k < 500; ++k) {
        RandomPair example(3, 6, 0.1, random);
        Points target = example.gamma;
        solve_block_problem(example.pair, example.velocity, target);
        // The same problem, told from other forces of the pair.
        RandomPair other = example;
        for (std::uint32_t a = 0; a < 3; ++a)
            for (std::uint32_t c = 0; c < 3; ++c) other.velocity[a] -= example.pair.matrix[a][c] * example.gamma[c];
        other.gamma = {};
        Points again{};
        solve_block_problem(other.pair, other.velocity, again);
        for (std::size_t a = 0; a < 3; ++a) CHECK(again[a] == doctest::Approx(target[a]).epsilon(1e-9));
    }
}

TEST_CASE("three dependent points push as two of them do") {
    std::mt19937 random(3);
    double worst = 0.0;
    for (int k = 0; k < 2000; ++k) {
        const RandomPair example(3, 2, 0.0, random);
        Points target = example.gamma;
        solve_block_problem(example.pair, example.velocity, target);
        worst = std::max(worst, example.violation(target));
        CHECK(std::min({target[0], target[1], target[2]}) == 0.0);
    }
    CHECK(worst < 1e-6);  // of nearly dependent pairs of them, too
}

TEST_CASE("a gap that no force can open stays, and the other point pushes alone") {
    BlockMatrix pair;
    pair.count = 2;
    pair.matrix = {{{0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {}}};
    Points target{};
    solve_block_problem(pair, {-1.0, -4.0, 0.0}, target);
    CHECK(target[0] == 0.0);
    CHECK(target[1] == 2.0);
}
