#pragma once

#include "jostle/rods/clock.hpp"

namespace jostle {

/// Simple shear, u = rate y along x (theory, section 8): steady, or to and fro.
struct ShearFlow {
    double rate = 0.0;               ///< of the steady part
    double amplitude = 0.0;          ///< of a strain amplitude sin(angular_frequency t)
    double angular_frequency = 0.0;  ///< 1/time
    double start_strain = 0.0;

    /// At a time: a function of it alone, so that a run goes on as it began.
    double strain_at(double time) const;
    /// In the step that the clock stands before.
    double strain_of_step(const Clock& clock, double time_step) const;
};

}  // namespace jostle
