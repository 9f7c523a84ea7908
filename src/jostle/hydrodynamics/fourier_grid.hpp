#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "jostle/hydrodynamics/grid_vector.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

/// How often wave n of so many points goes round; beyond half the grid it stands for a negative one.
inline double wave_number(std::size_t n, std::size_t points) {
    return static_cast<double>(n) - (2 * n > points ? static_cast<double>(points) : 0.0);
}

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

    /// Calls body(wave, x, y, z) for the place of every wave in `waves` and its numbers; planes of z on any threads.
    template <class Body>
    void for_each_wave(Body&& body) const {
        const std::size_t wx = waves_along_x(), rows = points_[1];
        parallel_for_parts(points_[2], [&](std::size_t z) {
            for (std::size_t y = 0; y < rows; ++y)
                for (std::size_t x = 0; x < wx; ++x) body((z * rows + y) * wx + x, x, y, z);
        });
    }

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
