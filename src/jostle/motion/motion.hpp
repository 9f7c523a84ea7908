#pragma once

#include <cstdint>
#include <vector>

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

    /// Rows of the rods that exchange head and tail once the step has been made, n -> -n: the same bodies, and no point
    /// of one moves.
    virtual std::vector<std::uint32_t> turned_round(const Rods& /*rods*/, const StepContext& /*context*/) const {
        return {};
    }
};

}  // namespace jostle
