#pragma once

#include <cstdint>
#include <optional>

#include "jostle/math/vec3.hpp"
#include "jostle/motion/motion.hpp"

namespace jostle {

/// Tumbles of swimmers: at Poisson times a rod is given a random rotation, every one equally likely, and turns by it at
/// constant angular velocity for the time of a tumble (theory, section 2.6). A tumble that begins ends the one before.
///
/// Where a rod stands in its tumble is a function of (seed, id, step) alone, so there is nothing to keep in
/// checkpoints: the Poisson process is drawn anew in every window of as many steps as a tumble takes, and no tumble
/// that is still on began before the last window.
class Tumbles {
public:
    /// rate (1/time), duration (time), both at least 0 and finite, and rate duration at most `largest_share`, else
    /// InputError. In two dimensions rods turn round z.
    Tumbles(double rate, double duration, int dimensions = 3);

    /// rate times duration, at most: rods that tumble for all but exp(-10) of the time do not swim.
    static constexpr double largest_share = 10.0;

    /// Steps that a tumble takes, at least 1.
    std::uint64_t steps(double time_step) const;

    /// Angular velocity of a tumbling rod, the same in all steps of a tumble; none while the rod runs.
    std::optional<Vec3> angular_velocity(std::uint64_t id, const StepContext& context) const;

    /// How often rods tumble in a step, and how far a tumble turns the ends of the longest, over its diameter.
    std::vector<StepLimit> step_limits(const Rods& rods) const;

private:
    std::optional<std::uint64_t> beginning(std::uint64_t id, const StepContext& context, std::uint64_t duration) const;

    double rate_, duration_;
    int dimensions_;
};

}  // namespace jostle
