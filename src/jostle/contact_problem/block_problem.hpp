#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace jostle {

inline constexpr std::size_t max_points = 3;    ///< contacts of one pair (append_contacts)
using Points = std::array<double, max_points>;  ///< a number per contact of a pair

/// The part of A that belongs to the contacts of one pair.
struct BlockMatrix {
    std::uint32_t count;  ///< contacts, 2 or 3
    std::array<std::array<double, max_points>, max_points> matrix;
};

/// The pair's own contact problem with all other forces as they are: `target` holds gamma on entry and gamma* on
/// return; `velocity`, of the gaps on entry.
///
/// Every set of active points is tried, first that of `target`; where signs are right it is the solution. Where
/// rounding leaves none, the set that violates the conditions least is taken. Nearly singular sets are left out: where
/// three points are dependent, two of them do as well.
void solve_block_problem(const BlockMatrix& pair, const Points& velocity, Points& target);

}  // namespace jostle
