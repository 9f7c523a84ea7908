#pragma once

#include <cstdint>
#include <optional>

namespace jostle {

/// How far a piston goes outwards in a step before contact forces act on it.
struct PlaneMotion {
    std::optional<std::uint32_t> body;  ///< none: no plane moves by itself
    double displacement = 0.0;          ///< by its load and by noise, a length
    double drift = 0.0;                 ///< by its load alone
};

}  // namespace jostle
