#include "jostle/scene/scene_walls.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

using Three = std::array<bool, 3>;

/// In the plane it is a disc.
int axis_of_tube(const Scene& scene) {
    return dimensions_of(scene) == 2 ? 2 : static_cast<int>(scene.walls.axis);
}

void check_periodic(const Scene& scene) {
    const Three ends = walled_directions(scene);
    const Three periodic = box_periodic(scene);
    Three open = periodic;
    for (std::size_t k = 0; k < 3; ++k) open[k] = open[k] && !ends[k];
    if (open == periodic) return;
    refuse("box.periodic", text(periodic), "has periodic directions that end at walls", "periodic = " + text(open),
           "A wall ends the box in the directions that it stands across");
}

void check_container(const Scene& scene, double rods_volume) {
    const Container container = scene.walls.container;
    const bool no_such_wall = container == Container::sphere && dimensions_of(scene) == 2;  // refused anyhow
    if (container == Container::none || no_such_wall) return;
    const auto word = std::string(word_of(container));
    Three faces = scene.walls.faces;
    const auto axis = static_cast<std::size_t>(axis_of_tube(scene));
    for (std::size_t k = 0; k < 3; ++k) faces[k] = faces[k] && container == Container::tube && k == axis;
    if (faces != scene.walls.faces)
        refuse("walls.faces", text(scene.walls.faces),
               fmt::format("puts planes where container = \"{}\" is the wall", word), text(faces),
               "Remove faces, or the container");
    const Vec3 edges = box_edges(scene, rods_volume);
    const auto k = static_cast<int>(axis);
    const double a = edges[(k + 1) % 3], b = edges[(k + 2) % 3];
    const bool round =
        std::fabs(a - b) <= 1e-9 * a && (container == Container::tube || std::fabs(edges[k] - a) <= 1e-9 * a);
    if (!round)
        refuse(scene.box.edges ? "box.edges" : "box.shape", text(scene.box.edges.value_or(scene.box.shape)),
               fmt::format("leaves no round {}, which touches the faces of the box", word),
               container == Container::sphere ? "three edges alike" : "the two edges across walls.axis alike",
               "The edges are the diameter of the " + word);
}

/// What is left for the centres of ends between walls, direction by direction; infinite where nothing ends the box.
Vec3 room_of_ends(const Scene& scene, const Vec3& edges, double thickest) {
    const Three ends = walled_directions(scene);
    Vec3 room;
    for (int k = 0; k < 3; ++k) room[k] = ends[static_cast<std::size_t>(k)] ? edges[k] - thickest : INFINITY;
    return room;
}

/// The longest rod (cylinder part) that fits.
double longest_between(const Scene& scene, const Vec3& room) {
    switch (scene.walls.container) {
        case Container::sphere:
            return room.x;
        case Container::tube: {
            const int k = axis_of_tube(scene);
            if (dimensions_of(scene) == 2) return room[(k + 1) % 3];
            return std::hypot(room[k], room[(k + 1) % 3]);
        }
        default:
            return norm(room);
    }
}

void check_room_of_rods(const Scene& scene, double rods_volume, double longest, double thickest) {
    Vec3 edges = box_edges(scene, rods_volume);
    for (const RampPoint<Vec3>& point : ramp_of_edges(scene, rods_volume))  // the narrowest that planes come to stand
        for (int k = 0; k < 3; ++k)
            if (scene.walls.faces[static_cast<std::size_t>(k)]) edges[k] = std::min(edges[k], point.value[k]);
    const Vec3 room = room_of_ends(scene, edges, thickest);
    const bool given = scene.box.edges.has_value();
    const std::string key = given ? "box.edges" : fraction_key(scene);
    const std::string value = given ? text(edges) : text(*given_fraction(scene));
    for (int k = 0; k < 3; ++k)
        if (!(room[k] > 0.0))
            refuse(key, value,
                   fmt::format("leaves no room between the walls along {}: they are {} apart, and rods up to {} thick",
                               "xyz"[k], rounded(edges[k]), rounded(thickest)),
                   fmt::format("more than {}", rounded(thickest)), "");
    const double most = longest_between(scene, room);
    const double length = std::max(longest, grows(scene) ? scene.growth.division_length : 0.0);
    if (!(length <= most))
        refuse(grows(scene) && length > longest ? "growth.division_length" : "rods.length", rounded(length),
               fmt::format("does not fit between the walls in any direction: these leave {}", rounded(most)),
               fmt::format("at most {}", rounded(most)), "Enlarge the box, or use shorter rods");
    if (scene.rods.start != StartKind::aligned) return;
    const Vec3 axis = normalised(scene.rods.axis);
    for (int k = 0; k < 3; ++k)
        if (!(longest * std::fabs(axis[k]) <= room[k]))
            refuse("rods.axis", text(scene.rods.axis),
                   fmt::format("lays rods of length {} across walls that leave {} along {}", rounded(longest),
                               rounded(room[k]), "xyz"[k]),
                   fmt::format("at most {} of their length along {}", rounded(room[k]), "xyz"[k]), "");
}

}  // namespace

Walls scene_walls(const Scene& scene) {
    return {scene.walls.faces, scene.walls.container, axis_of_tube(scene), scene.walls.torque};
}

Three walled_directions(const Scene& scene) {
    Three ends = scene.walls.faces;
    for (std::size_t k = 0; k < 3; ++k) {
        const bool along_tube =
            scene.walls.container == Container::tube && k == static_cast<std::size_t>(axis_of_tube(scene));
        ends[k] = ends[k] || (scene.walls.container != Container::none && !along_tube);
    }
    return ends;
}

void validate_walls(const Scene& scene, double rods_volume, double longest, double thickest) {
    if (!scene_walls(scene).any()) return;
    check_periodic(scene);
    check_container(scene, rods_volume);
    check_room_of_rods(scene, rods_volume, longest, thickest);
    if (scene.mobility.model == MobilityModel::hydrodynamic)
        refuse("mobility.model", "\"hydrodynamic\"", "knows no flow beside walls",
               "a drag of each rod alone, \"capsule\"");
}

}  // namespace jostle
