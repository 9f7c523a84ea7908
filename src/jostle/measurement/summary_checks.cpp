#include "jostle/measurement/summary_checks.hpp"

#include <algorithm>

#include "jostle/measurement/flow_summary.hpp"
#include "jostle/measurement/pressure_summary.hpp"
#include "jostle/measurement/stress_columns.hpp"
#include "jostle/measurement/stress_ratio_checks.hpp"
#include "jostle/measurement/wall_columns.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/stress/column_names.hpp"

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

/// A constant force makes the stress along it differ from place to place; at the middle of the box it is that of its
/// mean, and as much as the moment of the force more.
Columns with_force_moment(const SummarisedRun& run) {
    Columns stress = run.stress;
    if (run.scene.forces.on_rods == Vec3{}) return stress;
    const Columns moment = run.columns(force_moment_column_names);
    for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t row = 0; row < moment[k].size(); ++row) stress[4 * k][row] += moment[k][row];
    return stress;
}

/// Of rods in equilibrium.
void add_equilibrium_checks(const SummarisedRun& run, Json& checks) {
    const Rods& rods = run.simulation.rods();
    const Box& box = run.simulation.box();
    const Walls& walls = box.walls();
    if (box.is_periodic())
        checks["total_stress_ratio"] = total_stress_ratio_check(run.stress, run.order, run.dimensions());
    if (run.scene.pressure.external) checks["bath_pressure_ratio"] = bath_pressure_check(run);
    for (const WallGroup& group : wall_groups(walls))
        checks[group.column + "_ratio"] =
            wall_pressure_check(group, walls, with_force_moment(run), run.column(group.column));
    if (all_alike(rods) && !walls.any() && !has_torques(run.scene))
        checks["collision_stress_ratio"] = collision_stress_ratio_check(
            run.collision, run.order, run.column("Z"), rods.length.front() / rods.diameter.front(), run.dimensions());
}

/// Of rods that a steady flow turns.
void add_flow_checks(const SummarisedRun& run, Json& checks) {
    checks["torque_ratio"] = torque_ratio_check(run.series, run.first());
    checks["torque_identity"] = torque_identity_check(run.series, run.first(), run.stress_unit);
}

}  // namespace

Json summary_checks(const SummarisedRun& run) {
    Json checks = Json::object();
    const Rods& rods = run.simulation.rods();
    if (run.simulation.keeps_equilibrium() && !run.has_springs() && !run.ramped && !run.simulation.box().fixed_rods())
        add_equilibrium_checks(run, checks);
    const bool turns = std::any_of(rods.length.begin(), rods.length.end(), [](double length) { return length > 0.0; });
    if (flows(run.scene) && !oscillates(run.scene) && turns && run.is_thermal() && !run.has_springs() && !run.ramped)
        add_flow_checks(run, checks);
    return checks;
}

}  // namespace jostle
