#include "jostle/simulation/flow_stress.hpp"

#include "jostle/math/shear_rotation.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

namespace jostle {

Mat3 sum_of_flow_stresses(const Rods& rods, const MobilityOperator& mobility, const ShearFlow& flow, const Clock& clock,
                          double time_step, const Domain& domain) {
    const double strain = flow.strain_of_step(clock, time_step);
    return sum_over_ranks<Mat3>(domain.ranks(), domain.owned_of(rods.size()), [&](std::size_t i) {
        if (rods.length[i] == 0.0) return Mat3{};
        const double lambda = moment_anisotropy(rods.length[i] / rods.diameter[i]);
        const Vec3 &axis = rods.axis[i], turned = ShearRotation(strain, lambda).of(axis);
        const double weight = lambda / (2.0 * mobility.of_rod(i).rotational * time_step);
        return weight * (outer(axis, axis) - outer(turned, turned));
    });
}

}  // namespace jostle
