#pragma once

#include <span>
#include <vector>

#include "jostle/contact/contacts.hpp"
#include "jostle/hydrodynamics/axial_blob.hpp"
#include "jostle/hydrodynamics/line_vector.hpp"
#include "jostle/hydrodynamics/near_pairs.hpp"
#include "jostle/hydrodynamics/pair_flow.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// The part of M that is summed in real space: each rod's own block, and one for every pair of rods that have blobs
/// nearer than the cutoff (theory, eq. 7.5).
///
/// Each rod gathers what the others send it in the order of their ids, so that no sum depends on threads or rows.
class NearField {
public:
    /// `own`: (lines of `blobs`) the own block of each kind of rod. Holds references to rods, box and blobs.
    NearField(const Rods& rods, const Box& box, const RodBlobs& blobs, const PairFlow& flow,
              std::vector<RodMobility> own);

    /// velocities = M_near forces, (N) each.
    void apply(std::span<const LineVector> forces, std::span<LineVector> velocities) const;

    /// velocities += those of the rods in the flow of stresslets on all other rods.
    void add_axial_flow(const AxialStresslets& stresslets, std::span<LineVector> velocities) const;

    NearPairs pairs() const { return {pairs_, begin_, incidence_, others_}; }

private:
    /// A symmetric 3 x 3 matrix: xx, xy, xz, yy, yz, zz.
    using Block = std::array<float, 6>;
    /// Of one side of a pair: what the rod gets (first) from what acts on the other (then).
    struct SideBlocks {
        Block centre_centre, centre_moment, moment_centre, moment_moment;
    };

    void find_pairs(const Box& box);
    void list_incidence();
    bool meet(const PairKey& key) const;
    SideBlocks blocks_of(const PairKey& key) const;
    std::array<LineVector, 2> flows_of(const PairKey& key, const AxialStresslets& stresslets) const;
    Vec3 centre_separation(const PairKey& key) const {
        return rods_.centre[key.j] + box_.displacement(key.image) - rods_.centre[key.i];
    }
    template <class Received>
    void gather(std::span<LineVector> velocities, Received&& received) const;

    const Rods& rods_;
    const Box& box_;
    const RodBlobs& blobs_;
    const PairFlow& flow_;
    std::vector<RodMobility> own_;
    std::vector<PairKey> pairs_;  ///< the smaller id first
    /// Of each row: 2 p where the rod is i of pair p, 2 p + 1 where it is j; in the order of the other rods' ids.
    std::vector<std::size_t> begin_;        ///< (N + 1)
    std::vector<std::uint32_t> incidence_;  ///< (2 pairs)
    std::vector<std::uint32_t> others_;     ///< (2 pairs) row of the other rod
    std::vector<SideBlocks> blocks_;  ///< (2 pairs) in this order, so that a rod reads its own one after the other
};

}  // namespace jostle
