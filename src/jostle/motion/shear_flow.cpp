#include "jostle/motion/shear_flow.hpp"

#include <cmath>

namespace jostle {

double ShearFlow::strain_at(double time) const {
    return start_strain + rate * time + amplitude * std::sin(angular_frequency * time);
}

double ShearFlow::strain_of_step(const Clock& clock, double time_step) const {
    const double half = 0.5 * angular_frequency * time_step;
    const double middle = (static_cast<double>(clock.step) + 0.5) * time_step;
    return rate * time_step + 2.0 * amplitude * std::cos(angular_frequency * middle) * std::sin(half);
}

}  // namespace jostle
