#include "jostle/scene/step_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

constexpr double reference_step = 0.06, longest_measured_step = 0.1;
constexpr double error_of_fluids = 0.009, error_of_ordered_rods = 0.036;
/// There the order S of nematics is right to 0.01, next to the transition to 0.02, if its error goes with the square of
/// the step (docs/decisions/0087).
constexpr double step_of_ordered_rods = 0.025;

/// Whether rods are long and crowded enough to order.
bool rods_order(const Scene& scene, const Rods& rods, const Box& box) {
    double aspect_ratio = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i)
        aspect_ratio = std::max(aspect_ratio, rods.length[i] / rods.diameter[i]);
    return volume_of_all(scene, rods) / box.volume() > isotropic_limit(aspect_ratio, dimensions_of(scene));
}

}  // namespace

StepError known_step_error(const Scene& scene, const Rods& rods, const Box& box) {
    if (rods_order(scene, rods, box)) return {"rods that order", error_of_ordered_rods};
    return {"isotropic fluids", error_of_fluids};
}

double largest_step_error(double rms_step, const StepError& error) {
    const double ratio = rms_step / reference_step;
    return error.at_reference * ratio * ratio;
}

double rms_step_of_accuracy(double accuracy, const StepError& error) {
    return std::min(reference_step * std::sqrt(accuracy / error.at_reference), longest_measured_step);
}

std::optional<double> rms_step_of_ordered_rods(const Scene& scene, const Rods& rods, const Box& box) {
    if (!unknown_step_error(scene).empty() || !rods_order(scene, rods, box)) return std::nullopt;
    return step_of_ordered_rods;
}

std::string unknown_step_error(const Scene& scene) {
    if (thermal_energy(scene) == 0.0) return "there is no Brownian motion";
    if (!scene.contact.brownian_correction) return "contact.brownian_correction = false";
    if (scene.contact.model != ContactModel::hard) return "rods are soft";
    if (swims(scene)) return "rods swim";
    if (grows(scene)) return "rods grow";
    if (flows(scene)) return "there is a flow";
    if (scene.pressure.external) return "a pressure sets the volume";
    if (has_schedule(scene)) return "there is a [schedule]";
    if (dimensions_of(scene) == 2) return "rods lie in a plane";
    if (scene.mobility.model == MobilityModel::hydrodynamic) return "rods move each other through the fluid";
    return "";
}

}  // namespace jostle
