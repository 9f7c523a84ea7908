#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/stress/collision_stress.hpp"

namespace jostle {

/// What the collision stress of a step is the sum of, contact by contact and rod by rod, to be shared out: to rods
/// (stress_per_rod.hpp), or to places (stress_field.hpp). Rods are named by ids, which outlast the step.
struct CollisionMoments {
    /// A contact with a force: (r_j - r_i) F.
    struct Pair {
        std::uint64_t id_i, id_j;  ///< of bodies (`id_of_body`)
        Vec3 middle;      ///< of the line between the two centres of mass; may lie beyond an edge of a periodic box
        Vec3 separation;  ///< r_j - r_i
        Vec3 force;       ///< on rod j

        Mat3 moment() const { return outer(separation, force); }
    };
    /// A rod that contacts turn: its geometric stress.
    struct Body {
        std::uint64_t id;
        Vec3 centre;
        Mat3 geometric;
    };

    std::vector<Pair> pairs;   ///< in the order of the ids
    std::vector<Body> bodies;  ///< in the order of the ids

    /// V Sigma_col (theory, eq. 1.7): `sum_of_pair_stresses`, but for rounding.
    Mat3 total() const;
};

/// Those of all ranks for rank 0, none for the others; each has those of contacts and rods of its own. All ranks call
/// it together.
CollisionMoments at_first_rank(const CollisionMoments& moments, const Ranks& ranks);

/// The parts of `sum_of_pair_stresses`, whose arguments and errors these are; `rods` stand in `box`.
CollisionMoments collision_moments(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                                   const Box& box, std::span<const Vec3> axis, const RodTorques& torques,
                                   ContactDistance distance);

}  // namespace jostle
