#pragma once

#include <array>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// A 3 x 3 matrix, stored by rows; element (a, b) is m[3 a + b].
struct Mat3 {
    std::array<double, 9> m{};

    double& operator()(int a, int b) { return m[static_cast<std::size_t>(3 * a + b)]; }
    double operator()(int a, int b) const { return m[static_cast<std::size_t>(3 * a + b)]; }

    Mat3& operator+=(const Mat3& b) {
        for (std::size_t k = 0; k < 9; ++k) m[k] += b.m[k];
        return *this;
    }
    Mat3& operator-=(const Mat3& b) {
        for (std::size_t k = 0; k < 9; ++k) m[k] -= b.m[k];
        return *this;
    }
    Mat3& operator*=(double s) {
        for (double& value : m) value *= s;
        return *this;
    }
};

inline Mat3 operator+(Mat3 a, const Mat3& b) {
    return a += b;
}
inline Mat3 operator-(Mat3 a, const Mat3& b) {
    return a -= b;
}
inline Mat3 operator*(double s, Mat3 a) {
    return a *= s;
}

inline Mat3 identity() {
    return Mat3{{1, 0, 0, 0, 1, 0, 0, 0, 1}};
}

/// Of the space that bodies move in: of two dimensions that of the plane z = 0.
inline Mat3 identity(int dimensions) {
    return Mat3{{1, 0, 0, 0, 1, 0, 0, 0, dimensions == 2 ? 0.0 : 1.0}};
}

/// The dyad a b: element (k, l) is a_k b_l.
inline Mat3 outer(const Vec3& a, const Vec3& b) {
    return Mat3{{a.x * b.x, a.x * b.y, a.x * b.z, a.y * b.x, a.y * b.y, a.y * b.z, a.z * b.x, a.z * b.y, a.z * b.z}};
}

inline double trace(const Mat3& a) {
    return a(0, 0) + a(1, 1) + a(2, 2);
}

inline Mat3 transpose(const Mat3& a) {
    return Mat3{{a.m[0], a.m[3], a.m[6], a.m[1], a.m[4], a.m[7], a.m[2], a.m[5], a.m[8]}};
}

inline Vec3 operator*(const Mat3& a, const Vec3& v) {
    return {a.m[0] * v.x + a.m[1] * v.y + a.m[2] * v.z, a.m[3] * v.x + a.m[4] * v.y + a.m[5] * v.z,
            a.m[6] * v.x + a.m[7] * v.y + a.m[8] * v.z};
}

inline Mat3 operator*(const Mat3& a, const Mat3& b) {
    Mat3 product;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) product(i, j) = a(i, 0) * b(0, j) + a(i, 1) * b(1, j) + a(i, 2) * b(2, j);
    return product;
}

/// eps:a, element i is eps_ijk a_jk: all that the antisymmetric part of `a` holds. For a dyad b c it is b x c.
inline Vec3 axial_vector(const Mat3& a) {
    return {a(1, 2) - a(2, 1), a(2, 0) - a(0, 2), a(0, 1) - a(1, 0)};
}

inline bool is_finite(const Mat3& a) {
    for (double value : a.m)
        if (!std::isfinite(value)) return false;
    return true;
}

/// Frobenius norm.
inline double norm(const Mat3& a) {
    double sum = 0.0;
    for (double value : a.m) sum += value * value;
    return std::sqrt(sum);
}

}  // namespace jostle
