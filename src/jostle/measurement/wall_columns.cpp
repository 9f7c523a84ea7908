#include "jostle/measurement/wall_columns.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "jostle/measurement/stress_columns.hpp"
#include "jostle/measurement/stress_ratio_checks.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/units.hpp"

namespace jostle {

namespace {

constexpr const char* sign = "positive: rods push the wall outwards";
constexpr const char* mean_of_steps = "mean over the steps since the last row";

double pressure_on(const WallGroup& group, const RowState& row) {
    double force = 0.0, area = 0.0;
    const Box& box = row.simulation.box();
    for (const Wall& wall : walls_of(box)) {
        if (wall.number < group.first || wall.number >= group.first + group.number) continue;
        force += row.sums.wall_force[wall.number] / row.sums.steps;
        area += area_of(wall, box);
    }
    return force / area;
}

/// The stress along the normal of the walls: of a tube its mean over all directions across, of a sphere over all.
double normal_stress(const WallGroup& group, const Walls& walls, const Mat3& stress) {
    if (group.first != container_number) return stress.m[4 * (group.first / 2)];
    if (walls.container == Container::sphere) return mean_normal_stress(stress, 3);
    return 0.5 * (trace(stress) - stress.m[4 * static_cast<std::size_t>(walls.axis)]);
}

}  // namespace

std::string force_column(const Wall& wall) {
    if (wall.shape != Wall::Shape::plane) return "wall_force";
    std::string name = std::string("wall_force_") + name_of(wall);
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
}

std::vector<WallGroup> wall_groups(const Walls& walls) {
    std::vector<WallGroup> groups;
    for (std::uint32_t k = 0; k < 3; ++k)
        if (walls.faces[k])
            groups.push_back(
                {fmt::format("wall_pressure_{}", "xyz"[k]), fmt::format("both planes across {}", "xyz"[k]), 2 * k, 2});
    if (walls.container != Container::none)
        groups.push_back(
            {"wall_pressure", walls.container == Container::tube ? "the tube" : "the sphere", container_number, 1});
    return groups;
}

void add_wall_columns(const Scene& scene, TableColumns<RowState>& series) {
    const Walls walls = scene_walls(scene);
    const std::string force = unit_of(scene, dimension::force), stress = unit_of_stress(scene);
    for (const Wall& wall : walls_of({{1, 1, 1}, box_periodic(scene), walls}))
        series.columns.push_back(
            {{force_column(wall), force, "F_w",
              fmt::format("sum of the contact forces on the wall {}, {}", name_of(wall), mean_of_steps), sign},
             [number = wall.number](const RowState& row) { return row.sums.wall_force[number] / row.sums.steps; }});
    for (const WallGroup& group : wall_groups(walls))
        series.columns.push_back({{group.column, stress, "P_w",
                                   fmt::format("force on {} over their area, {}", group.in_words, mean_of_steps), sign},
                                  [group](const RowState& row) { return pressure_on(group, row); }});
}

nlohmann::ordered_json wall_pressure_check(const WallGroup& group, const Walls& walls, const Columns& stress,
                                           const std::vector<double>& pressure) {
    Columns columns = stress;
    columns.push_back(pressure);
    const Estimate measured = jackknife(columns, [&](std::span<const double> means) {
        return means[9] / normal_stress(group, walls, stress_of(means.first(9)));
    });
    return check_of_one(fmt::format("pressure on {} over the whole stress along their normal", group.in_words),
                        measured);
}

}  // namespace jostle
