#include "jostle/motion/tumbles.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/error/require_value.hpp"
#include "jostle/math/random.hpp"

namespace jostle {

namespace {

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

Tumbles::Tumbles(double rate, double duration) : rate_(rate), duration_(duration) {
    require_value(std::isfinite(rate) && rate >= 0.0, "motion.tumble_rate", rate, "is no rate", ">= 0, finite");
    require_value(std::isfinite(duration) && duration >= 0.0, "motion.tumble_time", duration, "is no time",
                  ">= 0, finite");
    require_value(rate * duration <= largest_share, "motion.tumble_time", duration,
                  "leaves rods no time to swim between tumbles", "at most 10/tumble_rate");
}

std::uint64_t Tumbles::steps(double time_step) const {
    return static_cast<std::uint64_t>(std::clamp(std::round(duration_ / time_step), 1.0, 0x1p53));
}

std::optional<Vec3> Tumbles::angular_velocity(std::uint64_t id, const StepContext& context) const {
    if (rate_ == 0.0) return std::nullopt;
    const std::uint64_t duration = steps(context.time_step);
    const auto began = beginning(id, context, duration);
    if (!began) return std::nullopt;
    const Vec3 rotation = rotation_vector(random_quaternion({context.seed, *began, Stream::tumble_rotation, id}));
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
