#pragma once

namespace jostle {

/// A vector in a loop that is compiled to vector instructions: many of them side by side.
struct FloatVec3 {
    float x, y, z;
};

/// The vector between the nearest points of two segments: `nearest_points` of segment_distance.hpp in float, without
/// the choice of a middle for parallel ones. For bounds and first looks; its length may be too large by some 1e-4 of
/// the rods' size where they are nearly parallel.
inline FloatVec3 segment_separation(const FloatVec3& d, const FloatVec3& u, float half_i, const FloatVec3& v,
                                    float half_j) {
    const auto clamped = [](float value, float limit) {
        const float above = value > -limit ? value : -limit;
        return above < limit ? above : limit;
    };
    const float d_i = d.x * u.x + d.y * u.y + d.z * u.z, d_j = d.x * v.x + d.y * v.y + d.z * v.z;
    const float cosine = u.x * v.x + u.y * v.y + u.z * v.z;
    const float wx = u.x - cosine * v.x, wy = u.y - cosine * v.y, wz = u.z - cosine * v.z;
    const float along = (d.x - d_j * v.x) * wx + (d.y - d_j * v.y) * wy + (d.z - d_j * v.z) * wz;
    const float s_start = clamped(along / (wx * wx + wy * wy + wz * wz + 1e-20F), half_i);
    const float s_j = clamped(s_start * cosine - d_j, half_j);
    const float s_i = clamped(s_j * cosine + d_i, half_i);
    return {d.x + s_j * v.x - s_i * u.x, d.y + s_j * v.y - s_i * u.y, d.z + s_j * v.z - s_i * u.z};
}

}  // namespace jostle
