#pragma once

#include <cstdint>
#include <optional>

namespace jostle {

/// What a cell measures until it divides.
enum class DivisionRule {
    sizer,  ///< its length: divides at `division_length`
    adder,  ///< the length added since birth
    timer   ///< the time since birth
};

/// Where the new one of two daughters swims.
enum class DaughterDirection { same, opposite };

/// `stall_memory` of a law that names none: this part of the time from birth to division, (division_length + D)/(2
/// rate).
inline constexpr double automatic_memory = 0.01;

/// How cells grow, divide and die. Means are those of the sizer: adder and timer have the same cycle without noise,
/// from (division_length - D)/2 at birth to division_length, in (division_length + D)/(2 rate).
struct GrowthLaw {
    double rate = 0.0;                ///< of the length (length/time); the mean over cells
    double rate_deviation = 0.0;      ///< relative standard deviation of the cells' own rates, drawn at birth
    double division_length = 0.0;     ///< greater than the diameter
    double division_deviation = 0.0;  ///< relative standard deviation of what a cell measures, drawn at birth
    DivisionRule division = DivisionRule::sizer;
    DaughterDirection daughters = DaughterDirection::same;
    std::optional<double> stall_force;   ///< compression along the axis at which a cell stops growing; none: never
    std::optional<double> stall_memory;  ///< over which the compression is averaged (time); none: `automatic_memory`
    double death_rate = 0.0;             ///< of every cell (1/time)
    std::uint64_t division_every = 10;   ///< steps between looks at who divides and who dies

    bool operator==(const GrowthLaw&) const = default;
};

}  // namespace jostle
