#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "jostle/mobility/mobility.hpp"

namespace jostle {

/// A rod's own mobility, from its length and diameter.
using DragLaw = std::function<RodMobility(double length, double diameter)>;

struct DragCoefficients;

/// Every rod feels its own drag only: M is block diagonal, one block a rod (theory, eq. 2.9).
///
/// M F = [parallel n n + perpendicular (I - n n)] F,  rotational (I - n n) T; its square root has the square roots of
/// the three coefficients in their places. Spin about the axis n is left out: torque along n gives nothing.
class DragMobility final : public Mobility {
public:
    /// `law`, which depends on nothing but its arguments, is asked by `at` for rods of new lengths or diameters, by
    /// several threads; what it throws passes through `at`, for the first rod of which it does.
    explicit DragMobility(DragLaw law);

    std::unique_ptr<const MobilityOperator> at(const Rods& rods, const Box& box) const override;

private:
    DragLaw law_;
    mutable std::mutex lock_;  ///< of the last coefficients
    mutable std::shared_ptr<const DragCoefficients> last_;
};

}  // namespace jostle
