#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "jostle/hydrodynamics/axial_blob.hpp"
#include "jostle/hydrodynamics/ewald_split.hpp"
#include "jostle/hydrodynamics/fourier_grid.hpp"
#include "jostle/hydrodynamics/line_vector.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/hydrodynamics/spreading_kernel.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// The blobs of all rods on a periodic grid: forces are spread from them, and velocities gathered to them, by the same
/// weights.
///
/// Blobs are in the order of the points of the grid, along z and y, where they begin, and of the ids of their rods. So
/// neighbours in space are neighbours in memory, and no sum depends on threads or rows.
class GridBlobs {
public:
    /// Holds references to rods and blobs.
    GridBlobs(const Rods& rods, const Box& box, const RodBlobs& blobs, const EwaldSplit& split);

    /// field = sum over blobs of their forces.
    void spread(std::span<const LineVector> forces, std::vector<GridVector>& field) const;
    /// The same of axial stresslets.
    void spread(const AxialStresslets& stresslets, std::vector<GridVector>& field) const;
    /// velocities += what the field moves the rods by.
    void gather(const std::vector<GridVector>& field, std::span<LineVector> velocities) const;

    /// field = sum over spheres of their couples, axis x moment.
    void spread_couples(std::span<const LineVector> forces, std::vector<GridVector>& field) const;
    /// The moments of spheres += angular velocity x axis, of angular velocities on the grid.
    void gather_turning(const std::vector<GridVector>& field, std::span<LineVector> velocities) const;

private:
    struct Blob {
        std::array<std::uint32_t, 3> first;  ///< point of the grid that it is spread over, along each direction
        std::array<double, 3> offset;        ///< of its centre from that point, in spacings of the grid
        std::uint32_t row, number;           ///< of its rod, and on its line
    };
    /// Three times `points_` numbers a blob: of the kernel, or of its slope.
    using Weights = std::vector<float>;

    std::vector<Blob> blobs_by_ids(const Box& box);
    void sort(const std::vector<Blob>& by_ids);
    Vec3 velocity_of(std::size_t blob, const std::vector<GridVector>& field) const;
    template <class Value>
    Weights weights_of_blobs(Value&& value) const;
    template <class VectorOf>
    void spread_vectors(std::vector<GridVector>& field, VectorOf&& vector_of) const;
    template <class Acts, class AddRow>
    void spread_blobs(std::vector<GridVector>& field, Acts&& acts, AddRow&& add_row) const;
    /// A blob is spread over no more points than the grid has.
    std::size_t wrapped(std::size_t point, std::size_t direction) const {
        return point < grid_[direction] ? point : point - grid_[direction];
    }
    const float* of_blob(const Weights& weights, std::size_t blob, std::size_t direction) const {
        return &weights[(3 * blob + direction) * points_];
    }

    const Rods& rods_;
    const RodBlobs& blobs_;
    std::array<std::size_t, 3> grid_;
    std::size_t points_;
    SpreadingKernel kernel_;
    Vec3 per_length_;                          ///< points of the grid per length
    std::vector<std::uint32_t> rows_;          ///< in the order of ids
    std::vector<std::size_t> first_blob_;      ///< (N + 1) of the rods in this order
    std::vector<std::uint32_t> placed_index_;  ///< (blobs in this order) where each stands in `placed_`
    std::vector<Blob> placed_;                 ///< (blobs)
    std::vector<std::size_t> begin_;           ///< (planes of equal z + 1) of the blobs that begin there
    Weights weights_;
};

}  // namespace jostle
