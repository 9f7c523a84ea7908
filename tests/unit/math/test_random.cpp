#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <set>
#include <vector>

#include "jostle/math/random.hpp"

using namespace jostle;

namespace {

Normals normals_of(const RandomKey& key) {
    Normals normals{};
    fill_normals(key, {&key.id, 1}, {&normals, 1});
    return normals;
}

}  // namespace

TEST_CASE("normal numbers are Box-Muller's, from the uniform numbers of draws 0 and 1; those of an id stand alone") {
    std::vector<std::uint64_t> ids(1000);
    for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = 7 * k + (std::uint64_t{k % 3} << 40);
    std::vector<Normals> together(ids.size());
    const RandomKey shared{5, 1ULL << 35, Stream::brownian, 0};
    fill_normals(shared, ids, together);
    double worst = 0.0;
    for (std::size_t k = 0; k < ids.size(); ++k) {
        const RandomKey key{shared.seed, shared.step, shared.stream, ids[k]};
        CHECK(normals_of(key) == together[k]);
        const auto a = uniform4(key, 0), b = uniform4(key, 1);
        const std::array<double, 6> u = {a[0], a[1], a[2], a[3], b[0], b[1]};
        for (std::size_t pair = 0; pair < 6; pair += 2) {
            const double radius = std::sqrt(-2.0 * std::log(u[pair])), angle = 2.0 * std::acos(-1.0) * u[pair + 1];
            worst = std::max(worst, std::fabs(together[k][pair] - radius * std::cos(angle)));
            worst = std::max(worst, std::fabs(together[k][pair + 1] - radius * std::sin(angle)));
        }
    }
    CHECK(worst < 1e-14);
}

TEST_CASE("the same key gives the same numbers, and any part of the key changes them") {
    const RandomKey key{1, 2, Stream::test, 3};
    CHECK(uniform4(key, 0) == uniform4(key, 0));
    CHECK(normals_of(key) == normals_of(key));
    std::set<double> first = {uniform4(key, 0)[0], uniform4(key, 1)[0]};
    for (const RandomKey& other :
         {RandomKey{2, 2, Stream::test, 3}, RandomKey{1, 3, Stream::test, 3}, RandomKey{1, 2, Stream::start, 3},
          RandomKey{1, 2, Stream::test, 4}, RandomKey{1ULL << 40, 2, Stream::test, 3},
          RandomKey{1, 1ULL << 39, Stream::test, 3}, RandomKey{1, 2, Stream::test, 1ULL << 40}})
        first.insert(uniform4(other, 0)[0]);
    CHECK(first.size() == 9);
}

TEST_CASE("normal numbers: mean, variance, fourth moment, and no correlation between draws, rods and steps") {
    // 6 x 50,000 numbers of one seed. Limits at five standard errors: false alarm below 1e-5 for all checks together.
    const std::size_t count = 50000;
    std::vector<Normals> draws(count);
    for (std::size_t k = 0; k < count; ++k) draws[k] = normals_of({7, k / 100, Stream::test, k % 100});
    const double error = 1.0 / std::sqrt(static_cast<double>(count));
    for (std::size_t a = 0; a < 6; ++a) {
        double mean = 0.0, square = 0.0, fourth = 0.0, next = 0.0;
        for (std::size_t k = 0; k < count; ++k) {
            const double x = draws[k][a];
            mean += x;
            square += x * x;
            fourth += x * x * x * x;
            next += x * draws[(k + 1) % count][a];
        }
        const auto n = static_cast<double>(count);
        CHECK(std::fabs(mean / n) < 5 * error);
        CHECK(std::fabs(square / n - 1.0) < 5 * std::sqrt(2.0) * error);
        CHECK(std::fabs(fourth / n - 3.0) < 5 * std::sqrt(96.0) * error);
        CHECK(std::fabs(next / n) < 5 * error);
        for (std::size_t b = a + 1; b < 6; ++b) {
            double product = 0.0;
            for (const auto& draw : draws) product += draw[a] * draw[b];
            CHECK(std::fabs(product / n) < 5 * error);
        }
    }
}

TEST_CASE("uniform numbers lie strictly between 0 and 1, evenly") {
    const std::size_t count = 40000;
    std::vector<int> bins(10, 0);
    for (std::size_t k = 0; k < count; ++k)
        for (const double u : uniform4({3, 0, Stream::test, k}, 0)) {
            REQUIRE(u > 0.0);
            REQUIRE(u < 1.0);
            ++bins[static_cast<std::size_t>(10.0 * u)];
        }
    double chi_squared = 0.0;
    const double expected = 4.0 * count / 10.0;
    for (const int bin : bins) chi_squared += (bin - expected) * (bin - expected) / expected;
    CHECK(chi_squared < 40.0);  // nine degrees of freedom: false alarm 8e-6
}

TEST_CASE("exponential numbers are -ln u of the uniform ones") {
    double worst = 0.0, largest = 0.0;
    for (std::uint64_t id = 0; id < 1000; ++id) {
        const RandomKey key{9, 1, Stream::test, id};
        for (const double u : uniform4(key, 3)) {
            worst = std::max(worst, std::fabs(exponential(u) + std::log(u)));
            CHECK(exponential(u) > 0.0);
            largest = std::max(largest, exponential(u));
        }
    }
    CHECK(worst < 1e-14);
    CHECK(largest < 22.9);
}

TEST_CASE("events happen as often as their probability says, which may be far below 2^-32") {
    constexpr int keys = 100000;
    int happened = 0, between = 0;
    for (std::uint64_t id = 0; id < keys; ++id) {
        const RandomKey key{7, 3, Stream::test, id};
        happened += happens(key, 0.3) ? 1 : 0;
        CHECK(!happens(key, 0.0));
        CHECK(happens(key, 1.0));
        // The number that is compared, by halving: none of those spaced by 2^-32, but near that of `uniform4`.
        if (id >= 100) continue;
        double below = 0.0, above = 1.0;
        while (above - below > 0x1p-50) (happens(key, 0.5 * (below + above)) ? above : below) = 0.5 * (below + above);
        CHECK(std::fabs(above - uniform4(key, 0)[0]) <= 0x1p-32);
        between += std::fabs(std::remainder(above * 0x1p32 - 0.5, 1.0)) > 1e-3 ? 1 : 0;
    }
    CHECK(std::fabs(happened - 0.3 * keys) < 5.0 * std::sqrt(0.21 * keys));  // false alarm 6e-7
    CHECK(between > 90);
}
