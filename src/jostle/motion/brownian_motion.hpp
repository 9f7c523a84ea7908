#pragma once

#include "jostle/motion/motion.hpp"

namespace jostle {

/// Brownian velocities U = sqrt(2 kT/dt) B xi + kT div M with B B^T = M: over a step dt, displacements of covariance
/// 2 kT dt M (theory, eq. 2.1; the thermal drift kT div M vanishes for a mobility that couples no two rods).
///
/// xi are standard normal numbers, a function of (seed, step, id) alone (Stream::brownian).
class BrownianMotion final : public Motion {
public:
    /// kT >= 0 (energy), else InputError (key "fluid.kT"). `dimensions` of the box that rods diffuse in.
    explicit BrownianMotion(double kT, int dimensions = 3);

    void add_velocities(Velocities& known, const Rods& rods, const MobilityOperator& mobility,
                        const StepContext& context) const override;
    /// kT div M is the flow of thermal stresslets.
    AxialStresslets stresslets(const Rods& rods, const StepContext& context) const override;

    bool is_noise() const override { return true; }
    bool keeps_equilibrium() const override { return true; }

    /// The root-mean-square step of the fastest rod along an axis, over the diameter of the thinnest.
    std::vector<StepLimit> step_limits(const Rods& rods, const MobilityOperator& mobility,
                                       std::uint64_t seed) const override;

private:
    double kT_;
    int dimensions_;
};

/// D_t of the fastest of the first `rod_count` rods.
double fastest_diffusion(double kT, const MobilityOperator& mobility, std::size_t rod_count, int dimensions);

}  // namespace jostle
