#pragma once

#include "jostle/motion/motion.hpp"

namespace jostle {

/// The same force on every rod, as of gravity (theory, section 2.9).
class ForceOnRods final : public Motion {
public:
    /// `drives`: along some direction nothing stops the rods, and they fall without end. Not finite: InputError.
    explicit ForceOnRods(const Vec3& force, bool drives = true);

    std::optional<Forces> forces(const Rods& rods, const StepContext& context) const override;
    bool keeps_equilibrium() const override { return !drives_; }

    /// How far the fastest rod is dragged.
    std::vector<StepLimit> step_limits(const Rods& rods, const MobilityOperator& mobility,
                                       std::uint64_t seed) const override;

private:
    Vec3 force_;
    bool drives_;
};

/// Turns rods towards an axis h, heads and tails alike: the torque 2 epsilon (n.h) n x h of the energy
/// -epsilon (n.h)^2. Where epsilon is negative, they turn across it.
class AligningTorque final : public Motion {
public:
    /// `axis`: of any length but 0. Errors: InputError for numbers that are not finite, or an axis of length 0.
    AligningTorque(double energy, const Vec3& axis);

    std::optional<Forces> forces(const Rods& rods, const StepContext& context) const override;
    bool keeps_equilibrium() const override { return true; }

    /// The part of a small angle that the fastest rod loses.
    std::vector<StepLimit> step_limits(const Rods& rods, const MobilityOperator& mobility,
                                       std::uint64_t seed) const override;

private:
    double energy_;
    Vec3 axis_;
};

}  // namespace jostle
