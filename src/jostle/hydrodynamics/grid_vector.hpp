#pragma once

#include <complex>
#include <cstddef>
#include <type_traits>

#include "jostle/math/four.hpp"
#include "jostle/math/vec3.hpp"

namespace jostle {

/// Three numbers at a point of a grid, x, y, z, in a vector register; its fourth lane holds nothing.
///
/// It has the arithmetic of a number, lane by lane, so that KissFFT transforms all three at once. Floats: a register of
/// every processor holds them, and their rounding, 1e-7 of a flow, is below every tolerance (decision 0074).
struct alignas(16) GridVector {
    using Lanes = Four;
    Lanes lanes{};

    GridVector() = default;
    GridVector(const Lanes& values) : lanes(values) {}  // NOLINT: as a vector register
    /// The same in all lanes.
    template <class Number, class = std::enable_if_t<std::is_arithmetic_v<Number>>>
    GridVector(Number value) : lanes(four(static_cast<double>(value))) {}  // NOLINT: KissFFT writes numbers
    explicit GridVector(const Vec3& v)
        : lanes{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), 0.0F} {}
    /// Of one that is the same in all lanes.
    operator double() const { return lanes[0]; }  // NOLINT: KissFFT takes sines of numbers

    Vec3 vector() const { return {lanes[0], lanes[1], lanes[2]}; }
    float sum() const { return lanes[0] + lanes[1] + lanes[2]; }

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
