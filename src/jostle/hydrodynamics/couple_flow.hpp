#pragma once

#include "jostle/hydrodynamics/blob_kernel.hpp"

namespace jostle {

/// Variance of the Gaussian in which a couple on a sphere acts: D^2 (pi/6)^(2/3)/(4 pi), with which a sphere alone
/// turns as Stokes says, by 1/(pi viscosity D^3) for a unit couple.
double couple_spread(double diameter);

/// What couples on spheres do to blobs, and these to spheres, as it is summed in real space (theory, section 7.8): of
/// an unbounded fluid without end, of a periodic box the near part, and nothing beyond the cutoff.
class CoupleFlow {
public:
    /// `spread` of a blob of force, `couple_spread` of a couple; length^2.
    static CoupleFlow unbounded(double spread, double couple_spread, double viscosity);
    static CoupleFlow near(double spread, double couple_spread, double splitting, double viscosity, double cutoff);

    struct Rotlet {
        double value, slope;  ///< `slope` is the derivative by r^2
    };
    /// Between a blob and a couple.
    Rotlet rotlet(double squared_distance) const;
    /// Between two couples.
    BlobFlow turning(double squared_distance) const;

private:
    template <class RotletAt, class TurningAt>
    CoupleFlow(double range, double viscosity, double cutoff, RotletAt&& rotlet_at, TurningAt&& turning_at);

    FlowTable rotlet_;  ///< in its isotropic part
    FlowTable turning_;
    double squared_range_, viscosity_, cutoff_;
};

}  // namespace jostle
