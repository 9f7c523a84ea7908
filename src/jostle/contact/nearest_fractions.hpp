#pragma once

#include "jostle/contact/segment_distance.hpp"

namespace jostle {

/// Where two segments, given by their ends, come nearest to each other.
struct NearestFractions {
    double distance = 0.0;  ///< length
    double s = 0.0;         ///< the point on the first is p0 + s (p1 - p0), 0 <= s <= 1
    double t = 0.0;         ///< the point on the second is q0 + t (q1 - q0), 0 <= t <= 1
};

/// `nearest_points` of the segments from p0 to p1 and from q0 to q1 (length).
///
/// A segment without length is a point; its fraction is 1/2. Where the points are not unique (parallel, side by side)
/// they are the middle of the overlap. Checks nothing.
inline NearestFractions nearest_fractions(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1) {
    const auto axis_of = [](const Vec3& along, double length) { return length > 0.0 ? along / length : Vec3{0, 0, 1}; };
    const double length_p = norm(p1 - p0), length_q = norm(q1 - q0);
    const NearestPoints nearest = nearest_points(0.5 * (q0 + q1) - 0.5 * (p0 + p1), axis_of(p1 - p0, length_p),
                                                 0.5 * length_p, axis_of(q1 - q0, length_q), 0.5 * length_q);
    const auto fraction = [](double s, double length) { return length > 0.0 ? 0.5 + s / length : 0.5; };
    return {norm(nearest.separation), fraction(nearest.s_i, length_p), fraction(nearest.s_j, length_q)};
}

}  // namespace jostle
