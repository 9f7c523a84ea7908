// The slowest mode of networks of springs, against closed forms.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "jostle/motion/spring_modes.hpp"

using namespace jostle;

namespace {

constexpr double stiffness = 0.3, mobility = 0.1;

Spring link(std::uint64_t from, std::uint64_t to, double strength = stiffness) {
    return {.rod_1 = from, .rod_2 = to, .stiffness = strength};
}

/// Of soft springs between spheres of one size.
double time_of(const std::vector<Spring>& springs, double kT = 1.0) {
    return slowest_spring_time(
        springs,
        [](std::uint64_t) {
            return RodMobility{mobility, mobility, 0.0};
        },
        kT, 3);
}

/// m rods in a row, from `first` on.
std::vector<Spring> chain(std::uint64_t m, std::uint64_t first = 0) {
    std::vector<Spring> springs;
    for (std::uint64_t i = 0; i + 1 < m; ++i) springs.push_back(link(first + i, first + i + 1));
    return springs;
}

/// 1/(4 k mu sin^2 angle)
double wave(double angle) {
    return 0.25 / (stiffness * mobility * std::pow(std::sin(angle), 2));
}

}  // namespace

TEST_CASE("a pair relaxes in 1/(k (mu_1 + mu_2)), a rod by its mean mobility; two springs in one place add up") {
    const auto mobility_of = [](std::uint64_t id) {
        return id == 7 ? RodMobility{0.2, 0.2, 0.0} : RodMobility{0.4, 0.1, 0.5};  // mean 0.2 and 0.2
    };
    const std::vector<Spring> one = {link(7, 3)}, two = {link(7, 3), link(3, 7)};
    CHECK(slowest_spring_time(one, mobility_of, 1.0, 3) == doctest::Approx(1.0 / (stiffness * 0.4)));
    CHECK(slowest_spring_time(two, mobility_of, 1.0, 3) == doctest::Approx(0.5 / (stiffness * 0.4)));
    CHECK(slowest_spring_time(one, mobility_of, 1.0, 2) == doctest::Approx(1.0 / (stiffness * 0.45)));
}

TEST_CASE("chains and rings have the times of their longest waves") {
    for (const std::uint64_t m : {2, 3, 10, 300})
        CHECK(time_of(chain(m)) ==
              doctest::Approx(wave(0.5 * std::numbers::pi / static_cast<double>(m))).epsilon(0.01));
    std::vector<Spring> ring = chain(40);
    ring.push_back(link(39, 0));
    CHECK(time_of(ring) == doctest::Approx(wave(std::numbers::pi / 40.0)).epsilon(0.01));
}

TEST_CASE("of separate parts the slowest counts, wherever its rods are in the file") {
    std::vector<Spring> parts = chain(5);
    for (const Spring& spring : chain(9, 100)) parts.push_back(spring);
    for (std::uint64_t pair = 0; pair < 30; ++pair) parts.insert(parts.begin(), link(1000 + pair, 2000 + pair));
    CHECK(time_of(parts) == doctest::Approx(wave(std::numbers::pi / 18.0)).epsilon(0.01));
}

TEST_CASE(
    "stiff links of a chain relax as noise turns them, in b^2/(2 d mu kT) a pair; without noise by their stiffness") {
    Spring stiff = link(0, 1, 1e6);
    stiff.rest_length = 1.0;
    stiff.s_1 = 2.0;
    stiff.s_2 = -2.0;  // b = 5
    CHECK(time_of({stiff}, 2.0) == doctest::Approx(25.0 / (2.0 * 3.0 * mobility * 2.0)).epsilon(1e-5));
    CHECK(time_of({stiff}, 0.0) == doctest::Approx(0.5 / (1e6 * mobility)));
}

TEST_CASE("without springs, or with none of any stiffness, there is no such time") {
    CHECK(time_of({}) == 0.0);
    CHECK(time_of({link(0, 1, 0.0)}) == 0.0);
}
