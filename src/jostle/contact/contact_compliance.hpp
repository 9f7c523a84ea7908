#pragma once

#include <algorithm>
#include <cmath>

namespace jostle {

/// By how much a contact gives way to its force gamma, as a velocity of its gap: on a soft spring up to the knee, on a
/// stiff one beyond it. All 0: not at all.
///
///     gives way   |        . stiff
///                 |   .  '
///            knee +  '
///                 | / soft
///                 +------------- gamma
struct ContactCompliance {
    double soft = 0.0, stiff = 0.0;  ///< mobilities, soft >= stiff
    double knee = 0.0;               ///< a velocity: where the line of the stiff spring begins

    double at(double gamma) const { return std::min(soft * gamma, knee + stiff * gamma); }
    bool is_stiff_at(double gamma) const { return soft * gamma > knee + stiff * gamma; }
};

/// The compliance of all contacts of a step (theory, eq. 3.5): in parts of their relative mobility A_ll.
struct ComplianceLaw {
    double soft = 0.0, stiff = 0.0;  ///< kappa and kappa'
    double knee = 0.0;               ///< a velocity over the root of a mobility
    double own_image = 0.0;          ///< kappa of the one spring between a rod and its own image

    bool is_hard() const { return soft == 0.0; }

    ContactCompliance of(double relative_mobility, bool between_images) const {
        if (between_images) return {own_image * relative_mobility, own_image * relative_mobility, 0.0};
        return {soft * relative_mobility, stiff * relative_mobility, knee * std::sqrt(relative_mobility)};
    }
};

}  // namespace jostle
