#include "jostle/hydrodynamics/near_couples.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

NearCouples::NearCouples(const Rods& rods, const Box& box, const RodBlobs& blobs, const CoupleFlow& flow,
                         const NearPairs& pairs)
    : rods_(rods), box_(box), blobs_(blobs), flow_(flow), pairs_(pairs), blocks_(pairs.sides().size()) {
    std::vector<SideBlocks> of_pairs(pairs_.pairs().size());
    parallel_for(of_pairs.size(), [&](std::size_t p) { of_pairs[p] = blocks_of(pairs_.pairs()[p]); });
    parallel_for(blocks_.size(), [&](std::size_t entry) {
        const std::uint32_t side = pairs_.sides()[entry];
        blocks_[entry] = side % 2 == 0 ? of_pairs[side / 2] : turned(of_pairs[side / 2]);
    });
}

/// Of the first rod of the pair. Vectors from couples to blobs, and from blobs to couples.
NearCouples::SideBlocks NearCouples::blocks_of(const PairKey& key) const {
    const BlobLine &line_i = blobs_.of(key.i), &line_j = blobs_.of(key.j);
    const Vec3 apart = centre_separation(key);
    SideBlocks blocks;
    if (line_j.is_sphere()) {
        Vec3 on_centre, on_moment;
        for (std::size_t b = 0; b < line_i.place.size(); ++b) {
            const Vec3 r = line_i.place[b] * rods_.axis[key.i] - apart;
            const Vec3 flow = flow_.rotlet(squared_norm(r)).value * r;
            on_centre += line_i.force_weight[b] * flow;
            on_moment += line_i.moment_weight[b] * flow;
        }
        blocks.centre_couple = Vector(on_centre);
        blocks.moment_couple = Vector(on_moment);
    }
    if (line_i.is_sphere()) {
        Vec3 of_centre, of_moment;
        for (std::size_t c = 0; c < line_j.place.size(); ++c) {
            const Vec3 r = -apart - line_j.place[c] * rods_.axis[key.j];
            const Vec3 flow = flow_.rotlet(squared_norm(r)).value * r;
            of_centre += line_j.force_weight[c] * flow;
            of_moment += line_j.moment_weight[c] * flow;
        }
        blocks.couple_centre = Vector(of_centre);
        blocks.couple_moment = Vector(of_moment);
    }
    if (line_i.is_sphere() && line_j.is_sphere()) {
        const BlobFlow turning = flow_.turning(squared_norm(apart));
        blocks.between = Vector(apart);
        blocks.isotropic = static_cast<float>(turning.isotropic);
        blocks.radial = static_cast<float>(turning.radial);
    }
    return blocks;
}

/// Of the other rod: the transpose.
NearCouples::SideBlocks NearCouples::turned(const SideBlocks& side) {
    return {-side.couple_centre, -side.couple_moment, -side.centre_couple, -side.moment_couple,
            side.between,        side.isotropic,      side.radial};
}

void NearCouples::add_flow(std::span<const LineVector> forces, std::span<LineVector> velocities) const {
    parallel_for(rods_.size(), [&](std::size_t i) {
        LineVector sum;
        Vec3 turning;
        for (std::size_t entry = pairs_.begin()[i]; entry < pairs_.begin()[i + 1]; ++entry) {
            const SideBlocks& blocks = blocks_[entry];
            const std::uint32_t j = pairs_.others()[entry];
            const Vec3 couple = cross(rods_.axis[j], forces[j].moment), between = blocks.between.value();
            sum.centre += cross(couple, blocks.centre_couple.value());
            sum.moment += cross(couple, blocks.moment_couple.value());
            turning += cross(forces[j].centre, blocks.couple_centre.value()) +
                       cross(forces[j].moment, blocks.couple_moment.value()) +
                       (double(blocks.radial) * dot(between, couple)) * between + double(blocks.isotropic) * couple;
        }
        velocities[i].centre += sum.centre;
        velocities[i].moment += across(rods_.axis[i], sum.moment) + cross(turning, rods_.axis[i]);
    });
}

/// Angular velocity of the first of the pair in the flow of the other.
Vec3 NearCouples::turning_of(const PairKey& key, const AxialStresslets& stresslets) const {
    const BlobLine& line_j = blobs_.of(key.j);
    const Vec3 apart = centre_separation(key), &axis = rods_.axis[key.j];
    double sum = 0.0;
    for (std::size_t c = 0; c < line_j.place.size(); ++c) {
        const AxialBlob blob = axial_blob(stresslets, key.j, line_j, c);
        const Vec3 r = -apart - line_j.place[c] * axis;
        const CoupleFlow::Rotlet rotlet = flow_.rotlet(squared_norm(r));
        // The dipole is the derivative by the blob's place, with which r falls.
        sum += blob.force * rotlet.value - 2.0 * blob.dipole * rotlet.slope * dot(axis, r);
    }
    return -sum * cross(axis, apart);  // axis x r is the same for all blobs
}

void NearCouples::add_axial_flow(const AxialStresslets& stresslets, std::span<LineVector> velocities) const {
    parallel_for(rods_.size(), [&](std::size_t i) {
        if (!blobs_.of(i).is_sphere()) return;
        Vec3 turning;
        for (std::size_t entry = pairs_.begin()[i]; entry < pairs_.begin()[i + 1]; ++entry) {
            const std::uint32_t side = pairs_.sides()[entry];
            const PairKey& key = pairs_.pairs()[side / 2];
            turning += turning_of(side % 2 == 0 ? key : key.turned(), stresslets);
        }
        velocities[i].moment += cross(turning, rods_.axis[i]);
    });
}

}  // namespace jostle
