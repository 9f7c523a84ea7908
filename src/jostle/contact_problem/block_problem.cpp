#include "jostle/contact_problem/block_problem.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>

#include "jostle/math/vec3.hpp"

namespace jostle {

namespace {

/// Which points push: bit a for point a.
using PointSet = std::uint32_t;

/// Of a set that is not empty. (std::has_single_bit counts all bits, by a function where a processor may lack one.)
bool is_single(PointSet set) {
    return (set & (set - 1)) == 0;
}

/// Sets whose determinant is not above this part of the product of their diagonal are taken for dependent.
constexpr double dependent = 1e-12;

/// gamma of the points of a set that makes their gap velocities vanish (Cramer's rule). None where one would be
/// negative, or where the points are nearly dependent. `without`: gap velocities without forces of the pair.
std::optional<Points> forces_of(PointSet set, const BlockMatrix& pair, const Points& without) {
    const auto& K = pair.matrix;
    Points gamma{};
    if (set == 0) return gamma;
    if (set == 7) {
        const Vec3 rows[3] = {{K[0][0], K[0][1], K[0][2]}, {K[1][0], K[1][1], K[1][2]}, {K[2][0], K[2][1], K[2][2]}};
        const Vec3 crossed[3] = {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
        const double determinant = dot(rows[0], crossed[0]);
        if (!(determinant > dependent * K[0][0] * K[1][1] * K[2][2])) return {};
        const Vec3 solution =
            (-1.0 / determinant) * (without[0] * crossed[0] + without[1] * crossed[1] + without[2] * crossed[2]);
        gamma = {solution.x, solution.y, solution.z};
    } else if (const auto a = static_cast<std::size_t>(std::countr_zero(set)); is_single(set)) {
        if (!(K[a][a] > 0.0)) return {};  // no force can open this gap
        gamma[a] = -without[a] / K[a][a];
    } else {
        const auto c = static_cast<std::size_t>(std::bit_width(set)) - 1;
        const double determinant = K[a][a] * K[c][c] - K[a][c] * K[c][a];
        if (!(determinant > dependent * K[a][a] * K[c][c])) return {};
        gamma[a] = (K[a][c] * without[c] - K[c][c] * without[a]) / determinant;
        gamma[c] = (K[c][a] * without[a] - K[a][a] * without[c]) / determinant;
    }
    if (!(gamma[0] >= 0.0 && gamma[1] >= 0.0 && gamma[2] >= 0.0)) return {};
    return gamma;
}

/// The gap velocity of point a.
template <std::uint32_t count>
double gap_velocity(std::uint32_t a, const BlockMatrix& pair, const Points& without, const Points& gamma) {
    double velocity = without[a];
    for (std::uint32_t c = 0; c < count; ++c) velocity += pair.matrix[a][c] * gamma[c];
    return velocity;
}

/// max |min(A_aa gamma_a, velocity_a)| over the points of a pair.
template <std::uint32_t count>
double violation(const BlockMatrix& pair, const Points& without, const Points& gamma) {
    double largest = 0.0;
    for (std::uint32_t a = 0; a < count; ++a)
        largest = std::max(
            largest, std::fabs(std::min(pair.matrix[a][a] * gamma[a], gap_velocity<count>(a, pair, without, gamma))));
    return largest;
}

template <std::uint32_t count>
void solve(const BlockMatrix& pair, const Points& velocity, Points& target) {
    Points without{};
    PointSet pushing = 0;
    for (std::uint32_t a = 0; a < count; ++a) {
        without[a] = velocity[a];
        for (std::uint32_t c = 0; c < count; ++c) without[a] -= pair.matrix[a][c] * target[c];
        if (target[a] > 0.0) pushing |= PointSet{1} << a;
    }
    const auto solved_by = [&](PointSet set) {
        const auto gamma = forces_of(set, pair, without);
        if (!gamma) return false;
        for (std::uint32_t a = 0; a < count; ++a)
            if ((set >> a & 1) == 0 && gap_velocity<count>(a, pair, without, *gamma) < 0.0) return false;
        target = *gamma;
        return true;
    };
    constexpr PointSet sets = PointSet{1} << count;
    if (solved_by(pushing)) return;
    for (PointSet set = 0; set < sets; ++set)
        if (set != pushing && solved_by(set)) return;

    double least = std::numeric_limits<double>::infinity();
    for (PointSet set = 0; set < sets; ++set) {
        const auto gamma = forces_of(set, pair, without);
        if (!gamma) continue;
        const double here = violation<count>(pair, without, *gamma);
        if (here < least) {
            least = here;
            target = *gamma;
        }
    }
}

}  // namespace

void solve_block_problem(const BlockMatrix& pair, const Points& velocity, Points& target) {
    pair.count == 2 ? solve<2>(pair, velocity, target) : solve<3>(pair, velocity, target);
}

}  // namespace jostle
