#include "jostle/scene/scene_mobility.hpp"

#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/scene/scene_motion.hpp"

namespace jostle {

namespace {

using DragOfViscosity = RodMobility (*)(double length, double diameter, double viscosity);

DragOfViscosity drag_of(MobilityModel model) {
    switch (model) {
        case MobilityModel::slender_body:
            return slender_body_drag;
        case MobilityModel::finite_aspect_ratio:
            return finite_aspect_ratio_drag;
        case MobilityModel::capsule:
        case MobilityModel::hydrodynamic:  // the own mobility of each rod
            break;
    }
    return capsule_drag;
}

/// Swimmers go where they point, and torques from outside depend on it and set spheres turning; of other spheres nobody
/// sees how they turn.
SpheresTurn spheres_of(const Scene& scene) {
    return swims(scene) || has_torques(scene) ? SpheresTurn::with_fluid : SpheresTurn::not_with_fluid;
}

}  // namespace

std::unique_ptr<Mobility> make_mobility(const Scene& scene) {
    if (scene.mobility.model == MobilityModel::hydrodynamic)
        return std::make_unique<HydrodynamicMobility>(scene.fluid.viscosity, scene.mobility.tolerance,
                                                      scene.mobility.cutoff, spheres_of(scene));
    return std::make_unique<DragMobility>(
        [drag = drag_of(scene.mobility.model), viscosity = scene.fluid.viscosity](double length, double diameter) {
            return drag(length, diameter, viscosity);
        });
}

}  // namespace jostle
