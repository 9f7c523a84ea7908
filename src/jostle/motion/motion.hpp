#pragma once

#include <cstdint>

#include "jostle/rods/rods.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// Which step is being made; with the seed it is all that random motions may depend on.
struct StepContext {
    std::uint64_t seed = 0;
    std::uint64_t step = 0;
    double time_step = 0.0;
};

/// A contribution to the velocity that is known before contacts are resolved (U_known).
class Motion {
public:
    virtual ~Motion() = default;

    /// Adds this motion's velocities to `known`, one row a rod.
    virtual void add_to(Velocities& known, const Rods& rods, const StepContext& context) const = 0;

    /// Changes rods at the end of a step, where that moves no point of a body: turning a rod round.
    virtual void between_steps(Rods& /*rods*/, const StepContext& /*context*/) const {}
};

}  // namespace jostle
