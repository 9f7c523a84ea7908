#include "jostle/simulation/pair_problem.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "jostle/math/vec3.hpp"

namespace jostle {

namespace {

/// max |min(A_aa gamma_a, velocity_a)| over the points of a pair.
double violation(const PairMatrix& pair, const Points& without, const Points& gamma) {
    double largest = 0.0;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        double velocity = without[a];
        for (std::uint32_t c = 0; c < pair.count; ++c) velocity += pair.matrix[a][c] * gamma[c];
        largest = std::max(largest, std::fabs(std::min(pair.matrix[a][a] * gamma[a], velocity)));
    }
    return largest;
}

/// gamma of two points: the active set whose signs are right. None where their matrix is nearly singular.
std::optional<Points> of_two_points(const PairMatrix& pair, const Points& without) {
    const auto& K = pair.matrix;
    if (without[0] >= 0.0 && without[1] >= 0.0) return Points{};
    for (std::size_t a = 0; a < 2; ++a) {
        const std::size_t other = 1 - a;
        if (!(without[a] < 0.0 && K[a][a] > 0.0)) continue;
        Points gamma{};
        gamma[a] = -without[a] / K[a][a];
        if (without[other] + K[other][a] * gamma[a] >= 0.0) return gamma;
    }
    const double determinant = K[1][1] * K[0][0] - K[1][0] * K[0][1];
    if (!(determinant > 1e-12 * K[1][1] * K[0][0])) return {};
    const Points gamma{(K[0][1] * without[1] - K[1][1] * without[0]) / determinant,
                       (K[1][0] * without[0] - K[0][0] * without[1]) / determinant};
    if (gamma[0] >= 0.0 && gamma[1] >= 0.0) return gamma;
    return {};
}

/// gamma that makes all three gap velocities vanish (Cramer's rule), or -1 where the three are dependent.
Points all_three_active(const PairMatrix& pair, const Points& without) {
    const auto& K = pair.matrix;
    const Vec3 rows[3] = {{K[0][0], K[0][1], K[0][2]}, {K[1][0], K[1][1], K[1][2]}, {K[2][0], K[2][1], K[2][2]}};
    const Vec3 crossed[3] = {cross(rows[1], rows[2]), cross(rows[2], rows[0]), cross(rows[0], rows[1])};
    const double determinant = dot(rows[0], crossed[0]);
    if (!(determinant > 1e-12 * K[0][0] * K[1][1] * K[2][2])) return {-1.0, -1.0, -1.0};
    const Vec3 solution =
        (-1.0 / determinant) * (without[0] * crossed[0] + without[1] * crossed[1] + without[2] * crossed[2]);
    return {solution.x, solution.y, solution.z};
}

}  // namespace

void solve_own_problem(const PairMatrix& pair, const Points& velocity, Points& target) {
    Points without{};  // gap velocities if this pair had no forces
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        without[a] = velocity[a];
        for (std::uint32_t c = 0; c < pair.count; ++c) without[a] -= pair.matrix[a][c] * target[c];
    }
    if (pair.count == 2) {
        if (const auto gamma = of_two_points(pair, without)) {
            target = *gamma;
            return;
        }
    }
    Points best{};
    double least = violation(pair, without, best);
    const auto consider = [&](const Points& gamma) {
        const double here = violation(pair, without, gamma);
        if (here < least) {
            least = here;
            best = gamma;
        }
    };
    for (std::uint32_t a = 0; a < pair.count && least > 0.0; ++a) {
        if (!(pair.matrix[a][a] > 0.0)) continue;  // no force can open this gap
        Points gamma{};
        gamma[a] = std::max(-without[a] / pair.matrix[a][a], 0.0);
        consider(gamma);
        for (std::uint32_t c = 0; c < a; ++c) {
            const double determinant = pair.matrix[a][a] * pair.matrix[c][c] - pair.matrix[a][c] * pair.matrix[c][a];
            if (!(determinant > 1e-12 * pair.matrix[a][a] * pair.matrix[c][c])) continue;
            gamma = {};
            gamma[a] = (pair.matrix[a][c] * without[c] - pair.matrix[c][c] * without[a]) / determinant;
            gamma[c] = (pair.matrix[c][a] * without[a] - pair.matrix[a][a] * without[c]) / determinant;
            if (gamma[a] >= 0.0 && gamma[c] >= 0.0) consider(gamma);
        }
    }
    if (pair.count == 3 && least > 0.0) {
        const Points gamma = all_three_active(pair, without);
        if (gamma[0] >= 0.0 && gamma[1] >= 0.0 && gamma[2] >= 0.0) consider(gamma);
    }
    target = best;
}

}  // namespace jostle
