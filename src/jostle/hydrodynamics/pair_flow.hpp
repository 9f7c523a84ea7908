#pragma once

#include <limits>

#include "jostle/hydrodynamics/four_flow_table.hpp"

namespace jostle {

/// The flow between two blobs of different rods, as it is summed in real space.
///
/// In an unbounded fluid it has no end: beyond the table it is that of points with their Faxen terms. Of a periodic box
/// it is the near part, and nothing beyond the cutoff.
class PairFlow {
public:
    static PairFlow unbounded(double spread, double viscosity);
    static PairFlow near(double spread, double splitting, double viscosity, double cutoff);

    /// Blobs farther apart do not feel each other; infinite in an unbounded fluid.
    double cutoff() const { return cutoff_; }

    BlobFlow at(double squared_distance) const {
        return squared_distance < squared_range_ ? table_.at(squared_distance) : of_points(squared_distance).flow;
    }
    BlobFlowSlope with_slope(double squared_distance) const {
        return squared_distance < squared_range_ ? table_.with_slope(squared_distance) : of_points(squared_distance);
    }

    /// Of four pairs, rounded to floats.
    FourFlows at(const Four& squared_distance) const {
        const FourIntegers known = squared_distance < in_table_;
        const FourFlows near = fours_.at(where(known, squared_distance));
        FourFlows flow{where(known, near.isotropic), where(known, near.radial)};
        if (is_unbounded() && any(~known)) add_of_points(squared_distance, known, flow);
        return flow;
    }
    FourFlowSlopes with_slope(const Four& squared_distance) const {
        const FourIntegers known = squared_distance < in_table_;
        const auto [near, near_slope] = fours_.with_slope(where(known, squared_distance));
        FourFlowSlopes flow{{where(known, near.isotropic), where(known, near.radial)},
                            {where(known, near_slope.isotropic), where(known, near_slope.radial)}};
        if (is_unbounded() && any(~known)) add_of_points(squared_distance, known, flow.flow, &flow.slope);
        return flow;
    }

    /// Whether any of four pairs is near enough to have a flow.
    bool any_flow(const Four& squared_distance) const { return is_unbounded() || any(squared_distance < in_table_); }

private:
    template <class Flow>
    PairFlow(double range, double spread, double viscosity, double cutoff, Flow&& flow);

    bool is_unbounded() const { return cutoff_ == std::numeric_limits<double>::infinity(); }
    BlobFlowSlope of_points(double squared_distance) const;
    /// Where they are not known from the table.
    void add_of_points(const Four& squared_distance, const FourIntegers& known, FourFlows& flow,
                       FourFlows* slope = nullptr) const;

    FlowTable table_;
    double squared_range_, spread_, viscosity_, cutoff_;
    Four in_table_;  ///< squared distances below it are
    FourFlowTable fours_;
};

}  // namespace jostle
