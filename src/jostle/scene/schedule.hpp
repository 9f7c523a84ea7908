#pragma once

#include <string>
#include <vector>

#include "jostle/rods/rods.hpp"
#include "jostle/scene/scene.hpp"

// What of a scene changes in time by itself: its table [schedule].

namespace jostle {

/// The keys that may be ramped, one line a key: calls `visit(name, ramp, member)` with the name under [schedule], and
/// the member of the scene that the ramp starts from and stands for. The only list of them, but for the edges of the
/// box, which the state has.
template <class AnyScene, class Visitor>
void for_each_ramp(AnyScene& scene, Visitor&& visit) {
    visit("self_propulsion", scene.schedule.self_propulsion, scene.motion.self_propulsion);
    visit("kT", scene.schedule.kT, scene.fluid.kT);
}

bool has_schedule(const Scene& scene);
/// Whether the box changes.
bool squeezes_box(const Scene& scene);
/// schedule.volume_fraction; in two dimensions schedule.area_fraction.
const Ramp<double>& ramp_of_fraction(const Scene& scene);
/// The full key of what changes it.
std::string key_of_box_ramp(const Scene& scene);
/// The full keys of what is ramped, as "schedule.kT, schedule.edges".
std::string names_of_schedule(const Scene& scene);
/// When the last ramp has come to its end; 0 where there is none.
double schedule_end(const Scene& scene);

/// The scene with the values that its ramps have at a time, at their end, or in the mean from `begin` to `end`. It
/// keeps its schedule, and its box.
Scene scene_at(const Scene& scene, double time);
Scene scene_at_end(const Scene& scene);
Scene scene_during(const Scene& scene, double begin, double end);
/// With the largest that each ramp has: the scene that a time step must be short enough for.
Scene scene_at_its_hardest(const Scene& scene);

/// What a schedule of the box makes of its edges: a ramp of them, of rods of `rods_volume` in all.
Ramp<Vec3> ramp_of_edges(const Scene& scene, double rods_volume);
/// Of all rods of a scene, of which `rods` are all, or one that stands for all.
double volume_of_all(const Scene& scene, const Rods& rods);

/// time.equilibration; where it is to be detected, what it is expected to be: until the end of the schedule, and a
/// quarter of the production.
double expected_equilibration(const Scene& scene);

}  // namespace jostle
