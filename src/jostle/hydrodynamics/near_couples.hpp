#pragma once

#include <array>
#include <span>
#include <vector>

#include "jostle/hydrodynamics/axial_blob.hpp"
#include "jostle/hydrodynamics/couple_flow.hpp"
#include "jostle/hydrodynamics/line_vector.hpp"
#include "jostle/hydrodynamics/near_pairs.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// The couples on spheres in the near field: what they do to blobs of force and to each other (theory, section 7.8).
/// The moment l of a sphere is its couple n x l, and moment velocities are Omega x n, as of rods.
///
/// Each rod gathers in the order of its entries, so that no sum depends on threads or rows.
class NearCouples {
public:
    /// Holds references to rods, box, blobs and flow, and to what `pairs` shows.
    NearCouples(const Rods& rods, const Box& box, const RodBlobs& blobs, const CoupleFlow& flow,
                const NearPairs& pairs);

    /// velocities += what couples on other rods, and forces on others turning spheres, add to them; (N) each.
    void add_flow(std::span<const LineVector> forces, std::span<LineVector> velocities) const;

    /// velocities += the turning of spheres in the flow of stresslets on all other rods.
    void add_axial_flow(const AxialStresslets& stresslets, std::span<LineVector> velocities) const;

private:
    struct Vector {
        std::array<float, 3> v{};
        Vector() = default;
        explicit Vector(const Vec3& of)
            : v{static_cast<float>(of.x), static_cast<float>(of.y), static_cast<float>(of.z)} {}
        Vec3 value() const { return {v[0], v[1], v[2]}; }
        Vector operator-() const { return Vector(-value()); }
    };
    /// Of one side of a pair: what the rod gets (first) from what acts on the other (then). From couples T: centre += T
    /// x centre_couple, moment += T x moment_couple, turning += [isotropic + radial r r] T; from forces F and moments
    /// L: turning += F x couple_centre + L x couple_moment.
    struct SideBlocks {
        Vector centre_couple, moment_couple, couple_centre, couple_moment;
        Vector between;  ///< r
        float isotropic = 0.0F, radial = 0.0F;
    };
    SideBlocks blocks_of(const PairKey& key) const;
    static SideBlocks turned(const SideBlocks& side);
    Vec3 turning_of(const PairKey& key, const AxialStresslets& stresslets) const;
    Vec3 centre_separation(const PairKey& key) const {
        return rods_.centre[key.j] + box_.displacement(key.image) - rods_.centre[key.i];
    }

    const Rods& rods_;
    const Box& box_;
    const RodBlobs& blobs_;
    const CoupleFlow& flow_;
    const NearPairs& pairs_;
    std::vector<SideBlocks> blocks_;  ///< (2 pairs) in the order of sides
};

}  // namespace jostle
