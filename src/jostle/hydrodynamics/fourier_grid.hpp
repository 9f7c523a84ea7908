#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "jostle/hydrodynamics/grid_vector.hpp"

namespace jostle {

/// Discrete Fourier transforms of a real vector field on a periodic grid, by KissFFT.
///
/// Points are in the order (z, y, x), x fastest; waves too, of x only 0 ... points[0]/2, for the others are the complex
/// conjugates of their mirror images. No threads, instruction set or plan changes a bit.
class FourierGrid {
public:
    /// `points` along x, y, z: even.
    explicit FourierGrid(const std::array<std::size_t, 3>& points)
        : points_(points),
          field(points[0] * points[1] * points[2]),
          waves((points[0] / 2 + 1) * points[1] * points[2]) {}

    const std::array<std::size_t, 3>& points() const { return points_; }
    std::size_t waves_along_x() const { return points_[0] / 2 + 1; }

    /// waves = sum over points of field exp(-i k x).
    void forward();
    /// field = sum over all waves of waves exp(i k x); `waves` is overwritten.
    void backward();

private:
    void transform_columns(bool inverse, std::size_t planes, std::size_t length, std::size_t plane_stride,
                           std::size_t stride);
    std::array<std::size_t, 3> points_;

public:
    std::vector<GridVector> field;  ///< (z, y, x)
    std::vector<WaveVector> waves;  ///< (z, y, x up to points[0]/2)
};

}  // namespace jostle
