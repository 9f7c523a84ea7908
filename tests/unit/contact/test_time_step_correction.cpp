#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <vector>

#include "jostle/contact/time_step_correction.hpp"

using namespace jostle;

namespace {

/// Stationary Gaussian walk (variance 1) in front of a compliant wall at 0, in a bath of density 1:
///
///     end of a step without the wall:  y = x + xi                            g(y): how often
///     with it:                         y + push,  y + push + give(push) = 0  where y < 0
///
/// g(y) = integral of phi(y - end(y')) g(y') dy', solved by Gauss-Legendre quadrature on three stretches, from -10 to
/// where the wall is stiff, from there to 0, and to 16, beyond which g is 1.
struct WalkAtWall {
    double excess = 0.0;      ///< how many more walkers there are than in front of a wall of continuous motion at 0
    double mean_place = 0.0;  ///< the sum of their places beyond `excess` behind the wall, less that of those
    double half_way = 0.0;    ///< mean place half way between y < 0 and its end, weighted by the push it gets
    double mean_push = 0.0;   ///< a step
};

struct Nodes {
    std::vector<double> place, weight;

    /// `count` more, of Gauss and Legendre, from begin to end.
    void add(double begin, double end, int count) {
        for (int k = 0; k < count; ++k) {
            double x = std::cos(std::numbers::pi * (k + 0.75) / (count + 0.5)), slope = 0.0;
            for (int newton = 0; newton < 20; ++newton) {
                double before = 1.0, value = x;
                for (int n = 2; n <= count; ++n) {
                    const double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
                    before = value;
                    value = next;
                }
                slope = count * (x * value - before) / (x * x - 1.0);
                x -= value / slope;
            }
            place.push_back(0.5 * (begin + end) + 0.5 * (end - begin) * x);
            weight.push_back((end - begin) / ((1.0 - x * x) * slope * slope));
        }
    }
};

/// Of a contact with A_ll = 1 in a step of 1.
double push_of(double y, const ComplianceLaw& law) {
    return std::max({0.0, -y / (1.0 + law.soft), (-y - law.knee) / (1.0 + law.stiff)});
}

WalkAtWall walk_at_wall(const ComplianceLaw& law) {
    constexpr double far = 16.0, farthest_behind = -10.0;
    const double stiff_from = law.soft > law.stiff ? -law.knee * (1.0 + law.soft) / (law.soft - law.stiff) : -1.0;
    Nodes nodes;
    nodes.add(farthest_behind, stiff_from, 60);
    nodes.add(stiff_from, 0.0, 60);
    nodes.add(0.0, far, 100);
    const auto size = static_cast<Eigen::Index>(nodes.place.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
    Eigen::VectorXd from_far(size);
    for (Eigen::Index a = 0; a < size; ++a) {
        const double here = nodes.place[static_cast<std::size_t>(a)];
        from_far[a] = 0.5 * std::erfc((far - here) / std::numbers::sqrt2);
        for (Eigen::Index c = 0; c < size; ++c) {
            const double y = nodes.place[static_cast<std::size_t>(c)];
            const double step = here - (y + push_of(y, law));
            matrix(a, c) -= nodes.weight[static_cast<std::size_t>(c)] * std::exp(-0.5 * step * step) /
                            std::sqrt(2.0 * std::numbers::pi);
        }
    }
    const Eigen::VectorXd g = matrix.partialPivLu().solve(from_far);
    WalkAtWall walk;
    double places = 0.0, first = 0.0;
    for (Eigen::Index c = 0; c < size; ++c) {
        const double y = nodes.place[static_cast<std::size_t>(c)], push = push_of(y, law);
        const double count = nodes.weight[static_cast<std::size_t>(c)] * g[c];
        walk.excess += count;
        walk.mean_push += count * push;
        places += count * (y + push);
        first += count * push * (y + 0.5 * push);
    }
    const double walkers = walk.excess;  // from -excess to far, of continuous motion
    walk.excess -= far;
    walk.mean_place = places + walk.excess * walkers - 0.5 * walkers * walkers;
    walk.half_way = first / walk.mean_push;
    return walk;
}

const ComplianceLaw ours = brownian_compliance(0.5, 1.0);  // sigma = 1

}  // namespace

TEST_CASE("the shift vanishes without thermal motion, and contacts are then hard") {
    CHECK(brownian_shift(0.0, 0.1, 2.0) == 0.0);
    CHECK(brownian_shift(1.0, 0.5, 1.0) == discrete_watching);
    CHECK(brownian_compliance(0.0, 0.1).soft == 0.0);
    CHECK(brownian_compliance(0.0, 0.1).knee == 0.0);
}

TEST_CASE("the shift belongs to the compliance: as many walkers as at a wall of continuous motion") {
    CHECK(walk_at_wall(ours).excess == doctest::Approx(discrete_watching).epsilon(1e-9));
    CHECK(walk_at_wall({own_image_compliance, own_image_compliance, 0.0}).excess ==
          doctest::Approx(own_image_watching).epsilon(1e-9));
    // Without compliance: -zeta(1/2)/sqrt(2 pi).
    CHECK(walk_at_wall({}).excess == doctest::Approx(0.5825971579390107).epsilon(1e-9));
}

TEST_CASE("contacts become stiff where walkers then have the mean place of continuous motion") {
    CHECK(std::fabs(walk_at_wall(ours).mean_place) < 1e-9);
    CHECK(walk_at_wall({}).mean_place > 0.1);  // too far from the wall, as with all contacts that are too hard
    const ComplianceLaw one_spring{0.25, 0.25, 0.0};
    CHECK(walk_at_wall(one_spring).mean_place == doctest::Approx(0.1176).epsilon(1e-3));
}

TEST_CASE("with that shift forces act, in the mean, at touching, and the walls feel the ideal pressure") {
    for (const ComplianceLaw& law : {ComplianceLaw{}, ComplianceLaw{1.0, 1.0, 0.0}, ours}) {
        const WalkAtWall walk = walk_at_wall(law);
        CHECK(walk.half_way == doctest::Approx(-walk.excess).epsilon(1e-9));
        CHECK(walk.mean_push == doctest::Approx(0.5).epsilon(1e-9));  // kT n, with sigma^2 = 2 kT dt mobility = 1
    }
}
