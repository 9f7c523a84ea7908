#pragma once

#include "jostle/math/vec3.hpp"

namespace jostle {

/// The points of two segments that are nearest to each other.
struct NearestPoints {
    double s_i = 0.0;  ///< signed coordinate along axis_i, from the centre of i
    double s_j = 0.0;  ///< signed coordinate along axis_j, from the centre of j
    Vec3 separation;   ///< from the point on i to the point on j; its norm is the distance
};

/// The point of a segment that is nearest to a given point.
struct NearestPoint {
    double s = 0.0;   ///< signed coordinate along the axis, from the segment's centre
    Vec3 separation;  ///< from the point on the segment to the given point
};

namespace segment_distance {

/// Weight by which exactly parallel segments prefer the middle of their overlap. It moves the distance by less than
/// sqrt(weight)/2 = 5e-14 half lengths, and is lost to rounding as soon as the sine of the angle is above 1e-5.
inline constexpr double middle_weight = 1e-26;

// Written so that compilers emit two instructions and no jump.
inline double smaller(double a, double b) {
    return a < b ? a : b;
}
inline double larger(double a, double b) {
    return a > b ? a : b;
}
inline double clamped(double value, double limit) {
    return smaller(larger(value, -limit), limit);
}

}  // namespace segment_distance

/// Nearest point of the segment s axis, |s| <= half_length, to `point`: s = clamp(point . axis).
///
/// `point` (length) is relative to the segment's centre; `axis` is a unit vector; `half_length` >= 0 (length).
inline NearestPoint nearest_point(const Vec3& point, const Vec3& axis, double half_length) {
    const double s = segment_distance::clamped(dot(point, axis), half_length);
    return {s, point - s * axis};
}

/// Nearest points of the segments s_i u, |s_i| <= h_i, and d + s_j v, |s_j| <= h_j, with unit vectors u, v.
///
/// The point of line i nearest to line j is s_i = d'.u'/u'^2, with d' = d - (d.v) v and u' = u - (u.v) v. Clamped, it
/// gives s_j = clamp(s_i u.v - d.v), and that gives s_i = clamp(s_j u.v + d.u): the minimum, because the squared
/// distance is convex in (s_i, s_j); see Ericson, Real-Time Collision Detection (2005), section 5.1.9. u'^2 is sin^2 of
/// the angle to rounding, as |u x v|^2 is, in fewer operations; 1 - (u.v)^2 would lose nearly parallel segments. Where
/// the points are not unique (exactly parallel, side by side) they are the middle of the overlap. Any half length may
/// be 0 (sphere). The distance is right to about 1e-14 times the size of the coordinates for any angle; swapping i and
/// j swaps s_i and s_j and reverses the separation, up to rounding.
///
/// centre_separation d (length) runs from the centre of i to that of j, image included; the axes are unit vectors;
/// half_length_i, half_length_j >= 0 (length). Checks nothing.
inline NearestPoints nearest_points(const Vec3& centre_separation, const Vec3& axis_i, double half_length_i,
                                    const Vec3& axis_j, double half_length_j) {
    using namespace segment_distance;
    const Vec3& d = centre_separation;
    const double d_i = dot(d, axis_i), d_j = dot(d, axis_j), cosine = dot(axis_i, axis_j);
    const Vec3 d_across = d - d_j * axis_j, u_across = axis_i - cosine * axis_j;
    const double middle =
        0.5 * (larger(-half_length_i, d_i - half_length_j) + smaller(half_length_i, d_i + half_length_j));
    const double s_line = (dot(d_across, u_across) + middle_weight * middle) / (squared_norm(u_across) + middle_weight);

    const double s_start = clamped(s_line, half_length_i);
    const double s_j = clamped(s_start * cosine - d_j, half_length_j);
    const double s_i = clamped(s_j * cosine + d_i, half_length_i);
    return {s_i, s_j, d + s_j * axis_j - s_i * axis_i};
}

}  // namespace jostle
