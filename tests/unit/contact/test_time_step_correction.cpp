#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <numbers>
#include <vector>

#include "jostle/contact/time_step_correction.hpp"

using namespace jostle;

namespace {

/// Stationary Gaussian walk (variance 1) in front of a compliant wall at 0, in a bath of density 1:
///
///     end of a step without the wall:  y = x + xi          g(y): how often
///     with it:                         y if y > 0, else k y,   k = kappa/(1 + kappa)
///
/// g(y) = integral of phi(y - end(y')) g(y') dy', solved on a grid from -9 to 15 (Simpson), beyond which g is 1.
struct WalkAtWall {
    double excess = 0.0;     ///< how many more walkers there are than in front of a wall of continuous motion at 0
    double half_way = 0.0;   ///< mean place half way between y < 0 and its end, weighted by the push it gets
    double mean_push = 0.0;  ///< a step
};

WalkAtWall walk_at_wall(double kappa) {
    constexpr int below = 360, above = 600;  // intervals
    constexpr double spacing = 0.025, far = above * spacing;
    const double k = kappa / (1.0 + kappa);
    std::vector<double> y, weight;
    const auto add = [&](double begin, int intervals) {
        for (int n = 0; n <= intervals; ++n) {
            y.push_back(begin + n * spacing);
            weight.push_back(spacing / 3.0 * (n == 0 || n == intervals ? 1.0 : n % 2 == 1 ? 4.0 : 2.0));
        }
    };
    add(-below * spacing, below);
    const std::size_t wall = y.size();
    add(0.0, above);
    const auto size = static_cast<Eigen::Index>(y.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
    Eigen::VectorXd from_far(size);
    for (Eigen::Index a = 0; a < size; ++a) {
        const double here = y[static_cast<std::size_t>(a)];
        from_far[a] = 0.5 * std::erfc((far - here) / std::numbers::sqrt2);
        for (std::size_t c = 0; c < y.size(); ++c) {
            const double end = c < wall ? k * y[c] : y[c];
            const double phi = std::exp(-0.5 * (here - end) * (here - end)) / std::sqrt(2.0 * std::numbers::pi);
            matrix(a, static_cast<Eigen::Index>(c)) -= weight[c] * phi;
        }
    }
    const Eigen::VectorXd g = matrix.partialPivLu().solve(from_far);
    WalkAtWall walk;
    double first = 0.0;
    for (std::size_t c = 0; c < y.size(); ++c) {
        const double count = weight[c] * g[static_cast<Eigen::Index>(c)];
        walk.excess += count;
        if (c >= wall) continue;
        const double push = (1.0 - k) * -y[c];
        walk.mean_push += count * push;
        first += count * push * 0.5 * (1.0 + k) * y[c];
    }
    walk.excess -= far;
    walk.half_way = first / walk.mean_push;
    return walk;
}

}  // namespace

TEST_CASE("the shift vanishes without thermal motion") {
    CHECK(brownian_shift(0.0, 0.1, 2.0) == 0.0);
    CHECK(brownian_shift(1.0, 0.5, 1.0) == discrete_watching);
}

TEST_CASE("the shift belongs to the compliance: as many walkers as at a wall of continuous motion") {
    CHECK(walk_at_wall(contact_compliance).excess == doctest::Approx(discrete_watching).epsilon(1e-7));
    // Without compliance: -zeta(1/2)/sqrt(2 pi).
    const double hard = 0.5825971579390107, harmonic = std::numbers::pi / 8.0;
    CHECK(walk_at_wall(0.0).excess == doctest::Approx(hard).epsilon(1e-7));
    for (const double kappa : {1.0, 4.0})  // theory, eq. 3.5a
        CHECK(walk_at_wall(kappa).excess == doctest::Approx(std::sqrt(harmonic * (1.0 + 2.0 * kappa) -
                                                                      (harmonic - hard * hard) / (1.0 + 0.84 * kappa)))
                                                .epsilon(5e-4));
}

TEST_CASE("with that shift forces act, in the mean, at touching, and the walls feel the ideal pressure") {
    for (const double kappa : {0.0, contact_compliance, 1.0}) {
        const WalkAtWall walk = walk_at_wall(kappa);
        CHECK(walk.half_way == doctest::Approx(-walk.excess).epsilon(1e-7));
        CHECK(walk.mean_push == doctest::Approx(0.5).epsilon(1e-7));  // kT n, with sigma^2 = 2 kT dt mobility = 1
    }
}
