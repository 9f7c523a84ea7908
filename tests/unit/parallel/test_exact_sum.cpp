// Sums that are exact: against sums of whole numbers of 128 bits, and where rounding one after the other loses all.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "jostle/parallel/exact_sum.hpp"

using namespace jostle;

namespace {

__extension__ using Whole = __int128;

double sum_of(const std::vector<double>& terms) {
    ExactSum sum;
    for (const double term : terms) sum.add(term);
    return sum.value();
}

double sum_of_batches(const std::vector<double>& terms) {
    ExactSum sum;
    for (std::size_t k = 0; k < terms.size(); k += ExactSum::batch)
        sum.add_all(std::span(terms).subspan(k, std::min(ExactSum::batch, terms.size() - k)));
    return sum.value();
}

constexpr double largest = std::numeric_limits<double>::max(), smallest = std::numeric_limits<double>::denorm_min();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("terms that cancel leave what is left, to the last bit") {
    CHECK(sum_of({}) == 0.0);
    CHECK(sum_of({-0.0}) == 0.0);
    CHECK(sum_of({1e300, 1.0, -1e300}) == 1.0);
    CHECK(sum_of({1.0, 1e-300, -1.0}) == 1e-300);
    CHECK(sum_of({-3.5, 1e20, -1e20, 1.25}) == -2.25);
    CHECK(sum_of({largest, largest, -largest}) == largest);
    CHECK(sum_of({largest, largest}) == infinity);
    CHECK(sum_of({smallest, smallest, -3 * smallest}) == -smallest);
    CHECK(sum_of({1e16, 1.0, 1.0}) == 1e16 + 2.0);  // one after the other both would be lost
}

TEST_CASE("a sum is rounded to the nearest double, to the even one of two") {
    const double half_unit = std::ldexp(1.0, -53);  // of the last bit of 1
    CHECK(sum_of({1.0, half_unit}) == 1.0);
    CHECK(sum_of({1.0, half_unit, std::ldexp(1.0, -600)}) == 1.0 + 2 * half_unit);
    CHECK(sum_of({1.0, half_unit, -std::ldexp(1.0, -600)}) == 1.0);
    CHECK(sum_of({1.0, 2 * half_unit, half_unit}) == 1.0 + 4 * half_unit);
    CHECK(sum_of({-1.0, -half_unit, -std::ldexp(1.0, -600)}) == -1.0 - 2 * half_unit);
}

TEST_CASE("infinities and nan remain") {
    CHECK(sum_of({1.0, infinity}) == infinity);
    CHECK(sum_of({-infinity, 1.0}) == -infinity);
    CHECK(std::isnan(sum_of({infinity, -infinity})));
    CHECK(std::isnan(sum_of({std::nan(""), 1.0})));
}

TEST_CASE("the sum of many numbers is that of whole numbers, in any order and any parts") {
    std::mt19937_64 random(7);
    std::vector<double> terms;
    Whole whole = 0;
    for (int k = 0; k < 20000; ++k) {
        const auto mantissa = static_cast<std::int64_t>(random() >> 11) * (random() % 2 == 0 ? 1 : -1);
        const auto exponent = static_cast<int>(random() % 40);
        whole += Whole{mantissa} * (Whole{1} << exponent);
        terms.push_back(std::ldexp(static_cast<double>(mantissa), exponent));
    }
    const double expected = static_cast<double>(whole);  // rounded to nearest
    for (int trial = 0; trial < 10; ++trial) {
        std::shuffle(terms.begin(), terms.end(), random);
        CHECK(sum_of(terms) == expected);
        CHECK(sum_of_batches(terms) == expected);
        ExactSum parts, part;
        for (std::size_t k = 0; k < terms.size(); ++k) {
            part.add(terms[k]);
            if (random() % 100 == 0) {
                parts += part;
                part = {};
            }
        }
        parts += part;
        CHECK(parts.value() == expected);
    }
}

TEST_CASE("batches are exact whatever the sizes of their numbers") {
    std::mt19937_64 random(8);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    for (const int decades : {0, 5, 20, 60, 300}) {
        CAPTURE(decades);
        std::vector<double> terms;
        for (int k = 0; k < 5000; ++k) terms.push_back(number(random) * std::pow(10.0, decades * number(random)));
        CHECK(sum_of_batches(terms) == sum_of(terms));
        for (std::size_t k = 0, known = terms.size(); k < known; ++k) terms.push_back(-terms[k]);
        std::shuffle(terms.begin(), terms.end(), random);
        CHECK(sum_of_batches(terms) == 0.0);
        terms[77] = infinity;
        CHECK(sum_of_batches(terms) == infinity);
        terms[78] = std::nan("");
        CHECK(std::isnan(sum_of_batches(terms)));
    }
}
