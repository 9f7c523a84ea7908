#include "jostle/scene/pressure_control.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// In D, by which rods that touch are brought nearer, root mean square.
constexpr double automatic_strain = 0.01, advised_strain = 0.03, largest_strain = 0.1;

}  // namespace

double pressure_relaxation_time(const Scene& scene) {
    if (scene.pressure.relaxation_time) return *scene.pressure.relaxation_time;
    const RodMobility rod = capsule_drag(scene.rods.length, scene.rods.diameter, scene.fluid.viscosity);
    const double size = scene.rods.length + scene.rods.diameter;
    return size * size / (thermal_energy(scene) * (rod.parallel + 2.0 * rod.perpendicular) / 3.0);
}

StepLimit pressure_limit(const Scene& scene, const Rods& rods) {
    double slenderest = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i)
        slenderest = std::max(slenderest, (rods.length[i] + rods.diameter[i]) / rods.diameter[i]);
    const bool orthogonal = scene.pressure.coupling == StrainCoupling::orthogonal;
    const double count =
        rods_are_given(scene) ? static_cast<double>(rods.size()) : static_cast<double>(scene.rods.count);
    return {.key = "pressure.relaxation_time",
            .value = rounded(pressure_relaxation_time(scene)),
            .harm = "lets the box tremble so that contacts cannot follow",
            .what = "the noise of the box brings rods that touch nearer, in the root mean square, by",
            .unit = "D",
            .remedy = "a longer relaxation_time",
            .rate = 2.0 / (pressure_relaxation_time(scene) * count),
            .scale = (orthogonal ? 1.0 : 3.0) / slenderest,
            .diffusive = true,
            .automatic = automatic_strain,
            .advised = advised_strain,
            .largest = largest_strain};
}

void validate_pressure(const Scene& scene) {
    if (!scene.pressure.external) return;
    const std::string value = text(*scene.pressure.external);
    const auto not_with = [&](bool there, const char* what, const char* remedy) {
        if (there) refuse("pressure.external", value, what, "no [pressure]", remedy);
    };
    not_with(thermal_energy(scene) == 0.0 || !scene.schedule.kT.empty(),
             "the box is moved by noise of the rods' temperature, which is to be above 0 and stay",
             "Compress by [schedule] without thermal motion");
    not_with(scene_walls(scene).any(), "walls bear the pressure of the rods", "Move planes by schedule.edges");
    not_with(!(scene.box.periodic == std::array{true, true, true}), "the box is open, and nothing holds the rods",
             "Make the box periodic along all directions");
    not_with(has_flow(scene), "a flow shears the box, whose volume stays", "Keep one of the two");
    not_with(scene.growth.rate > 0.0, "cells that grow change what fills the box", "Remove [growth], or [pressure]");
    not_with(swims(scene), "the pressure of swimmers is not known from their contacts", "Remove self_propulsion");
    not_with(squeezes_box(scene), "a schedule sets the size of the box", "Keep one of the two");
    not_with(!scene.rods.fixed.empty(), "fixed rods stay where they are", "Remove rods.fixed");
    not_with(scene.mobility.model == MobilityModel::hydrodynamic, "the fluid would have to flow with the box",
             "Use mobility.model = \"capsule\"");
    not_with(scene.contact.model == ContactModel::wca, "soft rods have not been tried", "Use contact.model = \"hard\"");
    not_with(!scene.contact.brownian_correction,
             "without the time-step correction the volume would be wrong by several per cent",
             "Remove contact.brownian_correction = false");
    if (scene.pressure.coupling == StrainCoupling::orthogonal && !scene.springs.file.empty())
        refuse("pressure.coupling", "\"orthogonal\"", "springs' part of the force on each edge is not measured",
               "\"isotropic\"", "");
}

}  // namespace jostle
