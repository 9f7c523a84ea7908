#pragma once

#include "jostle/mobility/mobility.hpp"
#include "jostle/motion/motion.hpp"
#include "jostle/motion/tumbles.hpp"

namespace jostle {

/// How rods swim.
struct Swimming {
    double speed = 0.0;          ///< U_0 (length/time), of either sign; mean over rods
    double deviation = 0.0;      ///< standard deviation of the rods' own speeds (length/time)
    double tumble_rate = 0.0;    ///< (1/time)
    double tumble_time = 0.0;    ///< that a tumble takes (time)
    double reversal_rate = 0.0;  ///< (1/time)
    double force_dipole = 0.0;   ///< p (energy) that a swimmer stirs the fluid with: > 0 pushers, < 0 pullers
    int dimensions = 3;          ///< of the box that they swim in
};

/// Every rod swims along its axis n: U = U_i n (theory, eq. 2.1); it may tumble and turn round (theory, section 2.6).
///
/// A rod's own speed U_i is a normal number of mean `speed`, a function of (seed, id): its own for life. Where the mean
/// is not far above the deviation, some rods swim backwards. Where `Rods::speed` holds speeds, those are the rods' own;
/// daughters have that of their mother.
/// It stirs the fluid by a force dipole p n n, and by no net force (theory, section 7.7).
/// A tumbling rod does not swim, nor stir the fluid: it turns (`Tumbles`). A reversal exchanges head and tail, n -> -n,
/// between two steps: the same body, swimming back.
class SelfPropulsion final : public Motion {
public:
    /// Not finite, or but for the speed negative: InputError (key "motion.self_propulsion" and so on).
    explicit SelfPropulsion(const Swimming& swimming);
    explicit SelfPropulsion(double speed) : SelfPropulsion(Swimming{.speed = speed}) {}

    void add_velocities(Velocities& known, const Rods& rods, const MobilityOperator& mobility,
                        const StepContext& context) const override;
    /// The dipoles of those that swim now.
    AxialStresslets stresslets(const Rods& rods, const StepContext& context) const override;
    std::vector<std::uint32_t> turned_round(const Rods& rods, const StepContext& context) const override;

    /// How far the fastest swims, and what its dipole drags along with it; how often rods tumble, and how far the ends
    /// of the longest are turned by a tumble.
    std::vector<StepLimit> step_limits(const Rods& rods, const MobilityOperator& mobility,
                                       std::uint64_t seed) const override;

    /// The rods' own speeds (N), whatever they do now.
    std::vector<double> speeds(const Rods& rods, std::uint64_t seed) const;

    /// The forces U_i n/mu_parallel that would drag the rods along as they swim in this step (N); 0 for a rod that
    /// tumbles. Swimmers exert none on the fluid: `forces` has none.
    std::vector<Vec3> propulsion(const Rods& rods, const MobilityOperator& mobility, const StepContext& context) const;

private:
    StepLimit dipole_limit(const Rods& rods, const MobilityOperator& mobility) const;

    Swimming swimming_;
    Tumbles tumbles_;
};

}  // namespace jostle
