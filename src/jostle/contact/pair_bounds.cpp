#include "jostle/contact/pair_bounds.hpp"

#include <cmath>

#include "jostle/contact/segment_separation.hpp"
#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

/// What float rounding may do to the quick bounds, in units of the rods' size. The bound of a plane is right for any
/// normal, so rounding of the nearest points does not matter to it; to the gap it does, for nearly parallel rods.
constexpr float bound_error = 1e-5F, gap_error = 2e-3F;

/// Beyond this cosine, rounding apart, rods have not passed through each other.
constexpr float clearly_same_side = 0.1F;

}  // namespace

JOSTLE_VECTORISED void find_bounds(std::size_t count, float range, float margin, PairBatch& batch) {
    const auto& [x, y, z] = batch.between;
    const auto& [mx, my, mz] = batch.moved;
    const auto& [ux, uy, uz] = batch.axis_i;
    const auto& [vx, vy, vz] = batch.axis_j;
    const auto& [px, py, pz] = batch.axis_i_after;
    const auto& [qx, qy, qz] = batch.axis_j_after;
    auto& [normal_x, normal_y, normal_z] = batch.normal;
    for (std::size_t k = 0; k < count; ++k) {
        const auto [ex, ey, ez] = segment_separation({x[k], y[k], z[k]}, {ux[k], uy[k], uz[k]}, batch.half_i[k],
                                                     {vx[k], vy[k], vz[k]}, batch.half_j[k]);
        const float distance = std::sqrt(ex * ex + ey * ey + ez * ez) + 1e-30F;
        const float ax = x[k] + mx[k], ay = y[k] + my[k], az = z[k] + mz[k];
        const auto [fx, fy, fz] = segment_separation({ax, ay, az}, {px[k], py[k], pz[k]}, batch.half_i[k],
                                                     {qx[k], qy[k], qz[k]}, batch.half_j[k]);
        const float distance_after = std::sqrt(fx * fx + fy * fy + fz * fz) + 1e-30F;
        const float nx = fx / distance_after, ny = fy / distance_after, nz = fz / distance_after;
        normal_x[k] = in_normal_units(nx);
        normal_y[k] = in_normal_units(ny);
        normal_z[k] = in_normal_units(nz);
        batch.gap[k] = distance - batch.radii[k];
        batch.same_side[k] = (ex * nx + ey * ny + ez * nz) / distance;
        const float width = ax * nx + ay * ny + az * nz -
                            batch.half_i[k] * std::fabs(px[k] * nx + py[k] * ny + pz[k] * nz) -
                            batch.half_j[k] * std::fabs(qx[k] * nx + qy[k] * ny + qz[k] * nz) - batch.radii[k];
        batch.slack[k] = width - bound_error * (batch.half_i[k] + batch.half_j[k] + batch.radii[k]);
    }
    for (std::size_t k = 0; k < count; ++k) {
        const bool is_apart = batch.gap[k] - gap_error * batch.radii[k] > range;
        const bool is_clear = is_apart && batch.same_side[k] > clearly_same_side && batch.slack[k] >= margin;
        batch.inactive.marks()[k] = is_clear ? 1 : 0;
    }
}

}  // namespace jostle
