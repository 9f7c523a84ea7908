#pragma once

#include <cstdint>
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
    /// `law`, which depends on nothing but its arguments, is asked at each `update`, by several threads; what it throws
    /// passes through `update`, for the first rod of which it does.
    explicit DragMobility(DragLaw law);

    void update(const Rods& rods) override;
    void apply(const Rods& rods, const Forces& forces, Velocities& velocities) const override;
    void add_square_root(const Rods& rods, std::size_t first, std::span<const Normals> normals, double scale,
                         Velocities& velocities) const override;
    bool couples_rods() const override { return false; }
    RodMobility of_rod(std::size_t i) const override { return kinds_[kind_[i]].own; }

private:
    /// Rods of one length and diameter.
    struct Kind {
        RodMobility own, root;  ///< the coefficients and their square roots
    };

    DragLaw law_;
    std::vector<std::uint32_t> kind_;  ///< (N)
    std::vector<Kind> kinds_;
};

}  // namespace jostle
