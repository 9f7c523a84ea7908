#pragma once

#include <span>
#include <vector>

#include "jostle/contact/contacts.hpp"
#include "jostle/hydrodynamics/near_pairs.hpp"
#include "jostle/hydrodynamics/rod_pair_flow.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// A LineVector in floats.
struct RoundedVector {
    Four centre, moment;

    RoundedVector() = default;
    explicit RoundedVector(const LineVector& v) : centre(rounded(v.centre)), moment(rounded(v.moment)) {}
    bool is_zero() const { return !any((centre != Four{}) | (moment != Four{})); }

private:
    static Four rounded(const Vec3& v) {
        return Four{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0F};
    }
};

/// What a near field finds of the rods of one step, and that of the next may take over.
struct NearMemory {
    NearPairs pairs;
    std::vector<SideBlocks> blocks;                      ///< (pairs) of the first rod
    std::vector<std::array<RoundedVector, 2>> received;  ///< (pairs) scratch
};

/// The part of M that is summed in real space: each rod's own block, and one for every pair of rods that have blobs
/// nearer than the cutoff (theory, eq. 7.5).
///
/// Each rod gathers what the others send it in the order of their ids, so that no sum depends on threads or rows.
class NearField {
public:
    /// `own`: (lines of `blobs`) the own block of each kind of rod. `memory` is for this field alone while it lasts.
    /// `stresslets`, if they are known: their flow takes half the time if it is found with the blocks.
    /// Holds references to all but `own`.
    NearField(const Rods& rods, const Box& box, const RodBlobs& blobs, const PairFlow& flow,
              std::vector<RodMobility> own, NearMemory& memory, const AxialStresslets* stresslets = nullptr);

    /// velocities = M_near forces, (N) each.
    void apply(std::span<const LineVector> forces, std::span<LineVector> velocities) const;

    /// velocities += those of the rods in the flow of the stresslets, which have to be known, on all other rods.
    void add_axial_flow(std::span<LineVector> velocities) const;
    /// The same of stresslets that were not known when this was made; the blocks are found again, too.
    void add_axial_flow(const AxialStresslets& stresslets, std::span<LineVector> velocities) {
        sum_blobs(&stresslets);
        add_axial_flow(velocities);
    }

    const NearPairs& pairs() const { return memory_.pairs; }

private:
    /// The blocks of all pairs, and what each rod gets from stresslets, if there are some, on the other.
    void sum_blobs(const AxialStresslets* stresslets);
    RodPair placed(const PairKey& key) const;
    template <class Received>
    void gather(std::span<LineVector> velocities, Received&& received) const;

    const Rods& rods_;
    const Box& box_;
    const RodBlobs& blobs_;
    RodPairFlow rod_pairs_;
    std::vector<RodMobility> own_;
    NearMemory& memory_;
};

}  // namespace jostle
