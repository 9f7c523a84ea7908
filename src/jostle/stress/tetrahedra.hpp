#pragma once

#include <span>

#include "jostle/stress/body_moments.hpp"

// The sum behind meshes and convex hulls: a body cut into tetrahedra that share one corner.

namespace jostle {

/// Moments of the signed tetrahedra between one point and triangles (theory, eq. 1.13).
class Tetrahedra {
public:
    explicit Tetrahedra(const Vec3& apex) : apex_(apex) {}

    /// Positive where (a, b, c) is anticlockwise seen from the side away from the apex.
    void add(const Vec3& corner_a, const Vec3& corner_b, const Vec3& corner_c) {
        const Vec3 a = corner_a - apex_, b = corner_b - apex_, c = corner_c - apex_;
        const double volume = dot(a, cross(b, c)) / 6.0;
        const Vec3 sum = a + b + c;
        volume_ += volume;
        first_ += (volume / 4.0) * sum;
        second_ += (volume / 20.0) * (outer(a, a) + outer(b, b) + outer(c, c) + outer(sum, sum));
    }

    double volume() const { return volume_; }

    /// About the centre of mass; volume() must not be 0.
    BodyMoments moments() const {
        const Vec3 centre = first_ / volume_;
        return {volume_, apex_ + centre, second_ - volume_ * outer(centre, centre)};
    }

private:
    Vec3 apex_;
    double volume_ = 0.0;  ///< int dV
    Vec3 first_;           ///< int x dV, from the apex
    Mat3 second_;          ///< int x x dV, from the apex
};

/// The mean of the points; InputError, which names `key`, where one is not finite or there are none.
Vec3 middle_of(const char* key, std::span<const Vec3> points);

/// What is taken for no volume inside a surface of that area: rounding.
inline double least_volume(double area) {
    return 1e-13 * area * std::sqrt(area);
}

}  // namespace jostle
