#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <set>
#include <vector>

#include "jostle/math/random.hpp"

using namespace jostle;

TEST_CASE("the same key gives the same numbers, and any part of the key changes them") {
    const RandomKey key{1, 2, Stream::test, 3};
    CHECK(uniform4(key, 0) == uniform4(key, 0));
    CHECK(normal6(key) == normal6(key));
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
    std::vector<std::array<double, 6>> draws(count);
    for (std::size_t k = 0; k < count; ++k) draws[k] = normal6({7, k / 100, Stream::test, k % 100});
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
