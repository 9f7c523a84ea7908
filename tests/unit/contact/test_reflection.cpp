#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "jostle/contact/reflection.hpp"

using namespace jostle;

namespace {

double normal_density(double x, double sigma) {
    return std::exp(-0.5 * x * x / (sigma * sigma)) / (sigma * std::sqrt(2.0 * std::numbers::pi));
}

/// Places on a line, and how often a walker is there when it has walked for long: `weight` adds up to 1.
struct Walk {
    std::vector<double> place, weight;

    double mean() const {
        double sum = 0.0;
        for (std::size_t k = 0; k < place.size(); ++k) sum += place[k] * weight[k];
        return sum;
    }
};

/// A walker whose steps would end at y with the density step(x, y), and do end at end_of(y), which is in [from, to].
Walk walk(double from, double to, double spacing, double farthest_step,
          const std::function<double(double, double)>& step, const std::function<double(double)>& end_of) {
    Walk walk;
    for (double x = from + 0.5 * spacing; x < to; x += spacing) walk.place.push_back(x);
    const auto size = static_cast<Eigen::Index>(walk.place.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    for (Eigen::Index begin = 0; begin < size; ++begin) {
        const double x = walk.place[static_cast<std::size_t>(begin)];
        for (double y = x - farthest_step; y < x + farthest_step; y += spacing) {
            // Between the two nearest places.
            const double at = std::max((end_of(y) - from) / spacing - 0.5, 0.0);
            const auto lower = std::min(static_cast<Eigen::Index>(at), size - 2);
            const double part = std::min(at - static_cast<double>(lower), 1.0), chance = step(x, y) * spacing;
            matrix(lower, begin) += (1.0 - part) * chance;
            matrix(lower + 1, begin) += part * chance;
        }
        matrix.col(begin) /= matrix.col(begin).sum();
    }
    matrix -= Eigen::MatrixXd::Identity(size, size);
    matrix.row(0).setOnes();
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size);
    sum[0] = 1.0;
    const Eigen::VectorXd often = matrix.partialPivLu().solve(sum);
    walk.weight.assign(often.begin(), often.end());
    return walk;
}

/// With sigma = 1, driven by `drift` a step against a wall at 0, far from any other.
Walk walk_at_wall(double drift, bool corrected) {
    const double far = 12.0 + 5.0 / std::fabs(drift);
    return walk(
        0.0, far, 0.05, 8.0, [&](double x, double y) { return normal_density(y - x - drift, 1.0); },
        [&](double y) {
            if (y > far) return 2.0 * far - y;
            return y > 0.0 ? y : y - y * reflected_part(-y, corrected ? drift : 0.0, 1.0);
        });
}

/// At a wall at 0 near which it is less mobile: sigma = 1 + slope x, and the thermal drift (sigma^2)'/2.
Walk walk_where_mobility_grows(double slope, bool drift_in_law) {
    const double far = 14.0;
    return walk(
        0.0, far, 0.05, 10.0,
        [&](double x, double y) {
            const double sigma = 1.0 + slope * x;
            return normal_density(y - x - slope * sigma, sigma);
        },
        [&](double y) {
            if (y > far) return 2.0 * far - y;
            return y > 0.0 ? y : y - y * reflected_part(-y, drift_in_law ? slope : 0.0, 1.0);
        });
}

/// In space, outside of a sphere of radius 1; `place` is the distance from its middle.
Walk walk_at_sphere(double sigma, bool corrected) {
    const double far = 3.0, drift = corrected ? sigma * sigma : 0.0;  // sigma^2/2 times the sum of the curvatures
    return walk(
        1.0, far, 0.05 * sigma, 8.0 * sigma,
        [&](double x, double y) {
            if (y <= 0.0) return 0.0;
            return y / x * (normal_density(y - x, sigma) - normal_density(y + x, sigma));
        },
        [&](double y) {
            if (y > far) return 2.0 * far - y;
            return y > 1.0 ? y : y + (1.0 - y) * reflected_part(1.0 - y, drift, sigma);
        });
}

struct Range {
    double from, to;
};

/// Density between two places, over that at other ones, in so many dimensions.
double density(const Walk& walk, const Range& here, const Range& there, int dimensions) {
    const auto mean = [&](const Range& range) {
        double often = 0.0, volume = 0.0;
        for (std::size_t k = 0; k < walk.place.size(); ++k) {
            const double r = walk.place[k];
            if (r < range.from || r > range.to) continue;
            often += walk.weight[k];
            volume += std::pow(r, dimensions - 1);
        }
        return often / volume;
    };
    return mean(here) / mean(there);
}

}  // namespace

TEST_CASE("without drift paths are mirrored; without noise, or against a strong drift, rods stay at touching") {
    CHECK(reflected_part(0.1, 0.0, 0.2) == 2.0);
    CHECK(reflected_part(0.1, -0.3, 0.0) == 1.0);
    CHECK(reflected_part(0.3, -0.3, 0.01) == 1.0);
    CHECK(reflected_part(0.1, 0.01, 0.2) > 2.0);
    CHECK(reflected_part(0.1, -0.01, 0.2) < 2.0);
}

TEST_CASE("the mean excess of a normal number, within 3 %") {
    for (const double x : {0.0, 0.5, 1.0, 2.0, 4.0}) {
        const double beyond = 0.5 * std::erfc(x / std::numbers::sqrt2);
        CHECK(mean_excess(x) == doctest::Approx(normal_density(x, 1.0) / beyond - x).epsilon(0.03));
    }
}

TEST_CASE("walkers that drift against a wall are as far from it as in continuous motion: sigma^2/2 drift") {
    CHECK(walk_at_wall(-0.05, true).mean() == doctest::Approx(10.0).epsilon(0.003));
    CHECK(walk_at_wall(-0.1, true).mean() == doctest::Approx(5.0).epsilon(0.005));
    CHECK(walk_at_wall(-0.2, true).mean() == doctest::Approx(2.5).epsilon(0.01));
    CHECK(walk_at_wall(-0.4, true).mean() == doctest::Approx(1.25).epsilon(0.04));
    CHECK(walk_at_wall(-0.4, false).mean() > 1.4);
}

TEST_CASE("walkers around a sphere are as dense near it as away from it") {
    const double sigma = 0.1;
    const Walk mirrored = walk_at_sphere(sigma, false), corrected = walk_at_sphere(sigma, true);
    const Range away{1.0 + 5.0 * sigma, 1.0 + 8.0 * sigma};
    CHECK(density(mirrored, {1.0, 1.04}, away, 3) > 1.06);
    CHECK(density(corrected, {1.0, 1.04}, away, 3) == doctest::Approx(1.0).epsilon(0.015));
    CHECK(density(corrected, {1.04, 1.1}, away, 3) == doctest::Approx(1.0).epsilon(0.015));
}

TEST_CASE("walkers that are less mobile at a wall are as dense there, if the law does not know their thermal drift") {
    for (const double slope : {0.02, 0.05}) {
        CAPTURE(slope);
        CHECK(density(walk_where_mobility_grows(slope, false), {0.0, 1.0}, {3.0, 6.0}, 1) ==
              doctest::Approx(1.0).epsilon(0.005));
        CHECK(density(walk_where_mobility_grows(slope, true), {0.0, 1.0}, {3.0, 6.0}, 1) < 1.0 - 0.4 * slope);
    }
}
