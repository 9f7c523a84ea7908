#include "jostle/measurement/frame_steps.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

constexpr double wanted_frames = 100.0, least_frames = 2.0, max_rods_in_frames = 2e7;
constexpr double a_decade = 20.0;

std::uint64_t automatic_period(const Scene& scene, double time_step, double rods) {
    const double time = expected_equilibration(scene) + scene.time.production;
    if (grows(scene)) rods = static_cast<double>(scene.rods.count);  // the same when a run goes on
    const double frames = std::clamp(max_rods_in_frames / std::max(rods, 1.0), least_frames, wanted_frames);
    return static_cast<std::uint64_t>(std::clamp(std::round(time / time_step / frames), 1.0, 1e15));
}

/// The k-th number of the row 1, 2, 3 ... 9, 10, 11, 13, 14, 16 ... 100, 112 ..., some of it several times.
double of_row(double k) {
    return std::round(std::pow(10.0, k / a_decade));
}

}  // namespace

FrameSteps::FrameSteps(const Scene& scene, double time_step, double rods)
    : logarithmic_(scene.output.trajectory_times == FrameTimes::logarithmic) {
    const std::uint64_t automatic = logarithmic_ ? 1 : automatic_period(scene, time_step, rods);
    every_ = scene.output.trajectory_every.value_or(automatic);
}

bool FrameSteps::is_due(std::uint64_t step) const {
    if (every_ == 0 || step % every_ != 0) return false;
    if (!logarithmic_ || step == 0) return true;
    const auto number = static_cast<double>(step / every_);
    const double nearest = std::round(a_decade * std::log10(number));
    return of_row(nearest) == number || of_row(nearest - 1.0) == number || of_row(nearest + 1.0) == number;
}

double FrameSteps::frames(double steps) const {
    if (every_ == 0) return 0.0;
    const double periods = std::floor(steps / static_cast<double>(every_));
    if (!logarithmic_) return 1.0 + periods;
    double frames = 1.0, last = 0.0;
    for (double k = 0.0; of_row(k) <= periods; ++k) {
        frames += of_row(k) > last ? 1.0 : 0.0;
        last = of_row(k);
    }
    return frames;
}

bool keeps_frames(const Scene& scene) {
    return scene.output.trajectory_every != 0U;
}

}  // namespace jostle
