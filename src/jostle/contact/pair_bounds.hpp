#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "jostle/math/marked_numbers.hpp"

namespace jostle {

/// Components of normals are kept to this: each is cut by less, the whole normal by less than twice as much.
inline constexpr float normal_unit = 1.0F / 32766.0F;

inline std::int16_t in_normal_units(float component) {
    return static_cast<std::int16_t>(component * (1.0F / normal_unit));
}

/// Pairs side by side, for vector instructions.
struct PairBatch {
    static constexpr std::size_t size = 128;  ///< few enough to stay in the nearest cache
    using Row = std::array<float, size>;
    std::array<std::uint32_t, size> i, j;      ///< rows
    std::array<std::uint16_t, size> in_block;  ///< numbers of the pairs in their block
    std::array<Row, 3> between, moved, axis_i, axis_j, axis_i_after, axis_j_after;
    Row half_i, half_j, radii;
    Row gap;        ///< before the step
    Row slack;      ///< lower bound of the gap after the known motion: the width of a slab with `normal`
    Row same_side;  ///< cosine of the angle between the lines of nearest points before and after that motion
    std::array<std::array<std::int16_t, size>, 3> normal;  ///< in units of normal_unit
    MarkedNumbers<size> inactive;                          ///< by these bounds
};

/// The gaps of pairs, and the width of the empty slab between the moved rods whose faces are normal to the line between
/// their nearest points; so those are marked whose gap is above `range` now, and above `margin` then.
void find_bounds(std::size_t count, float range, float margin, PairBatch& batch);

}  // namespace jostle
