#pragma once

#include <limits>
#include <numbers>

#include "jostle/hydrodynamics/blob_kernel.hpp"

namespace jostle {

/// The flow between two blobs of different rods, as it is summed in real space.
///
/// In an unbounded fluid it has no end: beyond the table it is that of points with their Faxen terms. Of a periodic box
/// it is the near part, and nothing beyond the cutoff.
class PairFlow {
public:
    static PairFlow unbounded(double spread, double viscosity) {
        const double range = 12.0 * std::sqrt(spread);  // where erfc(r/(2 sqrt(spread))) is below 1e-16
        return {range, spread, viscosity, std::numeric_limits<double>::infinity(),
                [=](double squared) { return stokes_flow(spread, viscosity, squared); }};
    }
    static PairFlow near(double spread, double splitting, double viscosity, double cutoff) {
        return {cutoff, spread, viscosity, cutoff,
                [=](double squared) { return near_flow(spread, splitting, viscosity, squared); }};
    }

    /// Blobs farther apart do not feel each other; infinite in an unbounded fluid.
    double cutoff() const { return cutoff_; }

    BlobFlow at(double squared_distance) const {
        return squared_distance < squared_range_ ? table_.at(squared_distance) : of_points(squared_distance).flow;
    }
    BlobFlowSlope with_slope(double squared_distance) const {
        return squared_distance < squared_range_ ? table_.with_slope(squared_distance) : of_points(squared_distance);
    }

private:
    static constexpr std::size_t intervals = 4096;

    template <class Flow>
    PairFlow(double range, double spread, double viscosity, double cutoff, Flow&& flow)
        : table_(range, intervals, flow),
          squared_range_(range * range),
          spread_(spread),
          viscosity_(viscosity),
          cutoff_(cutoff) {}

    BlobFlowSlope of_points(double squared_distance) const {
        if (squared_distance > cutoff_ * cutoff_) return {};
        const double inverse = 1.0 / squared_distance;
        const double unit = 0.25 / (std::numbers::pi * viscosity_) * std::sqrt(inverse), faxen = spread_ * inverse;
        return {{unit * (0.5 + faxen), unit * inverse * (0.5 - 3.0 * faxen)},
                {-unit * inverse * (0.25 + 1.5 * faxen), -unit * inverse * inverse * (0.75 - 7.5 * faxen)}};
    }

    FlowTable table_;
    double squared_range_, spread_, viscosity_, cutoff_;
};

}  // namespace jostle
