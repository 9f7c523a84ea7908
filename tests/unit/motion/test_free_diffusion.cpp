#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "jostle/math/rotation.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/parallel/parallel_for.hpp"

// Free rods, no contacts: what the known velocities alone do to centres and axes over many steps.
// Every number is allowed five standard errors of its own sample: false-alarm rate 5.7e-7 a check, 4e-6 per seed in
// all.

using namespace jostle;

namespace {

constexpr std::uint64_t seed = 2019;
constexpr std::size_t rod_count = 8000;
constexpr std::uint64_t step_count = 100;
constexpr double kT = 0.8;

struct Mean {
    double sum = 0.0, sum_of_squares = 0.0, count = 0.0;
    void add(double value) {
        sum += value;
        sum_of_squares += value * value;
        count += 1.0;
    }
    double value() const { return sum / count; }
    double standard_error() const { return std::sqrt((sum_of_squares / count - value() * value()) / count); }
};

void check_mean(const Mean& mean, double expected) {
    CAPTURE(mean.value());
    CAPTURE(mean.standard_error());
    CAPTURE(expected);
    CHECK(std::fabs(mean.value() - expected) < 5.0 * mean.standard_error());
    CHECK(mean.standard_error() < 0.02 * std::fabs(expected));  // else the line above proves little
}

struct FreeRods {
    Rods rods;
    RodMobility own = finite_aspect_ratio_drag(5.0, 1.0, 1.0);
    double dt = 0.005 / (kT * own.rotational);  // mean square of the turn about each axis: 2 D_R dt = 0.01
    Mean along, across, turn;                   // squares of single steps in the body's frame

    FreeRods() {
        for (std::uint64_t id = 0; id < rod_count; ++id) {
            const double angle = 0.01 * static_cast<double>(id);
            rods.push_back(id, {0, 0, 0}, {std::cos(angle), 0.6 * std::sin(angle), 0.8 * std::sin(angle)}, 5.0, 1.0);
        }
    }

    double turn_variance() const { return 2.0 * kT * own.rotational * dt; }

    /// <n(t + dt).n(t)>: the mean cosine of a turn whose two components have variance v; 1 - v + v^2/3 - v^3/15 + ...
    double axis_correlation_of_one_step() const {
        const double v = turn_variance();
        return 1.0 - v + v * v / 3.0 - v * v * v / 15.0;
    }

    void move(double speed) {
        const DragMobility model(
            [](double length, double diameter) { return finite_aspect_ratio_drag(length, diameter, 1.0); });
        const BrownianMotion brownian(kT);
        const SelfPropulsion propulsion(speed);
        for (std::uint64_t step = 0; step < step_count; ++step) {
            Velocities known(rods.size());
            const Box box;
            const auto mobility = model.at(rods, box);
            brownian.add_velocities(known, rods, *mobility, {seed, step, dt});
            measure(known);
            if (speed != 0.0) propulsion.add_velocities(known, rods, *mobility, {seed, step, dt});
            parallel_for(rods.size(), [&](std::size_t i) {
                rods.centre[i] += dt * known.linear[i];
                rods.axis[i] = rotated(rods.axis[i], dt * known.angular[i]);
            });
        }
    }

    void measure(const Velocities& brownian) {
        for (std::size_t i = 0; i < rods.size(); ++i) {
            const double parallel = dt * dot(brownian.linear[i], rods.axis[i]);
            along.add(parallel * parallel);
            across.add(dt * dt * squared_norm(brownian.linear[i]) - parallel * parallel);
            turn.add(dt * dt * squared_norm(brownian.angular[i]));
        }
    }
};

}  // namespace

TEST_CASE("passive rods: single steps in the body's frame, mean-square displacement, loss of orientation") {
    MESSAGE("seed " << seed);
    FreeRods free;
    const std::vector<Vec3> first_axis = free.rods.axis;
    free.move(0.0);
    const double dt = free.dt, t = dt * static_cast<double>(step_count);
    check_mean(free.along, 2.0 * kT * free.own.parallel * dt);
    check_mean(free.across, 4.0 * kT * free.own.perpendicular * dt);
    check_mean(free.turn, 4.0 * kT * free.own.rotational * dt);

    Mean squared_displacement, correlation;
    double worst_axis = 0.0;
    for (std::size_t i = 0; i < rod_count; ++i) {
        squared_displacement.add(squared_norm(free.rods.centre[i]));
        correlation.add(dot(free.rods.axis[i], first_axis[i]));
        worst_axis = std::max(worst_axis, std::fabs(norm(free.rods.axis[i]) - 1.0));
    }
    const double translational_diffusion = kT * (free.own.parallel + 2.0 * free.own.perpendicular) / 3.0;
    check_mean(squared_displacement, 6.0 * translational_diffusion * t);
    const double decay = std::exp(-2.0 * kT * free.own.rotational * t);
    const double discrete_decay = std::pow(free.axis_correlation_of_one_step(), static_cast<double>(step_count));
    CHECK(discrete_decay == doctest::Approx(decay).epsilon(0.002));  // what the finite step costs
    check_mean(correlation, discrete_decay);
    CHECK(worst_axis < 1e-15 * 4);
}

TEST_CASE("self-propelled rods: mean-square displacement of a persistent random walk") {
    MESSAGE("seed " << seed);
    FreeRods free;
    const double dt = free.dt, t = dt * static_cast<double>(step_count);
    const double translational_diffusion = kT * (free.own.parallel + 2.0 * free.own.perpendicular) / 3.0;
    const double persistence_time = 1.0 / (2.0 * kT * free.own.rotational);
    const double speed =
        3.0 * std::sqrt(6.0 * translational_diffusion / persistence_time);  // swimming outweighs diffusion
    free.move(speed);
    Mean squared_displacement;
    for (const Vec3& centre : free.rods.centre) squared_displacement.add(squared_norm(centre));

    double axis_sum = 0.0;  // sum over pairs of steps of <n.n>
    for (int a = 0; a < static_cast<int>(step_count); ++a)
        for (int b = 0; b < static_cast<int>(step_count); ++b)
            axis_sum += std::pow(free.axis_correlation_of_one_step(), std::abs(a - b));
    const double swimming = speed * speed * dt * dt * axis_sum;
    const double ratio = t / persistence_time;
    const double continuous =
        2.0 * speed * speed * persistence_time * persistence_time * (ratio - 1.0 + std::exp(-ratio));
    CHECK(swimming == doctest::Approx(continuous).epsilon(0.01));
    check_mean(squared_displacement, 6.0 * translational_diffusion * t + swimming);
}
