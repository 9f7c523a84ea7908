#pragma once

#include <algorithm>

namespace jostle {

/// How contacts give way to their forces: at first as a soft spring, then as a stiff one (theory, eq. 3.5).
///
///     by how much |        . stiff             A contact with the force gamma leaves its gap below the shift by
///     it gives    |   .  '                     min(soft A_ll gamma, knee sqrt(A_ll) + stiff A_ll gamma) dt.
///     way         |  /
///                 | / soft                     All 0: contacts do not give way.
///                 +------------- gamma
struct GivingWay {
    double soft = 0.0, stiff = 0.0;  ///< 0 < stiff <= soft, or both 0
    double knee = 0.0;               ///< a velocity over the root of a mobility

    /// Of one contact.
    struct Contact {
        double soft = 0.0, stiff = 0.0;  ///< mobilities
        double knee = 0.0;               ///< a velocity

        double by(double gamma) const { return std::min(soft * gamma, knee + stiff * gamma); }
    };
};

}  // namespace jostle
