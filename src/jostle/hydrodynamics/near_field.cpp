#include "jostle/hydrodynamics/near_field.hpp"

#include <algorithm>
#include <tuple>

#include "jostle/contact/cell_list.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr Image home{0, 0, 0};

/// Each pair is found once: by the rod with the smaller id, a rod's own image by that ahead of it.
bool is_first(const PairKey& key, std::span<const std::uint64_t> ids) {
    return key.i == key.j ? key.image > home : ids[key.i] < ids[key.j];
}

struct SymmetricSum {
    std::array<double, 6> m{};

    void add(double weight, const BlobFlow& flow, const Vec3& r) {
        const double isotropic = weight * flow.isotropic;
        const Vec3 radial = (weight * flow.radial) * r;
        m[0] += isotropic + radial.x * r.x;
        m[1] += radial.x * r.y;
        m[2] += radial.x * r.z;
        m[3] += isotropic + radial.y * r.y;
        m[4] += radial.y * r.z;
        m[5] += isotropic + radial.z * r.z;
    }
    std::array<float, 6> rounded() const {
        std::array<float, 6> block;
        for (std::size_t k = 0; k < 6; ++k) block[k] = static_cast<float>(m[k]);
        return block;
    }
};

inline void add_product(const std::array<float, 6>& a, const Vec3& v, Vec3& sum) {
    sum.x += a[0] * v.x + a[1] * v.y + a[2] * v.z;
    sum.y += a[1] * v.x + a[3] * v.y + a[4] * v.z;
    sum.z += a[2] * v.x + a[4] * v.y + a[5] * v.z;
}

}  // namespace

NearField::NearField(const Rods& rods, const Box& box, const RodBlobs& blobs, const PairFlow& flow,
                     std::vector<RodMobility> own)
    : rods_(rods), box_(box), blobs_(blobs), flow_(flow), own_(std::move(own)) {
    find_pairs(box);
    list_incidence();
    std::vector<std::uint32_t> place(incidence_.size());
    parallel_for(place.size(),
                 [&](std::size_t entry) { place[incidence_[entry]] = static_cast<std::uint32_t>(entry); });
    blocks_.resize(place.size());
    parallel_for(pairs_.size(), [&](std::size_t p) {
        const SideBlocks of_i = blocks_of(pairs_[p]);
        blocks_[place[2 * p]] = of_i;
        blocks_[place[2 * p + 1]] = {of_i.centre_centre, of_i.moment_centre, of_i.centre_moment, of_i.moment_moment};
    });
}

void NearField::find_pairs(const Box& box) {
    std::vector<std::vector<PairKey>> found;
    const auto keep = [&](std::vector<PairKey>& mine, const PairKey& key) {
        if (is_first(key, rods_.id) && meet(key)) mine.push_back(key);
    };
    if (!box.is_periodic()) {
        found.resize(rods_.size());
        parallel_for(rods_.size(), [&](std::size_t i) {
            for (std::uint32_t j = 0; j < rods_.size(); ++j)
                if (j != i) keep(found[i], {static_cast<std::uint32_t>(i), j, home});
        });
    } else {
        const CellList cells(rods_, box, flow_.cutoff() + 2.0 * blobs_.longest_half());
        found.resize(cells.size());
        parallel_for_parts(cells.size(), [&](std::size_t cell) {
            for (const std::uint32_t i : cells.rods_in(cell))
                cells.visit(cell, [&](std::span<const std::uint32_t> rods, const Image& image) {
                    for (const std::uint32_t j : rods)
                        if (j != i || image != home) keep(found[cell], {i, j, image});
                });
        });
    }
    for (const auto& part : found) pairs_.insert(pairs_.end(), part.begin(), part.end());
}

/// Whether two blobs are nearer than the cutoff.
bool NearField::meet(const PairKey& key) const {
    const BlobLine &line_i = blobs_.of(key.i), &line_j = blobs_.of(key.j);
    const Vec3 apart = centre_separation(key);
    const double cutoff = flow_.cutoff(), range = cutoff + line_i.half() + line_j.half();
    const double squared = squared_norm(apart);
    if (!(squared < range * range)) return false;
    const double on_i = 2.0 * dot(apart, rods_.axis[key.i]), on_j = 2.0 * dot(apart, rods_.axis[key.j]);
    const double cosine = 2.0 * dot(rods_.axis[key.i], rods_.axis[key.j]);
    for (const double s_i : line_i.place)
        for (const double s_j : line_j.place)
            if (squared + s_i * (s_i - on_i) + s_j * (s_j + on_j - s_i * cosine) < cutoff * cutoff) return true;
    return false;
}

NearField::SideBlocks NearField::blocks_of(const PairKey& key) const {
    const BlobLine &line_i = blobs_.of(key.i), &line_j = blobs_.of(key.j);
    const Vec3 apart = centre_separation(key), axis_i = rods_.axis[key.i], axis_j = rods_.axis[key.j];
    const double squared_cutoff = flow_.cutoff() * flow_.cutoff();
    SymmetricSum centre_centre, centre_moment, moment_centre, moment_moment;
    for (std::size_t c = 0; c < line_j.place.size(); ++c) {
        SymmetricSum on_centre, on_moment;  // of i, from blob c of j
        const Vec3 to_blob = apart + line_j.place[c] * axis_j;
        for (std::size_t b = 0; b < line_i.place.size(); ++b) {
            const Vec3 r = to_blob - line_i.place[b] * axis_i;
            const double squared = squared_norm(r);
            if (!(squared < squared_cutoff)) continue;
            const BlobFlow flow = flow_.at(squared);
            on_centre.add(line_i.force_weight[b], flow, r);
            on_moment.add(line_i.moment_weight[b], flow, r);
        }
        for (std::size_t k = 0; k < 6; ++k) {
            centre_centre.m[k] += line_j.force_weight[c] * on_centre.m[k];
            centre_moment.m[k] += line_j.moment_weight[c] * on_centre.m[k];
            moment_centre.m[k] += line_j.force_weight[c] * on_moment.m[k];
            moment_moment.m[k] += line_j.moment_weight[c] * on_moment.m[k];
        }
    }
    return {centre_centre.rounded(), centre_moment.rounded(), moment_centre.rounded(), moment_moment.rounded()};
}

/// What the two rods of the pair get from stresslets on each other.
std::array<LineVector, 2> NearField::flows_of(const PairKey& key, const AxialStresslets& stresslets) const {
    const BlobLine &line_i = blobs_.of(key.i), &line_j = blobs_.of(key.j);
    const Vec3 apart = centre_separation(key), axis_i = rods_.axis[key.i], axis_j = rods_.axis[key.j];
    const double squared_cutoff = flow_.cutoff() * flow_.cutoff();
    LineVector on_i, on_j;
    for (std::size_t b = 0; b < line_i.place.size(); ++b) {
        const AxialBlob blob_i = axial_blob(stresslets, key.i, line_i, b);
        Vec3 velocity;  // of blob b
        for (std::size_t c = 0; c < line_j.place.size(); ++c) {
            const Vec3 r = apart + line_j.place[c] * axis_j - line_i.place[b] * axis_i;
            const double squared = squared_norm(r);
            if (!(squared < squared_cutoff)) continue;
            const BlobFlowSlope flow = flow_.with_slope(squared);
            // r grows with the place of blob c, whose dipole is the derivative of its flow by this place; and falls
            // with that of blob b.
            const AxialBlob blob_j = axial_blob(stresslets, key.j, line_j, c);
            velocity += blob_j.force * flow.flow.of(r, axis_j) + blob_j.dipole * flow.along(r, axis_j);
            const Vec3 of_j = blob_i.force * flow.flow.of(r, axis_i) - blob_i.dipole * flow.along(r, axis_i);
            on_j.centre += line_j.force_weight[c] * of_j;
            on_j.moment += line_j.moment_weight[c] * of_j;
        }
        on_i.centre += line_i.force_weight[b] * velocity;
        on_i.moment += line_i.moment_weight[b] * velocity;
    }
    return {on_i, on_j};
}

void NearField::list_incidence() {
    begin_.assign(rods_.size() + 1, 0);
    incidence_.resize(2 * pairs_.size());
    for (const PairKey& pair : pairs_) {
        ++begin_[pair.i + 1];
        ++begin_[pair.j + 1];
    }
    for (std::size_t i = 0; i < rods_.size(); ++i) begin_[i + 1] += begin_[i];
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        incidence_[next[pairs_[p].i]++] = static_cast<std::uint32_t>(2 * p);
        incidence_[next[pairs_[p].j]++] = static_cast<std::uint32_t>(2 * p + 1);
    }
    const auto order = [this](std::uint32_t side) {
        const PairKey& pair = pairs_[side / 2];
        return side % 2 == 0 ? std::tuple(rods_.id[pair.j], pair.image)
                             : std::tuple(rods_.id[pair.i], pair.turned().image);
    };
    parallel_for(rods_.size(), [&](std::size_t i) {
        std::sort(incidence_.begin() + static_cast<std::ptrdiff_t>(begin_[i]),
                  incidence_.begin() + static_cast<std::ptrdiff_t>(begin_[i + 1]),
                  [&](std::uint32_t a, std::uint32_t b) { return order(a) < order(b); });
    });
    others_.resize(incidence_.size());
    parallel_for(others_.size(), [&](std::size_t entry) {
        const PairKey& pair = pairs_[incidence_[entry] / 2];
        others_[entry] = incidence_[entry] % 2 == 0 ? pair.j : pair.i;
    });
}

/// Adds received(entry of incidence_) of all pairs of each rod.
template <class Received>
void NearField::gather(std::span<LineVector> velocities, Received&& received) const {
    parallel_for(rods_.size(), [&](std::size_t i) {
        LineVector sum;
        for (std::size_t entry = begin_[i]; entry < begin_[i + 1]; ++entry) received(entry, sum);
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
    gather(velocities, [&](std::size_t entry, LineVector& sum) {
        const SideBlocks& blocks = blocks_[entry];
        const LineVector& other = forces[others_[entry]];
        add_product(blocks.centre_centre, other.centre, sum.centre);
        add_product(blocks.centre_moment, other.moment, sum.centre);
        add_product(blocks.moment_centre, other.centre, sum.moment);
        add_product(blocks.moment_moment, other.moment, sum.moment);
    });
}

void NearField::add_axial_flow(const AxialStresslets& stresslets, std::span<LineVector> velocities) const {
    std::vector<std::array<LineVector, 2>> received(pairs_.size());
    parallel_for(pairs_.size(), [&](std::size_t p) { received[p] = flows_of(pairs_[p], stresslets); });
    gather(velocities,
           [&](std::size_t entry, LineVector& sum) { sum += received[incidence_[entry] / 2][incidence_[entry] % 2]; });
}

}  // namespace jostle
