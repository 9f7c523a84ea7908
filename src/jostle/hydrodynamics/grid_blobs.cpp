#include "jostle/hydrodynamics/grid_blobs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

GridBlobs::GridBlobs(const Rods& rods, const Box& box, const RodBlobs& blobs, const EwaldSplit& split)
    : rods_(rods),
      blobs_(blobs),
      grid_(split.grid),
      points_(static_cast<std::size_t>(split.spread_points)),
      kernel_(split.spread_points),
      per_length_{static_cast<double>(grid_[0]) / box.edges().x, static_cast<double>(grid_[1]) / box.edges().y,
                  static_cast<double>(grid_[2]) / box.edges().z},
      rows_(rods.size()),
      first_blob_(rods.size() + 1, 0) {
    std::iota(rows_.begin(), rows_.end(), 0U);
    std::sort(rows_.begin(), rows_.end(), [&](std::uint32_t a, std::uint32_t b) { return rods.id[a] < rods.id[b]; });
    for (std::size_t k = 0; k < rows_.size(); ++k)
        first_blob_[k + 1] = first_blob_[k] + blobs_.of(rows_[k]).place.size();
    sort(blobs_by_ids(box));
    weights_ = weights_of_blobs([this](double x, std::size_t) { return kernel_.value(x); });
}

std::vector<GridBlobs::Blob> GridBlobs::blobs_by_ids(const Box& box) {
    std::vector<Blob> blobs(first_blob_.back());
    parallel_for(rows_.size(), [&](std::size_t k) {
        const std::uint32_t row = rows_[k];
        const BlobLine& line = blobs_.of(row);
        for (std::size_t b = 0; b < line.place.size(); ++b) {
            Blob& blob = blobs[first_blob_[k] + b];
            blob.row = row;
            blob.number = static_cast<std::uint32_t>(b);
            const Vec3 centre = rods_.centre[row] + line.place[b] * rods_.axis[row];
            for (int d = 0; d < 3; ++d) {
                const auto direction = static_cast<std::size_t>(d);
                const double edge = box.edges()[d];
                const double at = (centre[d] - std::floor(centre[d] / edge) * edge) * per_length_[d];
                const double first = std::ceil(at - 0.5 * static_cast<double>(points_));
                blob.offset[direction] = at - first;
                const auto n = static_cast<double>(grid_[direction]);
                blob.first[direction] = static_cast<std::uint32_t>(first - std::floor(first / n) * n);
            }
        }
    });
    return blobs;
}

void GridBlobs::sort(const std::vector<Blob>& by_ids) {
    const auto line_of = [this](const Blob& blob) { return blob.first[2] * grid_[1] + blob.first[1]; };
    std::vector<std::size_t> next(grid_[1] * grid_[2] + 1, 0);
    for (const Blob& blob : by_ids) ++next[line_of(blob) + 1];
    for (std::size_t line = 0; line + 1 < next.size(); ++line) next[line + 1] += next[line];
    begin_.resize(grid_[2] + 1);
    for (std::size_t plane = 0; plane <= grid_[2]; ++plane) begin_[plane] = next[plane * grid_[1]];
    placed_.resize(by_ids.size());
    placed_index_.resize(by_ids.size());
    for (std::size_t k = 0; k < by_ids.size(); ++k) {
        const std::size_t place = next[line_of(by_ids[k])]++;
        placed_[place] = by_ids[k];
        placed_index_[k] = static_cast<std::uint32_t>(place);
    }
}

/// value(x, place) at x spacings from each blob.
template <class Value>
GridBlobs::Weights GridBlobs::weights_of_blobs(Value&& value) const {
    Weights weights(3 * points_ * placed_.size());
    parallel_for(placed_.size(), [&](std::size_t k) {
        for (std::size_t direction = 0; direction < 3; ++direction)
            for (std::size_t p = 0; p < points_; ++p) {
                const std::size_t place = (3 * k + direction) * points_ + p;
                const double x = static_cast<double>(p) - placed_[k].offset[direction];
                weights[place] = static_cast<float>(value(x, place));
            }
    });
    return weights;
}

/// Calls add_row(blob, y, z, row of the grid, places along x) for the rows of points that each blob that acts(blob) is
/// spread over; y and z count its own points.
template <class Acts, class AddRow>
void GridBlobs::spread_blobs(std::vector<GridVector>& field, Acts&& acts, AddRow&& add_row) const {
    const std::size_t in_plane = grid_[0] * grid_[1];
    parallel_for_parts(grid_[2], [&](std::size_t plane) {
        GridVector* const corner = field.data() + plane * in_plane;
        std::fill(corner, corner + in_plane, GridVector{});
        std::array<std::size_t, max_spread_points> along_x{};
        for (std::size_t z = 0; z < points_; ++z) {
            const std::size_t began = wrapped(plane + grid_[2] - z, 2);
            for (std::size_t blob = begin_[began]; blob < begin_[began + 1]; ++blob) {
                if (!acts(blob)) continue;
                const std::array<std::uint32_t, 3>& first = placed_[blob].first;
                for (std::size_t p = 0; p < points_; ++p) along_x[p] = wrapped(first[0] + p, 0);
                for (std::size_t y = 0; y < points_; ++y)
                    add_row(blob, y, z, corner + wrapped(first[1] + y, 1) * grid_[0], along_x.data());
            }
        }
    });
}

/// vector_of(blob, its line) at each blob.
template <class VectorOf>
void GridBlobs::spread_vectors(std::vector<GridVector>& field, VectorOf&& vector_of) const {
    std::vector<GridVector> vector(placed_.size());
    parallel_for(placed_.size(), [&](std::size_t k) {
        const Blob& blob = placed_[k];
        vector[k] = GridVector(vector_of(blob, blobs_.of(blob.row)));
    });
    const auto acts = [&](std::size_t k) { return any(vector[k].lanes != Four{}); };
    spread_blobs(
        field, acts, [&](std::size_t k, std::size_t y, std::size_t z, GridVector* row, const std::size_t* along_x) {
            const float* const weight = of_blob(weights_, k, 0);
            const GridVector::Lanes share = vector[k].lanes * (of_blob(weights_, k, 1)[y] * of_blob(weights_, k, 2)[z]);
            for (std::size_t p = 0; p < points_; ++p) row[along_x[p]].lanes += weight[p] * share;
        });
}

void GridBlobs::spread(std::span<const LineVector> forces, std::vector<GridVector>& field) const {
    spread_vectors(field, [&](const Blob& blob, const BlobLine& line) {
        const LineVector& of_rod = forces[blob.row];
        return line.force_weight[blob.number] * of_rod.centre + line.moment_weight[blob.number] * of_rod.moment;
    });
}

void GridBlobs::spread_couples(std::span<const LineVector> forces, std::vector<GridVector>& field) const {
    spread_vectors(field, [&](const Blob& blob, const BlobLine& line) {
        return line.is_sphere() ? cross(rods_.axis[blob.row], forces[blob.row].moment) : Vec3{};
    });
}

void GridBlobs::spread(const AxialStresslets& stresslets, std::vector<GridVector>& field) const {
    // By how much the weight of a point grows as the blob goes on: the other way round than as the point does.
    const Weights slopes =
        weights_of_blobs([this](double x, std::size_t place) { return -weights_[place] * kernel_.relative_slope(x); });
    const auto acts = [](std::size_t) { return true; };
    spread_blobs(
        field, acts, [&](std::size_t k, std::size_t y, std::size_t z, GridVector* row, const std::size_t* along_x) {
            const Blob& blob = placed_[k];
            const BlobLine& line = blobs_.of(blob.row);
            const Vec3& axis = rods_.axis[blob.row];
            const auto [force, dipole] = axial_blob(stresslets, blob.row, line, blob.number);
            const double weight_y = of_blob(weights_, k, 1)[y], weight_z = of_blob(weights_, k, 2)[z];
            const double across_x =
                force * weight_y * weight_z + dipole * (axis.y * per_length_.y * of_blob(slopes, k, 1)[y] * weight_z +
                                                        axis.z * per_length_.z * of_blob(slopes, k, 2)[z] * weight_y);
            const double on_slope = dipole * axis.x * per_length_.x * weight_y * weight_z;
            const GridVector::Lanes direction = GridVector(axis).lanes;
            for (std::size_t p = 0; p < points_; ++p) {
                const double weight = across_x * of_blob(weights_, k, 0)[p] + on_slope * of_blob(slopes, k, 0)[p];
                row[along_x[p]].lanes += static_cast<float>(weight) * direction;
            }
        });
}

void GridBlobs::gather(const std::vector<GridVector>& field, std::span<LineVector> velocities) const {
    std::vector<Vec3> of_blobs(placed_.size());
    parallel_for(placed_.size(), [&](std::size_t blob) { of_blobs[blob] = velocity_of(blob, field); });
    parallel_for(rows_.size(), [&](std::size_t k) {
        const std::uint32_t row = rows_[k];
        const BlobLine& line = blobs_.of(row);
        LineVector sum;
        for (std::size_t b = 0; b < line.place.size(); ++b) {
            const Vec3& u = of_blobs[placed_index_[first_blob_[k] + b]];
            sum.centre += line.force_weight[b] * u;
            sum.moment += line.moment_weight[b] * u;
        }
        velocities[row].centre += sum.centre;
        velocities[row].moment += across(rods_.axis[row], sum.moment);
    });
}

void GridBlobs::gather_turning(const std::vector<GridVector>& field, std::span<LineVector> velocities) const {
    parallel_for(rows_.size(), [&](std::size_t k) {
        const std::uint32_t row = rows_[k];
        if (!blobs_.of(row).is_sphere()) return;
        velocities[row].moment += cross(velocity_of(placed_index_[first_blob_[k]], field), rods_.axis[row]);
    });
}

Vec3 GridBlobs::velocity_of(std::size_t blob, const std::vector<GridVector>& field) const {
    const std::array<std::uint32_t, 3>& first = placed_[blob].first;
    const float* const weight = of_blob(weights_, blob, 0);
    std::array<std::size_t, max_spread_points> along_x{};
    for (std::size_t p = 0; p < points_; ++p) along_x[p] = wrapped(first[0] + p, 0);
    GridVector velocity;
    for (std::size_t z = 0; z < points_; ++z)
        for (std::size_t y = 0; y < points_; ++y) {
            const GridVector* const line =
                &field[(wrapped(first[2] + z, 2) * grid_[1] + wrapped(first[1] + y, 1)) * grid_[0]];
            GridVector of_line;
            for (std::size_t p = 0; p < points_; ++p) of_line.lanes += weight[p] * line[along_x[p]].lanes;
            velocity.lanes += (of_blob(weights_, blob, 1)[y] * of_blob(weights_, blob, 2)[z]) * of_line.lanes;
        }
    return velocity.vector();
}

}  // namespace jostle
