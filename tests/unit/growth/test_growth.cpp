// Growth, division and death of rods that meet nobody, one function at a time.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "jostle/error/input_error.hpp"
#include "jostle/growth/growth.hpp"
#include "jostle/parallel/parallel_for.hpp"

using namespace jostle;

namespace {

const Box box{{20, 20, 20}, {true, true, true}};

/// The paper's cells: born with 2.5, dividing at 6.
GrowthLaw law() {
    GrowthLaw law;
    law.rate = 1.0;
    law.division_length = 6.0;
    law.division_every = 1;
    return law;
}

Rods cells(std::size_t count, double length = 2.5) {
    Rods rods;
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = 0.7 * static_cast<double>(i);
        rods.push_back(i, {19.5, 0.3, 1.0 + static_cast<double>(i % 18)}, {std::cos(angle), std::sin(angle), 0.0},
                       length, 1.0);
    }
    return rods;
}

Vec3 unwrapped(const Rods& rods, std::size_t i) {
    return rods.centre[i] + box.displacement(rods.image[i]);
}

}  // namespace

//        mother    (=======================)      length L between the centres of the caps
//     daughters    (=========)(============)      (L - D)/2 each, caps touching
TEST_CASE("two daughters touch, and reach as far as their mother; her volume falls by pi D^3/12") {
    const Growth growth(law(), 1);
    Rods rods = cells(3, 6.25);
    growth.found(rods);
    rods.speed = {1.0, 2.0, 3.0};
    const Rods before = rods;
    const auto events = growth.divide(rods, box, 7, 0.1);
    REQUIRE(events.size() == 3);
    REQUIRE(rods.size() == 6);
    CHECK(rods.speed == std::vector<double>{1.0, 2.0, 3.0, 1.0, 2.0, 3.0});
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t front = 3 + i;
        const Vec3 axis = before.axis[i], apart = unwrapped(rods, front) - unwrapped(rods, i);
        const double length = rods.length[i];
        CHECK(length == 0.5 * (6.25 - 1.0));
        CHECK(rods.length[front] == length);
        CHECK(norm(apart - (length + 1.0) * axis) < 1e-12);  // ends of the segments are D apart: touching
        const double reach =
            norm(unwrapped(rods, front) + 0.5 * length * axis - (unwrapped(before, i) + 0.5 * before.length[i] * axis));
        CHECK(reach < 1e-12);
        const double lost =
            rod_volume(6.25, 1.0) - rod_volume(rods.length[i], 1.0) - rod_volume(rods.length[front], 1.0);
        CHECK(lost == doctest::Approx(std::numbers::pi / 12.0));
        CHECK(rods.id[i] == i);
        CHECK(rods.id[front] == (i | 1U << 2));
        CHECK(events[i].id == rods.id[front]);
        CHECK(events[i].mother == i);
        CHECK(rods.cycle[front].birth_step == 7);
        for (const std::size_t row : {i, front})
            for (int k = 0; k < 3; ++k) CHECK((rods.centre[row][k] >= 0.0 && rods.centre[row][k] < 20.0));
    }
}

TEST_CASE("ids are never used twice, in ten generations of five founders") {
    const Growth growth(law(), 1);
    Rods rods = cells(5, 6.0);
    growth.found(rods);
    std::set<std::uint64_t> seen(rods.id.begin(), rods.id.end());
    for (std::uint64_t generation = 1; generation <= 10; ++generation) {
        for (const LineageEvent& event : growth.divide(rods, box, generation, 0.1)) {
            CHECK(seen.insert(event.id).second);
            CHECK(seen.contains(event.mother));
        }
        REQUIRE(rods.size() == 5U << generation);
        std::fill(rods.length.begin(), rods.length.end(), 6.0);  // all are due again
    }
    CHECK(std::set<std::uint64_t>(rods.id.begin(), rods.id.end()) == seen);
}

TEST_CASE("a line that ids cannot follow is refused: the bits of founders and divisions are 53 in all") {
    const Growth growth(law(), 1);
    for (const std::uint64_t founder : {std::uint64_t{0}, std::uint64_t{39}, std::uint64_t{1} << 31}) {
        Rods rods = cells(1, 6.0);
        rods.id[0] = founder;
        growth.found(rods);
        CHECK(rods.founder_bits == (founder == 0 ? 0 : founder == 39 ? 6 : 32));
        const auto most = static_cast<std::uint64_t>(53 - rods.founder_bits);
        rods.cycle[0].divisions = most;
        CHECK_THROWS_AS(growth.divide(rods, box, 1, 0.1), InputError);
        rods.cycle[0].divisions = most - 1;
        growth.divide(rods, box, 1, 0.1);
        REQUIRE(rods.size() == 2);
        CHECK(rods.id[1] == founder + (std::uint64_t{1} << 52));
    }
}

TEST_CASE("direction of the daughter in front") {
    GrowthLaw turned = law();
    turned.daughters = DaughterDirection::opposite;
    Rods rods = cells(1, 6.0);
    const Growth growth(turned, 1);
    growth.found(rods);
    const Vec3 head = rods.axis[0];
    growth.divide(rods, box, 1, 0.1);
    CHECK(norm(rods.axis[0] + rods.axis[1]) == 0.0);
    CHECK(norm(rods.axis[1] - head) == 0.0);  // that in front swims on, that behind swims away from it
}

TEST_CASE("compression slows growth, tension does not hasten it") {
    GrowthLaw stalled = law();
    stalled.stall_force = 4.0;
    stalled.stall_memory = 0.3;  // three steps
    const Growth growth(stalled, 1);
    Rods rods = cells(3);
    growth.found(rods);
    const std::vector<std::uint32_t> rows = {0, 1};
    // Forces F inward on both ends: the sum of arm F is -F L along the axis.
    const auto lengthen = [&](double compression, int steps) {  // the growth of the three in the last step
        std::vector<double> before;
        for (int step = 0; step < steps; ++step) {
            const std::vector<ContactForce> forces = {{{}, -compression * rods.length[0] * rods.axis[0]},
                                                      {{}, 9.0 * rods.length[1] * rods.axis[1]}};
            before = rods.length;
            growth.slow_down(rods, rows, forces, 0.1);
            growth.lengthen(rods, 0.1);
        }
        return std::vector{rods.length[0] - before[0], rods.length[1] - before[1], rods.length[2] - before[2]};
    };
    const std::vector<double> slowed = lengthen(1.0, 50);
    CHECK(slowed[0] == doctest::Approx(0.1 * 0.75));
    CHECK(slowed[1] == doctest::Approx(0.1));
    CHECK(slowed[2] == doctest::Approx(0.1));
    CHECK(lengthen(5.0, 200)[0] < 1e-8);                                          // stalled
    CHECK(lengthen(0.0, 3)[0] == doctest::Approx(0.1 * (1.0 - std::exp(-1.0))));  // free again, for the memory time
    CHECK(lengthen(5.0, 200)[0] < 1e-8);
    CHECK(lengthen(3.0, 200)[0] == doctest::Approx(0.1 * 0.25));  // less pressed on
}

TEST_CASE("what slows a cell is its mean compression over the memory time, not that of one step") {
    // One step in ten presses ten times as hard. The share may be off by w <F^2>/(share F_stall <F>) of the force.
    GrowthLaw stalled = law();
    stalled.stall_force = 4.0;
    stalled.stall_memory = 100.0;
    const Growth growth(stalled, 1);
    Rods rods = cells(1);
    growth.found(rods);
    const double time_step = 0.1, weight = time_step / *stalled.stall_memory;
    double sum = 0.0;
    for (int step = 0; step < 20000; ++step) {
        const double compression = step % 10 == 0 ? 10.0 : 0.0;
        const std::vector<ContactForce> forces = {{{}, -compression * rods.length[0] * rods.axis[0]}};
        growth.slow_down(rods, std::vector<std::uint32_t>{0}, forces, time_step);
        if (step >= 10000) sum += rods.cycle[0].share / 10000.0;
    }
    CHECK(std::fabs(sum - 0.75) < 0.25 * weight * 10.0 / (0.75 * 4.0));
}

TEST_CASE("the memory is a hundredth of the time from birth to division unless the scene says otherwise") {
    // (6 + 1)/2 = 3.5 of length at rate 1: 0.035. After a time of it without force, 1/e of the compression is left.
    GrowthLaw stalled = law();
    stalled.stall_force = 4.0;
    const Growth growth(stalled, 1);
    Rods rods = cells(1);
    growth.found(rods);
    rods.cycle[0].share = 0.25;
    growth.slow_down(rods, std::vector<std::uint32_t>{0}, std::vector<ContactForce>(1), 0.035);
    CHECK(rods.cycle[0].share == doctest::Approx(1.0 - 0.75 * std::exp(-1.0)));
}

// Length at birth l, at division d, after many generations of one line with noise delta in what is measured:
// sizer: var d = (delta L_d)^2; adder: l' = (l + added (1 + delta xi) - D)/2, so var l = (delta added)^2/3, mean
// (L_d - D)/2; a timer's lengths have the same law as an adder's at one rate.
TEST_CASE("sizer, adder and timer keep the mean length; the adder's noise is (delta added)^2/3") {
    constexpr double delta = 0.1, dt = 0.01;
    constexpr int lines = 4000;
    for (const DivisionRule rule : {DivisionRule::sizer, DivisionRule::adder, DivisionRule::timer}) {
        GrowthLaw noisy = law();
        noisy.division = rule;
        noisy.division_deviation = delta;
        const Growth growth(noisy, 3);
        Rods rods = cells(lines);
        growth.found(rods);
        std::uint64_t step = 0;
        for (int generation = 0; generation < 6; ++generation) {
            // Every cell is taken to its own division, one after the other in time.
            for (std::size_t i = 0; i < rods.size(); ++i) {
                CellCycle& cycle = rods.cycle[i];
                if (rule == DivisionRule::timer)
                    rods.length[i] += cycle.division_at * cycle.growth_rate;
                else
                    rods.length[i] = cycle.division_at;
                if (rule == DivisionRule::timer) cycle.division_at = 0.0;
            }
            growth.divide(rods, box, ++step, dt);
            Rods kept = rods;  // one daughter of each
            for (auto* values : {&kept.length, &kept.diameter}) values->resize(lines);
            kept.centre.resize(lines);
            kept.axis.resize(lines);
            kept.id.resize(lines);
            kept.image.resize(lines);
            kept.cycle.resize(lines);
            rods = kept;
        }
        double mean = 0.0, variance = 0.0;
        for (const double length : rods.length) mean += length / lines;
        for (const double length : rods.length) variance += (length - mean) * (length - mean) / (lines - 1);
        const double measured = rule == DivisionRule::sizer ? 6.0 : 3.5;
        const double expected = std::pow(0.5 * delta * measured, 2) * (rule == DivisionRule::sizer ? 1.0 : 4.0 / 3.0);
        // Four standard errors of mean and variance of 4000 normal numbers: false alarm 4e-4 in all.
        CHECK(std::fabs(mean - 2.5) < 4.0 * std::sqrt(expected / lines));
        CHECK(std::fabs(variance / expected - 1.0) < 4.0 * std::sqrt(2.0 / lines));
    }
}

TEST_CASE("a timer's cells divide at their age, counted from birth") {
    GrowthLaw timer = law();
    timer.division = DivisionRule::timer;  // (L_D + D)/2 = 3.5 at rate 1
    const Growth growth(timer, 1);
    Rods rods = cells(3);
    growth.found(rods);
    CHECK(growth.divide(rods, box, 34, 0.1).empty());
    CHECK(growth.divide(rods, box, 35, 0.1).size() == 3);
    for (double& length : rods.length) length = 3.0;
    CHECK(growth.divide(rods, box, 69, 0.1).empty());
    CHECK(growth.divide(rods, box, 70, 0.1).size() == 6);
}

TEST_CASE("cells have rates of their own, of the mean and deviation asked for, and lengthen by them") {
    constexpr int count = 4000;
    GrowthLaw noisy = law();
    noisy.rate_deviation = 0.2;
    const Growth growth(noisy, 5);
    Rods rods = cells(count);
    growth.found(rods);
    growth.lengthen(rods, 0.1);
    double mean = 0.0, variance = 0.0;
    for (int i = 0; i < count; ++i) {
        CHECK(rods.length[i] == doctest::Approx(2.5 + 0.1 * rods.cycle[i].growth_rate));
        mean += rods.cycle[i].growth_rate / count;
    }
    for (const CellCycle& cycle : rods.cycle) variance += std::pow(cycle.growth_rate - mean, 2) / (count - 1);
    // Four standard errors of 4000 normal numbers: false alarm 1e-4 in all.
    CHECK(std::fabs(mean - 1.0) < 4.0 * 0.2 / std::sqrt(count));
    CHECK(std::fabs(variance / 0.04 - 1.0) < 4.0 * std::sqrt(2.0 / count));
}

TEST_CASE("cells die at their rate; the others stay in order") {
    GrowthLaw mortal = law();
    mortal.death_rate = 0.5;
    mortal.division_every = 10;
    const Growth growth(mortal, 5);
    Rods rods = cells(10000);
    growth.found(rods);
    const auto events = growth.divide(rods, box, 10, 0.02);
    // Of 10000, with probability p = 1 - exp(-0.5 * 10 * 0.02) each: four standard deviations, false alarm 6e-5.
    const double p = -std::expm1(-0.1), expected = 10000 * p;
    CHECK(std::fabs(static_cast<double>(events.size()) - expected) < 4.0 * std::sqrt(expected * (1.0 - p)));
    CHECK(rods.size() + events.size() == 10000);
    CHECK(std::is_sorted(rods.id.begin(), rods.id.end()));
    for (const LineageEvent& event : events) {
        CHECK(event.kind == LineageEvent::Kind::death);
        CHECK(!std::binary_search(rods.id.begin(), rods.id.end(), event.id));
    }
}
