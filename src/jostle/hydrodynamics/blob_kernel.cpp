#include "jostle/hydrodynamics/blob_kernel.hpp"

#include <cmath>
#include <numbers>

namespace jostle {

namespace {

using std::numbers::pi;

/// Below this x = r/(2 sqrt(spread)) series are used: closed forms lose digits there, by cancellation.
constexpr double series_below = 1.0;
constexpr int terms = 20;

/// alpha/(2 pi^(3/2)) of alpha = 1/(2 sqrt(spread)): the value of erf(alpha r)/(4 pi r) at r = 0.
double value_at_centre(double alpha) {
    return alpha / (2.0 * pi * std::sqrt(pi));
}

/// sum over k of (-x^2)^k/k! coefficient(k).
template <class Coefficient>
double series(double x_squared, Coefficient&& coefficient) {
    double sum = 0.0, power = 1.0;
    for (int k = 0; k < terms; ++k) {
        sum += power * coefficient(static_cast<double>(k));
        power *= -x_squared / (k + 1.0);
    }
    return sum;
}

/// Of variance 2 spread: exp(-r^2/(4 spread)) (4 pi spread)^(-3/2).
double gaussian_of(double spread, double squared_distance) {
    return std::exp(-0.25 * squared_distance / spread) * std::pow(4.0 * pi * spread, -1.5);
}

}  // namespace

BlobFlow stokes_flow(double spread, double viscosity, double squared_distance) {
    const double alpha = 0.5 / std::sqrt(spread), x_squared = alpha * alpha * squared_distance;
    if (x_squared < series_below * series_below) {
        const double c = value_at_centre(alpha) / viscosity;
        return {c * series(x_squared, [](double k) { return (2 * k + 2) / ((2 * k + 1) * (2 * k + 3)); }),
                c * alpha * alpha * series(x_squared, [](double k) { return 2 / ((2 * k + 3) * (2 * k + 5)); })};
    }
    const double r = std::sqrt(squared_distance), x = alpha * r;
    const double unit = 1.0 / (4.0 * pi * viscosity * r), error_function = std::erf(x);
    const double psi = unit * error_function;
    const double chi =
        -unit * ((0.5 - 0.25 / x_squared) * error_function + std::exp(-x_squared) / (2.0 * std::sqrt(pi) * x));
    return {psi + chi, -(psi + 3.0 * chi) / squared_distance};
}

BlobFlow solenoidal_gaussian(double spread, double viscosity, double squared_distance) {
    const double alpha = 0.5 / std::sqrt(spread), alpha_squared = alpha * alpha;
    const double x_squared = alpha_squared * squared_distance;
    if (x_squared < series_below * series_below) {
        const double c = 2.0 * value_at_centre(alpha) * alpha_squared / viscosity;
        return {c * series(x_squared, [](double k) { return (2 * k + 2) / (2 * k + 3); }),
                c * alpha_squared * series(x_squared, [](double k) { return 2 / (2 * k + 5); })};
    }
    const double r = std::sqrt(squared_distance), x = alpha * r;
    const double gaussian = std::exp(-x_squared);
    const double g = alpha * alpha_squared / (pi * std::sqrt(pi)) * gaussian / viscosity;
    const double psi_slope =
        (2.0 * x * gaussian / std::sqrt(pi) - std::erf(x)) / (4.0 * pi * viscosity * r * squared_distance);
    return {g + psi_slope, -(g + 3.0 * psi_slope) / squared_distance};
}

BlobFlow near_flow(double spread, double splitting, double viscosity, double squared_distance) {
    const double width = 0.25 / (splitting * splitting), wider = spread + width;
    const BlobFlow narrow = stokes_flow(spread, viscosity, squared_distance);
    const BlobFlow wide = stokes_flow(wider, viscosity, squared_distance);
    const BlobFlow correction = solenoidal_gaussian(wider, viscosity, squared_distance);
    return {narrow.isotropic - wide.isotropic - width * correction.isotropic,
            narrow.radial - wide.radial - width * correction.radial};
}

double rotlet(double spread, double viscosity, double squared_distance) {
    const double alpha = 0.5 / std::sqrt(spread), x_squared = alpha * alpha * squared_distance;
    if (x_squared < series_below * series_below)
        return value_at_centre(alpha) * alpha * alpha / viscosity *
               series(x_squared, [](double k) { return 1 / (2 * k + 3); });
    const double r = std::sqrt(squared_distance), x = alpha * r;
    return (std::erf(x) - 2.0 * x * std::exp(-x_squared) / std::sqrt(pi)) /
           (8.0 * pi * viscosity * r * squared_distance);
}

BlobFlow turning(double spread, double viscosity, double squared_distance) {
    const BlobFlow flow = solenoidal_gaussian(spread, viscosity, squared_distance);
    return {0.25 * flow.isotropic, 0.25 * flow.radial};
}

double near_rotlet(double spread, double splitting, double viscosity, double squared_distance) {
    const double width = 0.25 / (splitting * splitting), wider = spread + width;
    // of spectrum exp(-k^2 wider)/(2 viscosity)
    const double correction = gaussian_of(wider, squared_distance) / (4.0 * wider * viscosity);
    return rotlet(spread, viscosity, squared_distance) - rotlet(wider, viscosity, squared_distance) -
           width * correction;
}

BlobFlow near_turning(double spread, double splitting, double viscosity, double squared_distance) {
    const double width = 0.25 / (splitting * splitting), wider = spread + width;
    const BlobFlow narrow = turning(spread, viscosity, squared_distance);
    const BlobFlow wide = turning(wider, viscosity, squared_distance);
    // of spectrum (k^2 I - k k) exp(-k^2 wider)/(4 viscosity)
    const double unit = gaussian_of(wider, squared_distance) / (4.0 * wider * viscosity);
    const double curvature = 0.25 / wider;
    return {narrow.isotropic - wide.isotropic - width * unit * (1.0 - curvature * squared_distance),
            narrow.radial - wide.radial - width * unit * curvature};
}

}  // namespace jostle
