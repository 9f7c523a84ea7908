#pragma once

#include <cmath>
#include <numbers>

namespace jostle {

/// The bump by which blobs are put on the grid along one direction, over `points` of it: exp(beta (sqrt(1 - z^2) - 1)),
/// z = 2 x/points, beta = 2 points ("exponential of semicircle": Barnett, Magland, af Klinteberg, SIAM J. Sci. Comput.
/// 41, C479 (2019)). x is in grid spacings.
class SpreadingKernel {
public:
    explicit SpreadingKernel(int points) : half_(0.5 * points), beta_(2.0 * points) {}

    double value(double x) const {
        const double z = x / half_, rest = 1.0 - z * z;
        return rest > 0.0 ? std::exp(beta_ * (std::sqrt(rest) - 1.0)) : 0.0;
    }
    /// Its derivative over its value.
    double relative_slope(double x) const {
        const double z = x / half_, rest = 1.0 - z * z;
        return rest > 0.0 ? -beta_ * z / (half_ * std::sqrt(rest)) : 0.0;
    }

    /// The integral of value(x) cos(k x), k in radians a spacing: by the midpoint rule in the angle asin(z).
    double transform(double k) const {
        constexpr int steps = 200;
        constexpr double width = std::numbers::pi / steps;
        double sum = 0.0;
        for (int n = 0; n < steps; ++n) {
            const double angle = -0.5 * std::numbers::pi + (n + 0.5) * width, cosine = std::cos(angle);
            sum += cosine * std::exp(beta_ * (cosine - 1.0)) * std::cos(k * half_ * std::sin(angle));
        }
        return half_ * width * sum;
    }

private:
    double half_, beta_;
};

}  // namespace jostle
