#include "jostle/hydrodynamics/rod_pair_flow.hpp"

#include "jostle/hydrodynamics/axial_blob.hpp"

namespace jostle {

namespace {

/// Three components of four vectors.
struct FourVectors {
    Four x, y, z;

    explicit FourVectors(const Vec3& v) : x(four(v.x)), y(four(v.y)), z(four(v.z)) {}
    FourVectors(const Four& vx, const Four& vy, const Four& vz) : x(vx), y(vy), z(vz) {}

    friend FourVectors operator-(const FourVectors& a, const FourVectors& b) {
        return {a.x - b.x, a.y - b.y, a.z - b.z};
    }
    friend FourVectors operator*(const Four& a, const FourVectors& b) { return {a * b.x, a * b.y, a * b.z}; }
    friend Four dot(const FourVectors& a, const FourVectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
};

/// Sums over blobs of isotropic I + radial r r, times a weight.
struct FourMatrices {
    std::array<Four, 6> m{};

    static FourMatrices of(const FourFlows& flow, const FourVectors& r) {
        const FourVectors radial = flow.radial * r;
        return {{flow.isotropic + radial.x * r.x, radial.x * r.y, radial.x * r.z, flow.isotropic + radial.y * r.y,
                 radial.y * r.z, flow.isotropic + radial.z * r.z}};
    }
    void add(const Four& weight, const FourMatrices& matrices) {
        for (std::size_t k = 0; k < 6; ++k) m[k] += weight * matrices.m[k];
    }
    SymmetricBlock sum() const {
        const Four first = sums(m[0], m[1], m[2], m[3]), last = sums(m[4], m[5], Four{}, Four{});
        return {first[0], first[1], first[2], first[3], last[0], last[1]};
    }
};

/// What the flow of the force `force` a and the dipole `dipole` a a is along a, and along r: `along` is r a. The
/// flow of the dipole is the derivative of that of the force as r grows along a (BlobFlowSlope::along).
struct AxialParts {
    Four on_axis, on_r;

    AxialParts(const FourFlowSlopes& of, const Four& along, const Four& force, const Four& dipole)
        : on_axis(force * of.flow.isotropic + dipole * (2.0F * of.slope.isotropic * along + of.flow.radial * along)),
          on_r(force * of.flow.radial * along + dipole * (2.0F * of.slope.radial * along * along + of.flow.radial)) {}
};

/// Sums of weights times on_axis a + on_r r.
struct AxialSum {
    Four along{}, x{}, y{}, z{};

    void add(const Four& weight, const AxialParts& parts, const FourVectors& r) {
        const Four on_r = weight * parts.on_r;
        along += weight * parts.on_axis;
        x += on_r * r.x;
        y += on_r * r.y;
        z += on_r * r.z;
    }
    Vec3 sum(const Vec3& axis) const {
        const Four all = sums(along, x, y, z);
        return static_cast<double>(all[0]) * axis + Vec3{all[1], all[2], all[3]};
    }
};

}  // namespace

RodPairFlow::RodPairFlow(const BlobLines& lines, const PairFlow& flow) : lines_(lines), flow_(flow) {
    for (const BlobLine& line : lines.lines) {
        std::vector<FourBlobs>& fours = fours_.emplace_back();
        for (std::size_t first = 0; first < line.place.size(); first += 4) {
            FourBlobs& blobs = fours.emplace_back(FourBlobs{four(line.place.back()), {}, {}});
            for (std::size_t lane = 0; lane < 4 && first + lane < line.place.size(); ++lane) {
                blobs.place[lane] = static_cast<float>(line.place[first + lane]);
                blobs.force_weight[lane] = static_cast<float>(line.force_weight[first + lane]);
                blobs.moment_weight[lane] = static_cast<float>(line.moment_weight[first + lane]);
            }
        }
    }
}

RodPairFlow::AxialBlobs RodPairFlow::axial_blobs(const AxialStresslets& stresslets, std::uint32_t row,
                                                 std::uint32_t line, const FourBlobs& blobs) const {
    const double dipole = stresslets.of_swimmers() ? stresslets.dipole[row] : 0.0;
    if (lines_.lines[line].is_sphere()) return {Four{}, Four{static_cast<float>(dipole)}};
    return {four(dipole - 2.0 * stresslets.kT) * blobs.moment_weight,
            four(-stresslets.kT) * blobs.moment_weight * blobs.place};
}

SideBlocks RodPairFlow::blocks(const RodPair& pair) const {
    return sums<false>(pair, {}, nullptr);
}

SideBlocks RodPairFlow::blocks(const RodPair& pair, const AxialStresslets& stresslets,
                               std::array<LineVector, 2>& axial_flow) const {
    return sums<true>(pair, stresslets, &axial_flow);
}

template <bool with_axial_flow>
SideBlocks RodPairFlow::sums(const RodPair& pair, const AxialStresslets& stresslets,
                             std::array<LineVector, 2>* axial_flow) const {
    const BlobLine& line_j = lines_.lines[pair.line[1]];
    const FourVectors axis_i(pair.axis[0]), axis_j(pair.axis[1]);
    FourMatrices centre_centre, centre_moment, moment_centre, moment_moment;
    AxialSum centre_i, moment_i, centre_j, moment_j;
    for (std::size_t c = 0; c < line_j.place.size(); ++c) {
        const FourVectors to_blob(pair.apart + line_j.place[c] * pair.axis[1]);
        const Four force_weight = four(line_j.force_weight[c]), moment_weight = four(line_j.moment_weight[c]);
        AxialBlob blob_j;
        if constexpr (with_axial_flow) blob_j = axial_blob(stresslets, pair.row[1], line_j, c);
        FourMatrices on_centre, on_moment;  // of i, from blob c of j
        for (const FourBlobs& blobs : fours_[pair.line[0]]) {
            const FourVectors r = to_blob - blobs.place * axis_i;
            const Four squared = dot(r, r);
            if (!flow_.any_flow(squared)) continue;
            FourFlowSlopes flow;
            if constexpr (with_axial_flow)
                flow = flow_.with_slope(squared);
            else
                flow.flow = flow_.at(squared);
            const FourMatrices matrices = FourMatrices::of(flow.flow, r);
            on_centre.add(blobs.force_weight, matrices);
            on_moment.add(blobs.moment_weight, matrices);
            if constexpr (with_axial_flow) {
                // r grows with the place of blob c, and falls with those of the blobs of i.
                const AxialParts of_j(flow, dot(r, axis_j), four(blob_j.force), four(blob_j.dipole));
                centre_i.add(blobs.force_weight, of_j, r);
                moment_i.add(blobs.moment_weight, of_j, r);
                const AxialBlobs blobs_i = axial_blobs(stresslets, pair.row[0], pair.line[0], blobs);
                const AxialParts of_i(flow, dot(r, axis_i), blobs_i.force, -blobs_i.dipole);
                centre_j.add(force_weight, of_i, r);
                moment_j.add(moment_weight, of_i, r);
            }
        }
        centre_centre.add(force_weight, on_centre);
        centre_moment.add(moment_weight, on_centre);
        moment_centre.add(force_weight, on_moment);
        moment_moment.add(moment_weight, on_moment);
    }
    if constexpr (with_axial_flow)
        *axial_flow = {LineVector{centre_i.sum(pair.axis[1]), moment_i.sum(pair.axis[1])},
                       LineVector{centre_j.sum(pair.axis[0]), moment_j.sum(pair.axis[0])}};
    return {centre_centre.sum(), centre_moment.sum(), moment_centre.sum(), moment_moment.sum()};
}

}  // namespace jostle
