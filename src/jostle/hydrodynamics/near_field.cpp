#include "jostle/hydrodynamics/near_field.hpp"

#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// The product with x, y, z of v, in the first three lanes.
inline Four product(const SymmetricBlock& m, const Four& v) {
    const Four low{m[0], m[1], m[2], m[3]}, high{m[2], m[3], m[4], m[5]};
    return low * __builtin_shufflevector(v, v, 0, 0, 0, 0) +
           __builtin_shufflevector(low, high, 1, 3, 6, 7) * __builtin_shufflevector(v, v, 1, 1, 1, 1) +
           __builtin_shufflevector(low, high, 2, 6, 7, 7) * __builtin_shufflevector(v, v, 2, 2, 2, 2);
}

inline Vec3 first_three(const Four& v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

NearField::NearField(const Rods& rods, const Box& box, const RodBlobs& blobs, const PairFlow& flow,
                     std::vector<RodMobility> own, NearMemory& memory, const AxialStresslets* stresslets)
    : rods_(rods), box_(box), blobs_(blobs), rod_pairs_(*blobs.kinds, flow), own_(std::move(own)), memory_(memory) {
    memory_.pairs.find(rods, box, blobs, flow.cutoff());
    sum_blobs(stresslets);
}

void NearField::sum_blobs(const AxialStresslets* stresslets) {
    const auto pairs = memory_.pairs.pairs();
    memory_.blocks.resize(pairs.size());
    memory_.received.resize(stresslets ? pairs.size() : 0);
    parallel_for(pairs.size(), [&](std::size_t p) {
        if (!stresslets) {
            memory_.blocks[p] = rod_pairs_.blocks(placed(pairs[p]));
            return;
        }
        std::array<LineVector, 2> axial_flow;
        memory_.blocks[p] = rod_pairs_.blocks(placed(pairs[p]), *stresslets, axial_flow);
        memory_.received[p] = {RoundedVector(axial_flow[0]), RoundedVector(axial_flow[1])};
    });
}

RodPair NearField::placed(const PairKey& key) const {
    return {{key.i, key.j},
            {blobs_.line_of[key.i], blobs_.line_of[key.j]},
            {rods_.axis[key.i], rods_.axis[key.j]},
            rods_.centre[key.j] + box_.displacement(key.image) - rods_.centre[key.i]};
}

/// Adds received(entry of the sides) of all pairs of each rod.
template <class Received>
void NearField::gather(std::span<LineVector> velocities, Received&& received) const {
    const auto begin = memory_.pairs.begin();
    parallel_for(rods_.size(), [&](std::size_t i) {
        LineVector sum;
        for (std::size_t entry = begin[i]; entry < begin[i + 1]; ++entry) received(entry, sum);
        velocities[i].centre += sum.centre;
        velocities[i].moment += across(rods_.axis[i], sum.moment);
    });
}

void NearField::apply(std::span<const LineVector> forces, std::span<LineVector> velocities) const {
    parallel_for(rods_.size(), [&](std::size_t i) {
        const RodMobility& own = own_[blobs_.line_of[i]];
        const Vec3 &axis = rods_.axis[i], &force = forces[i].centre;
        velocities[i] = {own.perpendicular * force + ((own.parallel - own.perpendicular) * dot(axis, force)) * axis,
                         own.rotational * forces[i].moment};
    });
    std::vector<RoundedVector> rounded(rods_.size());
    parallel_for(rounded.size(), [&](std::size_t i) { rounded[i] = RoundedVector(forces[i]); });
    const auto others = memory_.pairs.others(), sides = memory_.pairs.sides();
    gather(velocities, [&](std::size_t entry, LineVector& sum) {
        const RoundedVector& other = rounded[others[entry]];
        if (other.is_zero()) return;  // as most, where only contacts push
        const SideBlocks& blocks = memory_.blocks[sides[entry] / 2];
        const bool is_second = sides[entry] % 2 == 1;
        const SymmetricBlock& centre_moment = is_second ? blocks.moment_centre : blocks.centre_moment;
        const SymmetricBlock& moment_centre = is_second ? blocks.centre_moment : blocks.moment_centre;
        sum.centre += first_three(product(blocks.centre_centre, other.centre) + product(centre_moment, other.moment));
        sum.moment += first_three(product(moment_centre, other.centre) + product(blocks.moment_moment, other.moment));
    });
}

void NearField::add_axial_flow(std::span<LineVector> velocities) const {
    const auto sides = memory_.pairs.sides();
    gather(velocities, [&](std::size_t entry, LineVector& sum) {
        const RoundedVector& from = memory_.received[sides[entry] / 2][sides[entry] % 2];
        sum.centre += first_three(from.centre);
        sum.moment += first_three(from.moment);
    });
}

}  // namespace jostle
