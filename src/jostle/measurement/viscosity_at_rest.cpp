#include "jostle/measurement/viscosity_at_rest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "jostle/measurement/flow_summary.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/statistics/correlation_integral.hpp"
#include "jostle/statistics/order_parameter.hpp"

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

/// Rows in a rotation time. Orientation stress is that of the row's step; it decays three times as fast as the axes,
/// and with so many rows the sum over them is right to 0.5 %.
constexpr double least_rows_a_rotation = 12.0;

/// What the formula does not hold for, or has not been tested on; empty where it does.
std::string why_not(const Scene& scene, const Simulation& simulation) {
    if (grows(scene)) return "the cells grow";
    if (flows(scene)) return "the rods are in a flow, whose viscosity is in the entry \"flow\"";
    if (has_schedule(scene)) return "a schedule changes the conditions";
    if (!simulation.keeps_equilibrium()) return "something drives the rods, so that they are not in equilibrium";
    const Box& box = simulation.box();
    if (box.dimensions() == 2) return "in the plane the formula is not tested";
    if (box.walls().any()) return "walls hold shear stress";
    if (!box.is_periodic()) return "the box is not periodic";
    if (box.fixed_rods()) return "fixed rods hold shear stress";
    if (scene.pressure.external) return "the box changes, under pressure control";
    if (scene.forces.on_rods != Vec3{} || has_torques(scene)) return "forces from outside act on the rods";
    if (!scene.springs.file.empty()) return "with springs the formula is not tested";
    if (scene.mobility.model == MobilityModel::hydrodynamic) return "the stress that the fluid carries is not known";
    return "";
}

/// Five columns of equal fluctuations, of which the deviator of an isotropic symmetric tensor consists.
Columns deviator(const Columns& stress) {
    Columns five(5, std::vector<double>(stress[0].size()));
    for (std::size_t row = 0; row < five[0].size(); ++row) {
        const double xx = stress[0][row], yy = stress[4][row], zz = stress[8][row];
        five[0][row] = 0.5 * (stress[1][row] + stress[3][row]);
        five[1][row] = 0.5 * (stress[2][row] + stress[6][row]);
        five[2][row] = 0.5 * (stress[5][row] + stress[7][row]);
        five[3][row] = 0.5 * (xx - yy);
        five[4][row] = (xx + yy - 2.0 * zz) / std::sqrt(12.0);
    }
    return five;
}

/// Why this run has no viscosity though its scene could have one; empty where it has.
std::string too_short(const ProductionWindow& window, double row_time, std::size_t rows, double nematic_order,
                      const FreeClocks& clocks) {
    if (!window.equilibrated()) return "equilibrium: " + in_words(window.equilibrium);
    const bool turn = clocks.rotation > 0.0;
    if (turn && nematic_order >= nematic_above)
        return fmt::format("a nematic (S = {:.2g}) has several viscosities", nematic_order);
    if (turn && row_time * least_rows_a_rotation > clocks.rotation)
        return fmt::format(
            "rows of the series are {:.2g} of a rotation time long: lower output.series_every to {:.2g} "
            "of what it is or less",
            row_time / clocks.rotation, clocks.rotation / least_rows_a_rotation / row_time);
    const double longest = std::max(turn ? window.equilibrium.rotation_time : 0.0, clocks.diffusion);
    const double covered = static_cast<double>(rows) * row_time / longest;
    const auto least = static_cast<double>(2 * least_windows);
    if (covered < least)
        return fmt::format("production covers {}; at least {:g} are needed",
                           in_times(covered, longest > clocks.diffusion ? "rotation time" : "diffusion time"), least);
    return "";
}

Json without_value(const std::string& unit, const std::string& reason) {
    std::string sentence = reason + ".";
    sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence.front())));
    return {{"mean", nullptr}, {"standard_error", nullptr},
            {"n_eff", 0.0},    {"no_standard_error_because", sentence},
            {"unit", unit},    {"definition", definition_of_viscosity}};
}

}  // namespace

Json viscosity_at_rest_entry(const Scene& scene, const Simulation& simulation, const ProductionWindow& window,
                             const Columns& stress, double row_time, double nematic_order, const FreeClocks& clocks) {
    const std::string unit = unit_of(scene, dimension::viscosity);
    std::string reason = why_not(scene, simulation);
    if (reason.empty()) reason = too_short(window, row_time, stress[0].size(), nematic_order, clocks);
    if (!reason.empty()) return without_value(unit, reason);
    const CorrelationIntegral found = correlation_integral(deviator(stress));
    if (!found.standard_error) {
        reason = found.no_value_reason;
        reason.pop_back();  // its full stop
        return without_value(unit, reason);
    }
    const double scale = simulation.box().volume() / simulation.settings().kT * row_time;
    return {{"mean", scale * found.value},
            {"standard_error", scale * *found.standard_error},
            {"n_eff", found.effective_samples},
            {"unit", unit},
            {"definition", definition_of_viscosity},
            {"window",
             {{"value", static_cast<double>(found.window) * row_time}, {"unit", unit_of(scene, dimension::time)}}}};
}

}  // namespace jostle
