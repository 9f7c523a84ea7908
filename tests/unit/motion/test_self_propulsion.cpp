#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/math/mat3.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/parallel/parallel_for.hpp"

using namespace jostle;

namespace {

constexpr std::uint64_t seed = 77;
constexpr std::size_t many = 20000;
const Vec3 oblique = normalised(Vec3{0.4, -0.5, 0.9});

Rods equal_rods(std::size_t count) {
    Rods rods;
    for (std::uint64_t id = 0; id < count; ++id) rods.push_back(id, {0, 0, 0}, oblique, 4.0, 1.0);
    return rods;
}

void add_swimming(Velocities& known, const SelfPropulsion& propulsion, const Rods& rods, const StepContext& context) {
    const DragMobility model(
        [](double length, double diameter) { return finite_aspect_ratio_drag(length, diameter, 1.0); });
    propulsion.add_velocities(known, rods, *model.at(rods, {}), context);
}

/// Turns the rods by what the motion says of steps `first` to `last` - 1, and counts the steps in which a rod turns.
std::vector<int> turn(Rods& rods, const SelfPropulsion& propulsion, std::uint64_t first, std::uint64_t last,
                      double dt) {
    std::vector<int> turning(rods.size(), 0);
    for (std::uint64_t step = first; step < last; ++step) {
        Velocities known(rods.size());
        add_swimming(known, propulsion, rods, {seed, step, dt});
        for (std::size_t i = 0; i < rods.size(); ++i) {
            const bool turns = squared_norm(known.angular[i]) > 0.0;
            CHECK((squared_norm(known.linear[i]) > 0.0) != turns);
            turning[i] += turns ? 1 : 0;
            rods.axis[i] = rotated(rods.axis[i], dt * known.angular[i]);
        }
    }
    return turning;
}

std::string refused_key(const Swimming& swimming) {
    try {
        SelfPropulsion{swimming};
    } catch (const InputError& error) {
        CHECK(!error.parts().allowed.empty());
        return error.parts().key;
    }
    return "";
}

}  // namespace

TEST_CASE("every rod, spheres too, gets the speed along its axis, added to what is known") {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, {0, 0.6, 0.8}, 5.0, 1.0);
    rods.push_back(1, {0, 0, 0}, {-1, 0, 0}, 0.0, 1.0);
    Velocities known(2);
    known.linear[0] = {1, 1, 1};
    known.angular[1] = {0, 0, 7};
    add_swimming(known, SelfPropulsion(2.5), rods, {1, 1, 0.1});
    CHECK(norm(known.linear[0] - Vec3{1, 2.5, 3}) < 1e-15);
    CHECK(known.linear[1] == Vec3{-2.5, 0, 0});
    CHECK(known.angular[0] == Vec3{0, 0, 0});
    CHECK(known.angular[1] == Vec3{0, 0, 7});
    add_swimming(known, SelfPropulsion(-2.5), rods, {1, 1, 0.1});
    CHECK(known.linear[1] == Vec3{0, 0, 0});
}

// 20000 normal numbers, five standard errors of mean and standard deviation: false-alarm rate 1.2e-6 per seed.
TEST_CASE("rods' own speeds: mean and deviation; they belong to the id, for life") {
    MESSAGE("seed " << seed);
    const SelfPropulsion propulsion(Swimming{.speed = 2.0, .deviation = 0.5});
    const std::vector<double> speed = propulsion.speeds(equal_rods(many), seed);
    double mean = 0.0, variance = 0.0;
    for (const double value : speed) mean += value / many;
    for (const double value : speed) variance += (value - mean) * (value - mean) / many;
    CHECK(std::fabs(mean - 2.0) < 5.0 * 0.5 / std::sqrt(many));
    CHECK(std::fabs(std::sqrt(variance) - 0.5) < 5.0 * 0.5 / std::sqrt(2.0 * many));

    Rods few;
    few.push_back(77, {0, 0, 0}, oblique, 4.0, 1.0);
    few.push_back(3, {0, 0, 0}, -oblique, 4.0, 1.0);
    CHECK(propulsion.speeds(few, seed) == std::vector<double>{speed[77], speed[3]});
    for (const std::uint64_t step : {0, 1000}) {
        Velocities known(2);
        add_swimming(known, propulsion, few, {seed, step, 0.1});
        CHECK(known.linear[0] == speed[77] * oblique);
        CHECK(known.linear[1] == speed[3] * -oblique);
    }
    CHECK(propulsion.speeds(few, seed + 1)[0] != speed[77]);
}

// Binomial, five standard deviations: false-alarm rate 6e-7 per seed.
TEST_CASE("speeds that rods hold are theirs, in place of those of the law") {
    const SelfPropulsion propulsion(Swimming{.speed = 1.5, .deviation = 0.4});
    Rods rods = equal_rods(3);
    rods.speed = {1.0, -2.0, 0.25};
    CHECK(propulsion.speeds(rods, seed) == rods.speed);
}

TEST_CASE("reversals: n becomes -n with the probability of an odd number of Poisson events") {
    MESSAGE("seed " << seed);
    const double rate = 0.7, dt = 0.5;
    const SelfPropulsion propulsion(Swimming{.speed = 1.0, .reversal_rate = rate});
    Rods rods = equal_rods(many);
    const std::vector<std::uint32_t> turned = propulsion.turned_round(rods, {seed, 4, dt});
    CHECK(std::is_sorted(turned.begin(), turned.end()));
    CHECK(std::adjacent_find(turned.begin(), turned.end()) == turned.end());
    const double odd = 0.5 * (1.0 - std::exp(-2.0 * rate * dt));
    CHECK(std::fabs(static_cast<double>(turned.size()) - odd * many) < 5.0 * std::sqrt(odd * (1.0 - odd) * many));
    CHECK(propulsion.turned_round(rods, {seed, 5, dt}) != turned);
    CHECK(SelfPropulsion(Swimming{.speed = 1.0}).turned_round(rods, {seed, 6, dt}).empty());
}

// 20000 rods; seven numbers, five standard errors: false-alarm rate 4e-6 per seed.
TEST_CASE(
    "tumbles: rods run or turn; the share of running rods is exp(-rate time), after a tumble all directions are "
    "equally likely") {
    MESSAGE("seed " << seed);
    const double rate = 0.5, dt = 0.02;
    const std::uint64_t duration = 25;  // steps of a tumble
    const SelfPropulsion propulsion(Swimming{.speed = 1.0, .tumble_rate = rate, .tumble_time = duration * dt});
    Rods rods = equal_rods(many);
    // The first rods tumble from step 0 on; by step 60 all are as they will always be.
    turn(rods, propulsion, 0, 60, dt);
    const std::vector<int> now = turn(rods, propulsion, 60, 61, dt);
    double running = many;
    for (const int turns : now) running -= turns;
    const double share = std::exp(-rate * duration * dt);
    CHECK(std::fabs(running / many - share) < 5.0 * std::sqrt(share * (1.0 - share) / many));

    // Rods that tumble and then run, wherever they pointed: their directions are uniform on the sphere.
    Rods before = equal_rods(many);
    const std::vector<int> turned = turn(before, propulsion, 0, 75, dt);
    const std::vector<int> last = turn(before, propulsion, 75, 76, dt);
    Vec3 mean;
    Mat3 second;
    double count = 0.0;
    for (std::size_t i = 0; i < many; ++i) {
        if (last[i] != 0 || turned[i] == 0) {
            if (turned[i] == 0 && last[i] == 0) CHECK(before.axis[i] == oblique);
            continue;
        }
        CHECK(turned[i] >= static_cast<int>(duration));
        mean += before.axis[i];
        second += outer(before.axis[i], before.axis[i]);
        count += 1.0;
    }
    CHECK(count > 0.2 * many);
    for (int a = 0; a < 3; ++a) {
        CHECK(std::fabs(mean[a] / count) < 5.0 * std::sqrt(1.0 / (3.0 * count)));
        CHECK(std::fabs(second(a, a) / count - 1.0 / 3.0) < 5.0 * std::sqrt(4.0 / (45.0 * count)));
    }
}

TEST_CASE("tumbles are a function of seed, id and step: no history, no rows, no threads") {
    const SelfPropulsion propulsion(
        Swimming{.speed = 1.0, .deviation = 0.1, .tumble_rate = 3.0, .tumble_time = 0.2, .reversal_rate = 1.0});
    Rods rods = equal_rods(3001);
    const StepContext context = {seed, 123456, 0.01};
    const int threads_before = parallel::thread_count();
    std::vector<Velocities> known(2, Velocities(rods.size()));
    std::vector<std::vector<std::uint32_t>> turned(2);
    for (const int k : {0, 1}) {
        parallel::set_thread_count(1 + 2 * k);
        add_swimming(known[k], propulsion, rods, context);
        turned[k] = propulsion.turned_round(rods, context);
    }
    parallel::set_thread_count(threads_before);
    CHECK(known[0].linear == known[1].linear);
    CHECK(known[0].angular == known[1].angular);
    CHECK(turned[0] == turned[1]);
    Rods one;
    one.push_back(2718, {0, 0, 0}, oblique, 4.0, 1.0);
    Velocities alone(1);
    add_swimming(alone, propulsion, one, context);
    CHECK(alone.linear[0] == known[0].linear[2718]);
    CHECK(alone.angular[0] == known[0].angular[2718]);
}

TEST_CASE("the propulsion's force is U/mu_parallel along the axis, and none in a tumble") {
    const SelfPropulsion propulsion(Swimming{.speed = 2.0, .tumble_rate = 3.0, .tumble_time = 0.2});
    const Rods rods = equal_rods(200);
    const DragMobility model(
        [](double length, double diameter) { return finite_aspect_ratio_drag(length, diameter, 1.0); });
    const Box box;
    const auto mobility = model.at(rods, box);
    const StepContext context = {seed, 1000, 0.01};
    const std::vector<Vec3> force = propulsion.propulsion(rods, *mobility, context);
    Velocities known(rods.size());
    add_swimming(known, propulsion, rods, context);
    for (std::size_t i = 0; i < rods.size(); ++i)
        CHECK(norm(mobility->of_rod(i).parallel * force[i] - known.linear[i]) < 1e-14);
    CHECK(!propulsion.forces(rods, context).has_value());  // or the fluid would feel it
}

TEST_CASE("a swimmer stirs the fluid with its dipole while it swims, and not in a tumble") {
    const Swimming swimming{.speed = 2.0, .tumble_rate = 3.0, .tumble_time = 0.2, .force_dipole = -1.5};
    const SelfPropulsion propulsion(swimming);
    const Rods rods = equal_rods(200);
    const StepContext context = {seed, 1000, 0.01};
    const AxialStresslets stresslets = propulsion.stresslets(rods, context);
    REQUIRE(stresslets.dipole.size() == rods.size());
    CHECK(stresslets.kT == 0.0);
    Velocities known(rods.size());
    add_swimming(known, propulsion, rods, context);
    std::size_t tumbling = 0;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const bool swims = norm(known.linear[i]) > 0.0;
        CHECK(stresslets.dipole[i] == (swims ? -1.5 : 0.0));
        tumbling += swims ? 0 : 1;
    }
    CHECK(tumbling > 50);  // 1 - exp(-0.6) of 200: 90 +- 7
    CHECK(!SelfPropulsion(2.0).stresslets(rods, context).any());
}

TEST_CASE("numbers that make no sense are refused by key") {
    CHECK(refused_key({.speed = 1.0, .force_dipole = std::numeric_limits<double>::infinity()}) ==
          "motion.force_dipole");
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(refused_key({.speed = infinity}) == "motion.self_propulsion");
    for (const double bad : {-1.0, infinity, nan}) {
        CHECK(refused_key({.speed = 1.0, .deviation = bad}) == "motion.self_propulsion_deviation");
        CHECK(refused_key({.speed = 1.0, .tumble_rate = bad}) == "motion.tumble_rate");
        CHECK(refused_key({.speed = 1.0, .tumble_time = bad}) == "motion.tumble_time");
        CHECK(refused_key({.speed = 1.0, .reversal_rate = bad}) == "motion.reversal_rate");
    }
    CHECK(refused_key({.speed = 1.0, .tumble_rate = 4.0, .tumble_time = 2.6}) == "motion.tumble_time");
    CHECK(refused_key({.speed = 1.0, .tumble_rate = 4.0, .tumble_time = 2.5}) == "");
}
