#include "jostle/mobility/drag.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>

#include "jostle/error/refuse.hpp"

namespace jostle {

namespace {

using std::numbers::pi;

void require_physical(double length, double diameter, double viscosity) {
    require_value(std::isfinite(length) && length >= 0.0, "rods.length", length, "is no length of a rod",
                  ">= 0, finite");
    require_value(std::isfinite(diameter) && diameter > 0.0, "rods.diameter", diameter, "is no diameter of a rod",
                  "> 0, finite");
    require_value(std::isfinite(viscosity) && viscosity > 0.0, "fluid.viscosity", viscosity, "is no viscosity",
                  "> 0, finite");
}

/// ln p + c_0 + c_1/p + c_2/p^2 + a/p^4, where a makes it `at_sphere` at p = 1.
double bracket(double p, double c_0, double c_1, double c_2, double at_sphere) {
    const double a = at_sphere - (c_0 + c_1 + c_2);
    const double q = 1.0 / p, q_squared = q * q;
    return std::log(p) + c_0 + c_1 * q + q_squared * (c_2 + a * q_squared);
}

/// What is added to ln p in the bracket of a capsule: `slender` for p -> infinity, with corrections in 1/(1 + ln p) and
/// 1/p. The last coefficient makes the bracket `at_sphere` at p = 1.
struct CapsuleEnds {
    double slender, logarithmic, first, second, third, at_sphere;

    double bracket(double p) const {
        const double fourth = at_sphere - (slender + logarithmic + first + second + third);
        const double q = 1.0 / p, log_p = std::log(p);
        return log_p + slender + logarithmic / (1.0 + log_p) + q * (first + q * (second + q * (third + q * fourth)));
    }
};

constexpr double ln2 = std::numbers::ln2;
constexpr CapsuleEnds along{2.0 * ln2 - 3.0 / 2.0, -0.5296, 1.8690, -0.9193, 0.3373, 2.0 / 3.0};
constexpr CapsuleEnds across{2.0 * ln2 - 1.0 / 2.0, -0.3699, 0.9555, -0.1381, -0.1271, 4.0 / 3.0};
constexpr CapsuleEnds turning{2.0 * ln2 - 11.0 / 6.0, -0.6291, 2.4920, -2.5381, 2.0681, 1.0 / 3.0};

}  // namespace

RodMobility capsule_drag(double length, double diameter, double viscosity) {
    require_physical(length, diameter, viscosity);
    const double total = length + diameter;
    const double p = total / diameter;
    const double unit = pi * viscosity * total;
    return {along.bracket(p) / (2.0 * unit), across.bracket(p) / (4.0 * unit),
            3.0 * turning.bracket(p) / (unit * total * total)};
}

RodMobility slender_body_drag(double length, double diameter, double viscosity) {
    require_physical(length, diameter, viscosity);
    const double b = length > 0.0 ? 2.0 * std::log(2.0 * length / diameter) - 1.0 : -1.0;
    if (b <= 0.0)
        refuse("mobility.model", "slender_body",
               fmt::format("gives a rod of L/D = {:.4g} negative drag along its axis", length / diameter),
               "L/D > sqrt(e)/2 = 0.824", "Use capsule, which holds for every L/D >= 0");
    const double unit = 8.0 * pi * viscosity * length;
    return {2.0 * b / unit, (b + 2.0) / unit, 12.0 * (b + 2.0) / (unit * length * length)};
}

RodMobility finite_aspect_ratio_drag(double length, double diameter, double viscosity) {
    require_physical(length, diameter, viscosity);
    const double total = length + diameter;
    const double p = total / diameter;
    const double unit = pi * viscosity * total;
    return {bracket(p, -0.207, 0.980, -0.133, 2.0 / 3.0) / (2.0 * unit),
            bracket(p, 0.839, 0.185, 0.233, 4.0 / 3.0) / (4.0 * unit),
            3.0 * bracket(p, -0.662, 0.917, -0.050, 1.0 / 3.0) / (unit * total * total)};
}

}  // namespace jostle
