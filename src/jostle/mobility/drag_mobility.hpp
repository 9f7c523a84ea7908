#pragma once

#include <functional>
#include <vector>

#include "jostle/mobility/mobility.hpp"

namespace jostle {

/// A rod's own mobility, from its length and diameter.
using DragLaw = std::function<RodMobility(double length, double diameter)>;

/// Every rod feels its own drag only: M is block diagonal, one block a rod (theory, eq. 2.9).
///
/// M F = [parallel n n + perpendicular (I - n n)] F,  rotational (I - n n) T; its square root has the square roots of
/// the three coefficients in their places. Spin about the axis n is left out: torque along n gives nothing.
class DragMobility final : public Mobility {
public:
    /// `law` is asked once for every rod, at each `update`, in rows' order; what it throws passes through `update`.
    explicit DragMobility(DragLaw law);

    void update(const Rods& rods) override;
    void apply(const Rods& rods, const Forces& forces, Velocities& velocities) const override;
    void apply_square_root(const Rods& rods, const Forces& normals, Velocities& velocities) const override;
    bool couples_rods() const override { return false; }
    RodMobility of_rod(std::size_t i) const override { return rod_mobility_[i]; }

private:
    DragLaw law_;
    std::vector<RodMobility> rod_mobility_;  // (N)
};

}  // namespace jostle
