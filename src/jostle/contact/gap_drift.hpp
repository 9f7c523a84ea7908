#pragma once

#include <span>
#include <vector>

#include "jostle/contact/arm_axes.hpp"
#include "jostle/contact/contacts.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/wall.hpp"

namespace jostle {

/// How fast noise opens the gaps of contacts, in the mean, because surfaces are curved, of rods that feel their own
/// drag only: kT tr(M grad grad Phi) (theory, eq. 3.5b).
///
///     d distance where they touch;  e normal;  A(k) relative mobility of the two points along k
///     end and end     kT [A(k) + A(k')]/d              k, k' across e
///     end and side    kT [A(k)/d - d mu_r]             k across e and the side's axis; mu_r of the side's rod
///     side and side   -kT d (mu_r + mu_r')/sin^2       of the angle between the axes, no less than of nearly parallel
///     end and wall    -kT sum A(k)/d'                  d' from the centre of a container; 0 at a plane
/// and of every point at `arm`, whose axis is shortened by its own turning: -2 kT mu_r arm (axis.e), outwards.
class GapDrift {
public:
    /// `axes`: of the moment that contacts have their normals of. `own`: (N) mobility of each rod alone. Holds
    /// references.
    GapDrift(const Rods& rods, const ArmAxes& axes, const Box& box, std::span<const RodMobility> own)
        : rods_(rods), axes_(axes), box_(box), own_(own), walls_(walls_of(box)) {}

    /// Over kT (velocity per energy).
    double operator()(const Contact& contact, const Image& image) const;

private:
    struct Side;
    Side side_of_rod(std::uint32_t row, double arm) const;
    Side side_of_fixed_rod(const Contact& contact, const Image& image) const;
    double at_wall(const Contact& contact) const;
    double between(const Side& i, const Side& j, const Vec3& normal, double distance) const;

    const Rods& rods_;
    ArmAxes axes_;
    const Box& box_;
    std::span<const RodMobility> own_;
    std::vector<Wall> walls_;
};

}  // namespace jostle
