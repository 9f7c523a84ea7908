#include "jostle/motion/tumbles.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/error/refuse.hpp"
#include "jostle/math/random.hpp"

namespace jostle {

namespace {

/// In D a step: a tumble that turns the ends of a rod by more could carry them through others; "a few hundredths" is
/// what docs/guide/scene.md advises.
constexpr double farthest_turn = 0.25, advised_turn = 0.05;
/// Tumbles that begin in a step.
constexpr double automatic_share_of_a_step = 0.1, advised_share_of_a_step = 0.3;
constexpr const char* slower = "slower tumbles";

struct Quaternion {
    double real;
    Vec3 imaginary;
};

/// A point on the unit sphere in four dimensions, every one equally likely (Marsaglia 1972): two points in the unit
/// disc, the second stretched to what the first leaves. No trigonometric functions, which differ from processor to
/// processor.
Quaternion random_quaternion(const RandomKey& key) {
    for (std::uint32_t draw = 0;; ++draw) {
        auto u = uniform4(key, draw);
        for (double& number : u) number = 2.0 * number - 1.0;
        const double first = u[0] * u[0] + u[1] * u[1], second = u[2] * u[2] + u[3] * u[3];
        if (first >= 1.0 || second >= 1.0 || second == 0.0) continue;
        const double stretch = std::sqrt((1.0 - first) / second);
        return {u[0], {u[1], stretch * u[2], stretch * u[3]}};
    }
}

/// The rotation vector, of length pi at most. Halving the angle again and again leaves one whose sine is its series.
Vec3 rotation_vector(Quaternion q) {
    if (q.real < 0.0) q = {-q.real, -q.imaginary};
    constexpr int halvings = 12;
    for (int k = 0; k < halvings; ++k) {
        q.real = std::sqrt(0.5 * (1.0 + q.real));
        q.imaginary = (0.5 / q.real) * q.imaginary;
    }
    const double angle_over_sine = 1.0 + squared_norm(q.imaginary) / 6.0;
    return std::ldexp(angle_over_sine, halvings + 1) * q.imaginary;
}

/// In the plane: by any angle up to pi, round z.
Vec3 random_turn(const RandomKey& key) {
    return {0.0, 0.0, std::numbers::pi * (2.0 * uniform4(key, 0)[0] - 1.0)};
}

/// Steps (numbers within a window of so many) in which a Poisson process has events: calls `visit` for each, ascending.
template <class Visit>
void for_each_event(const RandomKey& key, double events_per_step, std::uint64_t steps, Visit&& visit) {
    double time = 0.0;
    for (std::uint32_t draw = 0;; ++draw)
        for (const double uniform : uniform4(key, draw)) {
            time += exponential(uniform) / events_per_step;
            if (!(time < static_cast<double>(steps))) return;
            visit(static_cast<std::uint64_t>(time));
        }
}

}  // namespace

Tumbles::Tumbles(double rate, double duration, int dimensions)
    : rate_(rate), duration_(duration), dimensions_(dimensions) {
    require_value(std::isfinite(rate) && rate >= 0.0, "motion.tumble_rate", rate, "is no rate", ">= 0, finite");
    require_value(std::isfinite(duration) && duration >= 0.0, "motion.tumble_time", duration, "is no time",
                  ">= 0, finite");
    require_value(rate * duration <= largest_share, "motion.tumble_time", duration,
                  "leaves rods no time to swim between tumbles", "at most 10/tumble_rate");
}

std::uint64_t Tumbles::steps(double time_step) const {
    return static_cast<std::uint64_t>(std::clamp(std::round(duration_ / time_step), 1.0, 0x1p53));
}

std::vector<StepLimit> Tumbles::step_limits(const Rods& rods) const {
    if (rate_ == 0.0) return {};
    double slenderest = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) slenderest = std::max(slenderest, rods.length[i] / rods.diameter[i]);
    const double turned = 0.5 * std::numbers::pi * slenderest;  // by an end, in D, in a tumble
    StepLimit often = {.key = "motion.tumble_rate",
                       .value = fmt::format("{:.4g}", rate_),
                       .number = rate_,
                       .harm = "makes more than one tumble in a time step",
                       .what = "a rod begins",
                       .unit = "tumble",
                       .remedy = slower,
                       .rate = rate_,
                       .automatic = automatic_share_of_a_step,
                       .advised = advised_share_of_a_step,
                       .largest = 1.0};
    if (turned == 0.0) return {often};
    StepLimit far = {.key = "motion.tumble_time",
                     .value = fmt::format("{:.4g}", duration_),
                     .number = duration_,
                     .inverse = true,
                     .harm = "is too short: the ends of a rod would pass through others",
                     .what = "a tumble turns the ends of a rod by up to",
                     .unit = "D",
                     .remedy = slower,
                     .rate = turned / duration_,
                     .automatic = advised_turn,
                     .advised = advised_turn};
    // A tumble takes a whole number of steps, rounded, and at least one.
    const double fewest = std::ceil(turned / farthest_turn);
    far.largest = fewest > 1.0 ? turned / (fewest - 0.5) : StepLimit::none;
    return {often, far};
}

std::optional<Vec3> Tumbles::angular_velocity(std::uint64_t id, const StepContext& context) const {
    if (rate_ == 0.0) return std::nullopt;
    const std::uint64_t duration = steps(context.time_step);
    const auto began = beginning(id, context, duration);
    if (!began) return std::nullopt;
    const RandomKey key{context.seed, *began, Stream::tumble_rotation, id};
    const Vec3 rotation = dimensions_ == 2 ? random_turn(key) : rotation_vector(random_quaternion(key));
    return (1.0 / (static_cast<double>(duration) * context.time_step)) * rotation;
}

/// The step in which the tumble that is on in this step began, if there is one.
std::optional<std::uint64_t> Tumbles::beginning(std::uint64_t id, const StepContext& context,
                                                std::uint64_t duration) const {
    const std::uint64_t window = context.step / duration, place = context.step % duration;
    const double events_per_step = rate_ * context.time_step;
    std::optional<std::uint64_t> began;
    for_each_event({context.seed, window, Stream::tumble_time, id}, events_per_step, place + 1,
                   [&](std::uint64_t step) { began = window * duration + step; });
    if (began || window == 0) return began;
    for_each_event({context.seed, window - 1, Stream::tumble_time, id}, events_per_step, duration,
                   [&](std::uint64_t step) {
                       if (step > place) began = (window - 1) * duration + step;
                   });
    return began;
}

}  // namespace jostle
