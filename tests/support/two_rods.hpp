#pragma once

#include "jostle/contact/pair_contacts.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle::test {

/// Two rods of lengths 4 and 3 and diameter 1, whose centres are `between` apart.
inline Rods two_rods(const Vec3& between, const Vec3& axis_i, const Vec3& axis_j) {
    Rods rods;
    rods.push_back(0, {5, 5, 5}, normalised(axis_i), 4.0, 1.0);
    rods.push_back(1, Vec3{5, 5, 5} + between, normalised(axis_j), 3.0, 1.0);
    return rods;
}

/// The first two rods, none displaced.
inline PairGeometry first_pair(const Rods& rods) {
    return pair_geometry(rods, 0, 1, rods.centre[1] - rods.centre[0], rods.axis[0], rods.axis[1]);
}

}  // namespace jostle::test
