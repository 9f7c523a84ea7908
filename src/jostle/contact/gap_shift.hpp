#pragma once

#include <cmath>
#include <functional>
#include <span>

#include "jostle/contact/contacts.hpp"
#include "jostle/contact/time_step_correction.hpp"
#include "jostle/rods/relative_mobility.hpp"

namespace jostle {

/// The gap below which two bodies touch: 0, or with the time-step correction s(kappa) sqrt(2 kT dt A_ll) (theory, eq.
/// 3.5). Holds references to arrays of all rods.
struct GapShift {
    std::span<const double> part;           ///< (N) of the bounds below; 0 without the correction
    std::span<const Vec3> axis = {};        ///< (N)
    std::span<const RodMobility> own = {};  ///< (N) mobility of each rod; (0) without the correction
    double kT = 0.0, time_step = 0.0;
    std::function<double(const Contact&)> coupled = {};  ///< A_ll, where rods move each other through the fluid

    /// What `exact` is at most, of any contact of rods i and j; of a rod and a fixed body it is the rod's part.
    double bound(std::uint32_t i, std::uint32_t j) const {
        return i == j ? 2.0 * part[i] : std::sqrt(part[i] * part[i] + part[j] * part[j]);
    }

    double exact(const Contact& contact) const {
        if (own.empty()) return 0.0;
        if (coupled && !is_fixed(contact.i)) return brownian_shift(kT, time_step, coupled(contact));
        const std::uint32_t i = contact.i, j = contact.j;
        const MobileRod rod_j = {axis[j], own[j]};
        return brownian_shift(kT, time_step,
                              is_fixed(i) ? point_mobility(rod_j, contact.normal, contact.arm_j)
                                          : relative_mobility(contact, {axis[i], own[i]}, rod_j));
    }
};

}  // namespace jostle
