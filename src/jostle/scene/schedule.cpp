#include "jostle/scene/schedule.hpp"

#include <algorithm>

#include "jostle/scene/scene_box.hpp"

namespace jostle {

namespace {

/// Of the production, where equilibration is detected.
constexpr double expected_part = 0.25;

/// All ramps, those of the box, too: calls `visit(name, ramp)`.
template <class Visitor>
void for_all_ramps(const Scene& scene, Visitor&& visit) {
    for_each_ramp(scene, [&](const char* name, const auto& ramp, const auto&) { visit(name, ramp); });
    visit("edges", scene.schedule.edges);
    visit(dimensions_of(scene) == 2 ? "area_fraction" : "volume_fraction", ramp_of_fraction(scene));
}

}  // namespace

bool has_schedule(const Scene& scene) {
    return !(scene.schedule == Scene::ScheduleTable{});
}

bool squeezes_box(const Scene& scene) {
    return !scene.schedule.edges.empty() || !ramp_of_fraction(scene).empty();
}

const Ramp<double>& ramp_of_fraction(const Scene& scene) {
    return dimensions_of(scene) == 2 ? scene.schedule.area_fraction : scene.schedule.volume_fraction;
}

std::string key_of_box_ramp(const Scene& scene) {
    if (!scene.schedule.edges.empty()) return "schedule.edges";
    return dimensions_of(scene) == 2 ? "schedule.area_fraction" : "schedule.volume_fraction";
}

std::string names_of_schedule(const Scene& scene) {
    std::string names;
    for_all_ramps(scene, [&](const char* name, const auto& ramp) {
        if (!ramp.empty()) names += (names.empty() ? "schedule." : ", schedule.") + std::string(name);
    });
    return names;
}

double schedule_end(const Scene& scene) {
    double end = 0.0;
    for_all_ramps(scene, [&](const char*, const auto& ramp) {
        if (!ramp.empty()) end = std::max(end, ramp.back().time);
    });
    return end;
}

Scene scene_at(const Scene& scene, double time) {
    Scene now = scene;
    for_each_ramp(now, [&](const char*, const auto& ramp, auto& member) { member = value_at(member, ramp, time); });
    return now;
}

Scene scene_at_end(const Scene& scene) {
    return scene_at(scene, schedule_end(scene));
}

Scene scene_during(const Scene& scene, double begin, double end) {
    Scene now = scene;
    for_each_ramp(now,
                  [&](const char*, const auto& ramp, auto& member) { member = mean_over(member, ramp, begin, end); });
    return now;
}

Scene scene_at_its_hardest(const Scene& scene) {
    Scene hardest = scene;
    if (scene.contact.model == ContactModel::wca)  // which "auto" takes from kT as the scene begins
        hardest.contact.energy = scene.contact.energy.value_or(scene.fluid.kT);
    for_each_ramp(hardest, [](const char*, const auto& ramp, auto& member) {
        for (const auto& point : ramp) member = std::max(member, point.value);
    });
    return hardest;
}

Ramp<Vec3> ramp_of_edges(const Scene& scene, double rods_volume) {
    Ramp<Vec3> ramp = scene.schedule.edges;
    Scene at_point = scene;
    if (scene.box.edges) {  // whose shape is kept
        at_point.box.shape = *scene.box.edges;
        at_point.box.edges.reset();
    }
    for (const auto& [time, fraction] : ramp_of_fraction(scene)) {
        (dimensions_of(scene) == 2 ? at_point.box.area_fraction : at_point.box.volume_fraction) = fraction;
        ramp.push_back({time, box_edges(at_point, rods_volume)});
    }
    return ramp;
}

double volume_of_all(const Scene& scene, const Rods& rods) {
    const bool stands_for_all = rods.size() == 1 && scene.rods.count > 1 && !rods_are_given(scene);
    return stands_for_all ? rods_volume(scene) : total_volume(rods, dimensions_of(scene));
}

double expected_equilibration(const Scene& scene) {
    return scene.time.equilibration.value_or(schedule_end(scene) + expected_part * scene.time.production);
}

}  // namespace jostle
