#pragma once

#include "jostle/mobility/mobility.hpp"
#include "jostle/motion/motion.hpp"

namespace jostle {

/// Brownian velocities U = sqrt(2 kT/dt) B xi with B B^T = M: over a step dt, displacements of covariance 2 kT dt M
/// (theory, eq. 2.1; the thermal drift kT div M vanishes for a mobility that couples no two rods).
///
/// xi are six standard normal numbers per rod, three for force and three for torque, a function of (seed, step, id)
/// alone (fill_normals, Stream::brownian).
class BrownianMotion final : public Motion {
public:
    /// kT >= 0 (energy), else InputError (key "fluid.kT"). `mobility` must outlive this object and be up to date with
    /// the rods.
    BrownianMotion(double kT, const Mobility& mobility);

    void add_to(Velocities& known, const Rods& rods, const StepContext& context) const override;

private:
    double kT_;
    const Mobility& mobility_;
};

}  // namespace jostle
