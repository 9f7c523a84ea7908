#include "jostle/hydrodynamics/pair_flow.hpp"

#include <cmath>
#include <numbers>

namespace jostle {

namespace {

constexpr std::size_t intervals = 4096;
/// Of the table in floats, where cubics leave less than these round off.
constexpr std::size_t intervals_of_fours = 1024;

}  // namespace

template <class Flow>
PairFlow::PairFlow(double range, double spread, double viscosity, double cutoff, Flow&& flow)
    : table_(range, intervals, flow),
      squared_range_(range * range),
      spread_(spread),
      viscosity_(viscosity),
      cutoff_(cutoff),
      in_table_(four(range * range * (1.0 - 1e-6))),
      fours_(FlowTable(range, intervals_of_fours, flow)) {}

PairFlow PairFlow::unbounded(double spread, double viscosity) {
    const double range = 12.0 * std::sqrt(spread);  // where erfc(r/(2 sqrt(spread))) is below 1e-16
    return {range, spread, viscosity, std::numeric_limits<double>::infinity(),
            [=](double squared) { return stokes_flow(spread, viscosity, squared); }};
}

PairFlow PairFlow::near(double spread, double splitting, double viscosity, double cutoff) {
    return {cutoff, spread, viscosity, cutoff,
            [=](double squared) { return near_flow(spread, splitting, viscosity, squared); }};
}

BlobFlowSlope PairFlow::of_points(double squared_distance) const {
    if (squared_distance > cutoff_ * cutoff_) return {};
    const double inverse = 1.0 / squared_distance;
    const double unit = 0.25 / (std::numbers::pi * viscosity_) * std::sqrt(inverse), faxen = spread_ * inverse;
    return {{unit * (0.5 + faxen), unit * inverse * (0.5 - 3.0 * faxen)},
            {-unit * inverse * (0.25 + 1.5 * faxen), -unit * inverse * inverse * (0.75 - 7.5 * faxen)}};
}

void PairFlow::add_of_points(const Four& squared_distance, const FourIntegers& known, FourFlows& flow,
                             FourFlows* slope) const {
    for (std::size_t lane = 0; lane < 4; ++lane) {
        if (known[lane] != 0) continue;
        const auto [far, far_slope] = of_points(static_cast<double>(squared_distance[lane]));
        flow.isotropic[lane] = static_cast<float>(far.isotropic);
        flow.radial[lane] = static_cast<float>(far.radial);
        if (slope == nullptr) continue;
        slope->isotropic[lane] = static_cast<float>(far_slope.isotropic);
        slope->radial[lane] = static_cast<float>(far_slope.radial);
    }
}

}  // namespace jostle
