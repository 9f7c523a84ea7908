#include "jostle/motion/self_propulsion.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// In D a step: up to this the collision pressure is right to 1 % (docs/validation/beside_the_studies.md).
constexpr double advised_swim = 0.04;
/// In D: a rod that swims farther in a step could pass through others.
constexpr double farthest_swim = 0.5;

}  // namespace

SelfPropulsion::SelfPropulsion(const Swimming& swimming)
    : swimming_(swimming), tumbles_(swimming.tumble_rate, swimming.tumble_time, swimming.dimensions) {
    const auto& [speed, deviation, tumble_rate, tumble_time, reversal_rate, force_dipole, dimensions] = swimming_;
    require_value(std::isfinite(speed), "motion.self_propulsion", speed, "is no speed", "any finite number");
    require_value(std::isfinite(deviation) && deviation >= 0.0, "motion.self_propulsion_deviation", deviation,
                  "is no standard deviation", ">= 0, finite");
    require_value(std::isfinite(reversal_rate) && reversal_rate >= 0.0, "motion.reversal_rate", reversal_rate,
                  "is no rate", ">= 0, finite");
    require_value(std::isfinite(force_dipole), "motion.force_dipole", force_dipole, "is no energy",
                  "any finite number");
}

void SelfPropulsion::add_velocities(Velocities& known, const Rods& rods, const MobilityOperator& /*mobility*/,
                                    const StepContext& context) const {
    assert(known.size() == rods.size());
    const std::vector<double> speed = speeds(rods, context.seed);
    parallel_for(rods.size(), [&](std::size_t i) {
        if (const auto turning = tumbles_.angular_velocity(rods.id[i], context))
            known.angular[i] += *turning;
        else
            known.linear[i] += speed[i] * rods.axis[i];
    });
}

AxialStresslets SelfPropulsion::stresslets(const Rods& rods, const StepContext& context) const {
    if (swimming_.force_dipole == 0.0) return {};
    AxialStresslets own{.kT = 0.0, .dipole = std::vector<double>(rods.size())};
    parallel_for(rods.size(), [&](std::size_t i) {
        if (!tumbles_.angular_velocity(rods.id[i], context)) own.dipole[i] = swimming_.force_dipole;
    });
    return own;
}

std::vector<std::uint32_t> SelfPropulsion::turned_round(const Rods& rods, const StepContext& context) const {
    if (swimming_.reversal_rate == 0.0) return {};
    // Of a Poisson process: an odd number of events in the step. Twice turned round is not turned.
    const double odd = -0.5 * std::expm1(-2.0 * swimming_.reversal_rate * context.time_step);
    std::vector<char> turned(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        turned[i] = happens({context.seed, context.step, Stream::reversal, rods.id[i]}, odd) ? 1 : 0;
    });
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < rods.size(); ++row)
        if (turned[row] != 0) rows.push_back(row);
    return rows;
}

/// The force at either end of the dipole, on a rod beside it.
StepLimit SelfPropulsion::dipole_limit(const Rods& rods, const MobilityOperator& mobility) const {
    double fastest = 0.0;  // in diameters
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double force = std::fabs(swimming_.force_dipole) / (rods.length[i] + rods.diameter[i]);
        fastest = std::max(fastest, force * mobility.of_rod(i).perpendicular / rods.diameter[i]);
    }
    return {.key = "motion.force_dipole",
            .value = fmt::format("{:.4g}", swimming_.force_dipole),
            .number = std::fabs(swimming_.force_dipole),
            .harm = "drags a rod through others",
            .what = "a swimmer's dipole drags a rod beside it by up to",
            .unit = "D",
            .remedy = "a weaker dipole",
            .rate = fastest,
            .automatic = advised_swim,
            .advised = advised_swim,
            .largest = farthest_swim};
}

std::vector<StepLimit> SelfPropulsion::step_limits(const Rods& rods, const MobilityOperator& mobility,
                                                   std::uint64_t seed) const {
    const std::vector<double> speed = speeds(rods, seed);
    double fastest = 0.0, fastest_over_diameter = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        if (std::fabs(speed[i]) / rods.diameter[i] <= fastest_over_diameter) continue;
        fastest = speed[i];
        fastest_over_diameter = std::fabs(speed[i]) / rods.diameter[i];
    }
    std::vector<StepLimit> limits = {{.key = "motion.self_propulsion",
                                      .value = fmt::format("{:.4g}", fastest),
                                      .number = std::fabs(fastest),
                                      .harm = "takes a rod through others",
                                      .what = "the fastest swimmer covers",
                                      .unit = "D",
                                      .remedy = "slower swimmers",
                                      .rate = fastest_over_diameter,
                                      .automatic = advised_swim,
                                      .advised = advised_swim,
                                      .largest = farthest_swim}};
    if (swimming_.force_dipole != 0.0) limits.push_back(dipole_limit(rods, mobility));
    for (StepLimit& limit : tumbles_.step_limits(rods)) limits.push_back(std::move(limit));
    return limits;
}

std::vector<double> SelfPropulsion::speeds(const Rods& rods, std::uint64_t seed) const {
    if (!rods.speed.empty()) return rods.speed;
    std::vector<double> speed(rods.size(), swimming_.speed);
    if (swimming_.deviation == 0.0) return speed;
    const RandomKey key{seed, 0, Stream::swimming_speed, 0};
    parallel_for_blocks(rods.size(), normals_at_a_time, [&](std::size_t, std::size_t begin, std::size_t end) {
        std::array<Normals, normals_at_a_time> normals;
        fill_normals(key, {rods.id.data() + begin, end - begin}, {normals.data(), end - begin});
        for (std::size_t i = begin; i < end; ++i) speed[i] += swimming_.deviation * normals[i - begin][0];
    });
    return speed;
}

std::vector<Vec3> SelfPropulsion::propulsion(const Rods& rods, const MobilityOperator& mobility,
                                             const StepContext& context) const {
    std::vector<Vec3> force(rods.size());
    const std::vector<double> speed = speeds(rods, context.seed);
    parallel_for(rods.size(), [&](std::size_t i) {
        if (!tumbles_.angular_velocity(rods.id[i], context))
            force[i] = (speed[i] / mobility.of_rod(i).parallel) * rods.axis[i];
    });
    return force;
}

}  // namespace jostle
