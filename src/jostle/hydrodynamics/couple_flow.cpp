#include "jostle/hydrodynamics/couple_flow.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace jostle {

namespace {

using std::numbers::pi;

constexpr std::size_t intervals = 4096;

}  // namespace

double couple_spread(double diameter) {
    return diameter * diameter * std::pow(pi / 6.0, 2.0 / 3.0) / (4.0 * pi);
}

template <class RotletAt, class TurningAt>
CoupleFlow::CoupleFlow(double range, double viscosity, double cutoff, RotletAt&& rotlet_at, TurningAt&& turning_at)
    : rotlet_(range, intervals,
              [&](double squared) {
                  return BlobFlow{rotlet_at(squared), 0.0};
              }),
      turning_(range, intervals, turning_at),
      squared_range_(range * range),
      viscosity_(viscosity),
      cutoff_(cutoff) {}

CoupleFlow CoupleFlow::unbounded(double spread, double couple_spread, double viscosity) {
    const double between = 0.5 * (spread + couple_spread);
    const double range = 12.0 * std::sqrt(std::max(between, couple_spread));  // where Gaussians have fallen to 1e-15
    return {range, viscosity, std::numeric_limits<double>::infinity(),
            [=](double squared) { return jostle::rotlet(between, viscosity, squared); },
            [=](double squared) { return jostle::turning(couple_spread, viscosity, squared); }};
}

CoupleFlow CoupleFlow::near(double spread, double couple_spread, double splitting, double viscosity, double cutoff) {
    const double between = 0.5 * (spread + couple_spread);
    return {cutoff, viscosity, cutoff,
            [=](double squared) { return near_rotlet(between, splitting, viscosity, squared); },
            [=](double squared) { return near_turning(couple_spread, splitting, viscosity, squared); }};
}

CoupleFlow::Rotlet CoupleFlow::rotlet(double squared_distance) const {
    if (squared_distance < squared_range_) {
        const BlobFlowSlope table = rotlet_.with_slope(squared_distance);
        return {table.flow.isotropic, table.slope.isotropic};
    }
    if (squared_distance > cutoff_ * cutoff_) return {0.0, 0.0};
    const double value = 1.0 / (8.0 * pi * viscosity_ * squared_distance * std::sqrt(squared_distance));
    return {value, -1.5 * value / squared_distance};
}

BlobFlow CoupleFlow::turning(double squared_distance) const {
    if (squared_distance < squared_range_) return turning_.at(squared_distance);
    if (squared_distance > cutoff_ * cutoff_) return {};
    const double unit = 1.0 / (16.0 * pi * viscosity_ * squared_distance * std::sqrt(squared_distance));
    return {-unit, 3.0 * unit / squared_distance};
}

}  // namespace jostle
