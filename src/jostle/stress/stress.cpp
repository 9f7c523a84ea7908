#include "jostle/stress/stress.hpp"

#include <cmath>
#include <limits>

#include "jostle/error/refuse.hpp"
#include "jostle/math/symmetric_eigen.hpp"

namespace jostle {

Stress assembly_stress(double number_density, double kT, double volume, const StressSums& sums, int dimensions) {
    require_value(std::isfinite(number_density) && number_density >= 0.0, "number_density", number_density,
                  "is no density", ">= 0, finite");
    require_value(std::isfinite(kT) && kT >= 0.0, "kT", kT, "is no temperature", ">= 0, finite");
    require_value(std::isfinite(volume) && volume > 0.0, "volume", volume, "is no volume to refer the stress to",
                  "> 0, finite");
    const double per_volume = 1.0 / volume;
    return {(number_density * kT) * identity(dimensions), per_volume * sums.orientation, per_volume * sums.collision,
            per_volume * sums.springs, dimensions};
}

double mean_normal_stress(const Mat3& stress, int dimensions) {
    return trace(stress) / dimensions;
}

double pressure(const Stress& stress) {
    return mean_normal_stress(stress.kinetic + stress.collision + stress.springs, stress.dimensions);
}

double pressure_collision(const Stress& stress) {
    return mean_normal_stress(stress.collision, stress.dimensions);
}

double pressure_springs(const Stress& stress) {
    return mean_normal_stress(stress.springs, stress.dimensions);
}

double compressibility(const Stress& stress, double number_density, double kT) {
    const double ideal_pressure = number_density * kT;
    require_value(std::isfinite(ideal_pressure) && ideal_pressure > 0.0, "number_density * kT", ideal_pressure,
                  "leaves no thermal motion, which the compressibility factor needs", "> 0, finite");
    return pressure(stress) / ideal_pressure;
}

PrincipalStresses principal_stresses(const Mat3& stress, int dimensions) {
    const SymmetricEigen eigen = symmetric_eigen(stress);
    PrincipalStresses principal;
    std::size_t along_z = 3;  // which of the three a plane has not
    for (std::size_t k = 0; k < 3 && dimensions == 2; ++k)
        if (along_z == 3 || std::fabs(eigen.vectors[k].z) > std::fabs(eigen.vectors[along_z].z)) along_z = k;
    for (std::size_t k = 0; k < 3; ++k) {
        if (k == along_z) continue;
        principal.values.push_back(eigen.values[k]);
        principal.directions.push_back(eigen.vectors[k]);
    }
    return principal;
}

double anisotropy_ratio(const Mat3& stress, int dimensions) {
    const std::vector<double> principal = principal_stresses(stress, dimensions).values;
    return principal.front() > 0.0 ? principal.back() / principal.front() : std::numeric_limits<double>::quiet_NaN();
}

double relative_asymmetry(const Mat3& stress) {
    const double size = norm(stress);
    return size > 0.0 ? norm(stress - transpose(stress)) / size : 0.0;
}

}  // namespace jostle
