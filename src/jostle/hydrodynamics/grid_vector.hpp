#pragma once

#include <complex>
#include <cstddef>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// Three numbers at a point of a grid, x, y, z, in a vector register; its fourth lane holds nothing.
///
/// It has the arithmetic of a number, lane by lane, so that KissFFT transforms all three at once.
struct alignas(32) GridVector {
    using Lanes [[gnu::vector_size(32)]] = double;
    Lanes lanes{};

    GridVector() = default;
    GridVector(const Lanes& values) : lanes(values) {}  // NOLINT: as a vector register
    /// The same in all lanes.
    GridVector(double value) : lanes{value, value, value, value} {}  // NOLINT: KissFFT writes numbers
    explicit GridVector(const Vec3& v) : lanes{v.x, v.y, v.z, 0.0} {}
    /// Of one that is the same in all lanes.
    operator double() const { return lanes[0]; }  // NOLINT: KissFFT takes sines of numbers

    Vec3 vector() const { return {lanes[0], lanes[1], lanes[2]}; }
    double sum() const { return lanes[0] + lanes[1] + lanes[2]; }

    GridVector& operator+=(const GridVector& other) { return lanes += other.lanes, *this; }
    GridVector& operator-=(const GridVector& other) { return lanes -= other.lanes, *this; }
    GridVector& operator*=(const GridVector& other) { return lanes *= other.lanes, *this; }
    GridVector operator-() const { return GridVector(-lanes); }
    friend GridVector operator+(const GridVector& a, const GridVector& b) { return GridVector(a.lanes + b.lanes); }
    friend GridVector operator-(const GridVector& a, const GridVector& b) { return GridVector(a.lanes - b.lanes); }
    friend GridVector operator*(const GridVector& a, const GridVector& b) { return GridVector(a.lanes * b.lanes); }
    friend GridVector operator*(const GridVector& a, double b) { return a * GridVector(b); }
    friend GridVector operator*(double a, const GridVector& b) { return GridVector(a) * b; }
    friend GridVector operator*(std::size_t a, const GridVector& b) { return static_cast<double>(a) * b; }
};

/// Three complex numbers of one wave. libstdc++ and libc++ take any number for std::complex, as KissFFT needs.
using WaveVector = std::complex<GridVector>;

}  // namespace jostle
