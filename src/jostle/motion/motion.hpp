#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "jostle/mobility/mobility.hpp"
#include "jostle/motion/step_limit.hpp"
#include "jostle/rods/forces.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// Which step is being made; with the seed it is all that random motions may depend on.
struct StepContext {
    std::uint64_t seed = 0;
    std::uint64_t step = 0;
    double time_step = 0.0;
};

/// What moves rods before contacts are resolved: its forces times M, and its velocities, are part of U_known.
class Motion {
public:
    virtual ~Motion() = default;

    /// Forces and torques on the rods (N), if it exerts any. The step adds up those of all motions and applies M once.
    virtual std::optional<Forces> forces(const Rods& /*rods*/, const StepContext& /*context*/) const {
        return std::nullopt;
    }

    /// Adds this motion's velocities to `known` (N), beside what its forces give. `mobility` is M of these rods.
    virtual void add_velocities(Velocities& /*known*/, const Rods& /*rods*/, const MobilityOperator& /*mobility*/,
                                const StepContext& /*context*/) const {}

    /// What it does to the fluid beside forces and torques: the step adds up the stresslets of all motions, and their
    /// flow is found once.
    virtual AxialStresslets stresslets(const Rods& /*rods*/, const StepContext& /*context*/) const { return {}; }

    /// Rows of the rods that exchange head and tail once the step has been made, n -> -n: the same bodies, and no point
    /// of one moves.
    virtual std::vector<std::uint32_t> turned_round(const Rods& /*rods*/, const StepContext& /*context*/) const {
        return {};
    }

    /// Whether its velocities are noise, without memory from step to step. What others give is a drift, which a step
    /// that is reflected has to know apart.
    virtual bool is_noise() const { return false; }

    /// Whether rods in equilibrium stay in it: else what equilibrium demands of the stress is not checked.
    virtual bool keeps_equilibrium() const { return false; }

    /// What a time step must not be too long for, as these rods move; limits of rate 0 may be left out.
    virtual std::vector<StepLimit> step_limits(const Rods& /*rods*/, const MobilityOperator& /*mobility*/,
                                               std::uint64_t /*seed*/) const {
        return {};
    }
};

/// The sum of the forces of all motions; none if no motion exerts any.
std::optional<Forces> sum_of_forces(std::span<const std::unique_ptr<Motion>> motions, const Rods& rods,
                                    const StepContext& context);

/// The sum of their stresslets.
AxialStresslets sum_of_stresslets(std::span<const std::unique_ptr<Motion>> motions, const Rods& rods,
                                  const StepContext& context);

}  // namespace jostle
