#include "jostle/scene/validate_plane.hpp"

#include <fmt/core.h>

#include <utility>

#include "jostle/error/refuse.hpp"
#include "jostle/scene/mistakes.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/scene_flow.hpp"

namespace jostle {

namespace {

constexpr const char* in_plane = "with box.dimensions = 2";

void check_vectors(const Scene& scene) {
    const std::optional<Vec3>& edges = scene.box.edges;
    if (edges && edges->z != 0.0)
        refuse("box.edges", text(*edges), fmt::format("{} there is no edge along z", in_plane), "two numbers: x, y");
    for (const RampPoint<Vec3>& point : scene.schedule.edges)
        if (point.value.z != 0.0)
            refuse("schedule.edges", text(point.value), fmt::format("{} there is no edge along z", in_plane),
                   "two numbers: x, y");
}

void check_forces_in_plane(const Scene& scene) {
    for (const auto& [key, vector] :
         {std::pair{"forces.on_rods", scene.forces.on_rods}, {"forces.alignment_axis", scene.forces.alignment_axis}})
        if (vector.z != 0.0)
            refuse(key, text(vector), fmt::format("{} nothing moves or turns rods out of the plane", in_plane),
                   "two numbers: x, y", "");
}

void check_walls_of_plane(const Scene& scene) {
    if (scene.walls.faces[2])
        refuse("walls.faces", text(scene.walls.faces), fmt::format("{} there are no faces across z", in_plane),
               "two values: x, y", "The plane holds the rods by itself");
    if (scene.walls.container == Container::sphere)
        refuse("walls.container", "\"sphere\"", fmt::format("{} what is round is a disc", in_plane),
               "\"tube\", which is a disc in the plane", "");
}

void check_flow_of_plane(const Scene& scene) {
    if (has_flow(scene))
        refuse(scene.flow.shear_rate != 0.0 ? "flow.shear_rate" : "flow.strain_amplitude", "",
               fmt::format("{} rods in a flow have not been tried", in_plane), "no [flow]", "");
}

void check_pressure_of_plane(const Scene& scene) {
    if (scene.pressure.external)
        refuse("pressure.external", "", fmt::format("{} a bath of pressure has not been tried", in_plane),
               "no [pressure]", "");
}

void check_fixed_rods_of_plane(const Scene& scene) {
    if (!scene.rods.fixed.empty())
        refuse("rods.fixed", "\"" + scene.rods.fixed + "\"", fmt::format("{} fixed rods have not been tried", in_plane),
               "no fixed rods", "");
}

void check_mobility_of_plane(const Scene& scene) {
    if (scene.mobility.model == MobilityModel::hydrodynamic)
        refuse("mobility.model", "\"hydrodynamic\"",
               fmt::format("{} the flow round rods in a film is not known", in_plane),
               "a drag of each rod alone, \"capsule\"", "");
}

}  // namespace

void validate_plane(const Scene& scene) {
    if (dimensions_of(scene) == 3) return;
    Mistakes mistakes;
    for (const auto check : {check_vectors, check_forces_in_plane, check_walls_of_plane, check_flow_of_plane,
                             check_pressure_of_plane, check_fixed_rods_of_plane, check_mobility_of_plane})
        mistakes.look([&] { check(scene); });
    mistakes.refuse_any();
}

}  // namespace jostle
