#include "jostle/stress/stress.hpp"

#include <cmath>
#include <limits>

#include "jostle/error/refuse.hpp"
#include "jostle/math/symmetric_eigen.hpp"

namespace jostle {

Stress assembly_stress(double number_density, double kT, double volume, const StressSums& sums) {
    require_value(std::isfinite(number_density) && number_density >= 0.0, "number_density", number_density,
                  "is no density", ">= 0, finite");
    require_value(std::isfinite(kT) && kT >= 0.0, "kT", kT, "is no temperature", ">= 0, finite");
    require_value(std::isfinite(volume) && volume > 0.0, "volume", volume, "is no volume to refer the stress to",
                  "> 0, finite");
    const double per_volume = 1.0 / volume;
    return {(number_density * kT) * identity(), per_volume * sums.orientation, per_volume * sums.collision,
            per_volume * sums.springs};
}

double pressure(const Stress& stress) {
    return trace(stress.kinetic + stress.collision + stress.springs) / 3.0;
}

double pressure_collision(const Stress& stress) {
    return trace(stress.collision) / 3.0;
}

double pressure_springs(const Stress& stress) {
    return trace(stress.springs) / 3.0;
}

double compressibility(const Stress& stress, double number_density, double kT) {
    const double ideal_pressure = number_density * kT;
    require_value(std::isfinite(ideal_pressure) && ideal_pressure > 0.0, "number_density * kT", ideal_pressure,
                  "leaves no thermal motion, which the compressibility factor needs", "> 0, finite");
    return pressure(stress) / ideal_pressure;
}

std::array<double, 3> principal_stresses(const Mat3& stress) {
    return symmetric_eigen(stress).values;
}

double anisotropy_ratio(const Mat3& stress) {
    const auto principal = principal_stresses(stress);
    return principal[0] > 0.0 ? principal[2] / principal[0] : std::numeric_limits<double>::quiet_NaN();
}

double relative_asymmetry(const Mat3& stress) {
    const double size = norm(stress);
    return size > 0.0 ? norm(stress - transpose(stress)) / size : 0.0;
}

}  // namespace jostle
