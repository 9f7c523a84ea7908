#pragma once

#include <array>
#include <vector>

#include "jostle/hydrodynamics/line_vector.hpp"
#include "jostle/hydrodynamics/pair_flow.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/rods/axial_stresslets.hpp"

namespace jostle {

/// How two rods stand to each other.
struct RodPair {
    std::array<std::uint32_t, 2> row, line;  ///< of rod i and rod j; their lines of blobs
    std::array<Vec3, 2> axis;
    Vec3 apart;  ///< from the centre of i to that of j
};

/// A symmetric 3 x 3 matrix: xx, xy, xz, yy, yz, zz.
using SymmetricBlock = std::array<float, 6>;

/// Of one side of a pair: what the rod gets (first) from what acts on the other (then).
struct SideBlocks {
    SymmetricBlock centre_centre, centre_moment, moment_centre, moment_moment;
};

/// The flow between two rods: the sum over the pairs of their blobs, four at a time in floats.
class RodPairFlow {
public:
    RodPairFlow(const BlobLines& lines, const PairFlow& flow);

    /// Of rod i.
    SideBlocks blocks(const RodPair& pair) const;
    /// The same, and what i and j get from stresslets on each other.
    SideBlocks blocks(const RodPair& pair, const AxialStresslets& stresslets,
                      std::array<LineVector, 2>& axial_flow) const;

private:
    /// Four blobs of a line; lanes beyond its last one have no weight, and its place.
    struct FourBlobs {
        Four place, force_weight, moment_weight;
    };
    /// Of stresslets along the axis n on these blobs: forces along n, and dipoles n n.
    struct AxialBlobs {
        Four force, dipole;
    };
    template <bool with_axial_flow>
    SideBlocks sums(const RodPair& pair, const AxialStresslets& stresslets,
                    std::array<LineVector, 2>* axial_flow) const;
    AxialBlobs axial_blobs(const AxialStresslets& stresslets, std::uint32_t row, std::uint32_t line,
                           const FourBlobs& blobs) const;

    const BlobLines& lines_;
    const PairFlow& flow_;
    std::vector<std::vector<FourBlobs>> fours_;  ///< of each line
};

}  // namespace jostle
