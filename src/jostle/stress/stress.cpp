#include "jostle/stress/stress.hpp"

#include <fmt/format.h>

#include <limits>

#include "jostle/error/input_error.hpp"
#include "jostle/math/symmetric_eigen.hpp"

namespace jostle {

namespace {

void require(bool allowed, const char* key, double value, const char* range, const char* problem) {
    if (allowed && std::isfinite(value)) return;
    throw InputError({.key = key,
                      .value = fmt::format("{}", value),
                      .problem = problem,
                      .allowed = range,
                      .suggestion = "",
                      .place = {}});
}

}  // namespace

Stress assembly_stress(double number_density, double kT, const Mat3& sum_of_pair_stresses, double volume,
                       const Mat3& sum_of_spring_stresses) {
    require(number_density >= 0.0, "number_density", number_density, "finite, >= 0", "no density");
    require(kT >= 0.0, "kT", kT, "finite, >= 0", "no temperature");
    require(volume > 0.0, "volume", volume, "finite, > 0", "no volume to refer the stress to");
    return {(number_density * kT) * identity(), (1.0 / volume) * sum_of_pair_stresses,
            (1.0 / volume) * sum_of_spring_stresses};
}

double pressure(const Stress& stress) {
    return trace(stress.total()) / 3.0;
}

double pressure_collision(const Stress& stress) {
    return trace(stress.collision) / 3.0;
}

double pressure_springs(const Stress& stress) {
    return trace(stress.springs) / 3.0;
}

double compressibility(const Stress& stress, double number_density, double kT) {
    const double ideal_pressure = number_density * kT;
    require(ideal_pressure > 0.0, "number_density * kT", ideal_pressure, "finite, > 0",
            "the compressibility factor needs thermal motion");
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
