#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

#include "jostle/math/range.hpp"
#include "jostle/rods/clock.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// Exponents of length, time and force, from which every unit that jostle names can be built.
struct Dimension {
    int length = 0;
    int time = 0;
    int force = 0;
    bool operator==(const Dimension&) const = default;
};

namespace dimension {
inline constexpr Dimension none{0, 0, 0}, length{1, 0, 0}, time{0, 1, 0}, force{0, 0, 1}, volume{3, 0, 0};
inline constexpr Dimension speed{1, -1, 0}, rate{0, -1, 0}, number_density{-3, 0, 0};
inline constexpr Dimension energy{1, 0, 1}, stress{-2, 0, 1}, viscosity{-2, 1, 1};
// In two dimensions a stress is a force over a length, and a density a number over an area.
inline constexpr Dimension stress_in_plane{-1, 0, 1}, number_density_in_plane{-2, 0, 0};
}  // namespace dimension

/// What the table below says of a key. `may_change`: a run that goes on may have another value, for it is no part of
/// the physics, nor of what a row of the series is: it ends the run, or says what else is written and when.
///
/// A number with a dimension, or a ramp of such numbers, ...
struct Quantity {
    Dimension dimension;
    Range range;
    bool automatic = false;  ///< "auto" is admitted, and means an empty member
    bool may_change = false;
};
/// ... a whole number, ...
struct Count {
    std::uint64_t lower = 0;
    std::uint64_t upper = std::numeric_limits<std::int64_t>::max();  // the largest whole number of TOML
    bool automatic = false;                                          ///< "auto" is admitted, and means an empty member
    bool may_change = false;
};
/// ... or a text, one of a few words (`words`), or true and false.
struct Plain {
    bool may_change = false;
};

inline constexpr Range positive{Range::smallest, Range::largest};
inline constexpr Range zero_or_positive{0.0, Range::largest};
inline constexpr Range positive_length{Range::smallest_length, Range::largest_length};
inline constexpr Range zero_or_positive_length{0.0, Range::largest_length};

/// The keys of a scene, one line a key: calls `visit(table, name, member, Quantity or Count or Plain)` for each of
/// them.
///
/// The only list of the keys: reading, writing and range checks all go through it. `scene` is a Scene or a const Scene.
template <class AnyScene, class Visitor>
void for_each_key(AnyScene& scene, Visitor&& visit) {
    namespace dim = dimension;
    visit("", "title", scene.title, Plain{.may_change = true});
    visit("", "seed", scene.seed, Count{});
    visit("units", "system", scene.units.system, Plain{});          // before every number, which may carry a unit
    visit("box", "dimensions", scene.box.dimensions, Count{2, 3});  // before every vector
    visit("box", "volume_fraction", scene.box.volume_fraction, Quantity{dim::none, {Range::smallest, 1.0, false}});
    visit("box", "area_fraction", scene.box.area_fraction, Quantity{dim::none, {Range::smallest, 1.0, false}});
    visit("box", "shape", scene.box.shape, Quantity{dim::none, {1e-6, 1e6}});
    visit("box", "edges", scene.box.edges, Quantity{dim::length, positive});
    visit("box", "periodic", scene.box.periodic, Plain{});
    visit("walls", "faces", scene.walls.faces, Plain{});
    visit("walls", "container", scene.walls.container, Plain{});
    visit("walls", "axis", scene.walls.axis, Plain{});
    visit("walls", "torque", scene.walls.torque, Plain{});
    visit("rods", "count", scene.rods.count, Count{1, (std::uint64_t{1} << 31) - 1});
    visit("rods", "length", scene.rods.length, Quantity{dim::length, zero_or_positive_length});
    visit("rods", "diameter", scene.rods.diameter, Quantity{dim::length, positive_length});
    visit("rods", "length_deviation", scene.rods.length_deviation, Quantity{dim::length, zero_or_positive_length});
    visit("rods", "diameter_deviation", scene.rods.diameter_deviation, Quantity{dim::length, zero_or_positive_length});
    visit("rods", "start", scene.rods.start, Plain{});
    visit("rods", "axis", scene.rods.axis, Quantity{dim::none, {-Range::largest, Range::largest}});
    visit("rods", "file", scene.rods.file, Plain{});
    visit("rods", "run", scene.rods.run, Plain{});
    visit("rods", "frame", scene.rods.frame, Count{.automatic = true});
    visit("rods", "fixed", scene.rods.fixed, Plain{});
    visit("fluid", "viscosity", scene.fluid.viscosity, Quantity{dim::viscosity, positive});
    visit("fluid", "kT", scene.fluid.kT, Quantity{dim::energy, zero_or_positive});
    visit("mobility", "model", scene.mobility.model, Plain{});
    visit("mobility", "tolerance", scene.mobility.tolerance, Quantity{dim::none, {1e-6, 1e-2}});
    visit("mobility", "cutoff", scene.mobility.cutoff, Quantity{dim::length, positive_length, true});
    visit("motion", "brownian", scene.motion.brownian, Plain{});
    visit("motion", "self_propulsion", scene.motion.self_propulsion, Quantity{dim::speed, zero_or_positive});
    visit("motion", "self_propulsion_deviation", scene.motion.self_propulsion_deviation,
          Quantity{dim::speed, zero_or_positive});
    visit("motion", "tumble_rate", scene.motion.tumble_rate, Quantity{dim::rate, zero_or_positive});
    visit("motion", "tumble_time", scene.motion.tumble_time, Quantity{dim::time, positive, true});
    visit("motion", "reversal_rate", scene.motion.reversal_rate, Quantity{dim::rate, zero_or_positive});
    visit("motion", "force_dipole", scene.motion.force_dipole,
          Quantity{dim::energy, {-Range::largest, Range::largest}});
    visit("forces", "on_rods", scene.forces.on_rods, Quantity{dim::force, {-Range::largest, Range::largest}});
    visit("forces", "drift", scene.forces.drift, Plain{});
    visit("forces", "alignment_energy", scene.forces.alignment_energy,
          Quantity{dim::energy, {-Range::largest, Range::largest}});
    visit("forces", "alignment_axis", scene.forces.alignment_axis,
          Quantity{dim::none, {-Range::largest, Range::largest}});
    visit("flow", "shear_rate", scene.flow.shear_rate, Quantity{dim::rate, {-Range::largest, Range::largest}});
    visit("flow", "strain_amplitude", scene.flow.strain_amplitude, Quantity{dim::none, {0.0, 1e3}});
    visit("flow", "frequency", scene.flow.frequency, Quantity{dim::rate, zero_or_positive});
    visit("flow", "start_strain", scene.flow.start_strain, Quantity{dim::none, {0.0, 1e6}});
    visit("growth", "rate", scene.growth.rate, Quantity{dim::speed, zero_or_positive});
    visit("growth", "rate_deviation", scene.growth.rate_deviation, Quantity{dim::none, {0.0, 0.5}});
    visit("growth", "division", scene.growth.division, Plain{});
    visit("growth", "division_length", scene.growth.division_length, Quantity{dim::length, positive_length});
    visit("growth", "division_deviation", scene.growth.division_deviation, Quantity{dim::none, {0.0, 0.5}});
    visit("growth", "daughters", scene.growth.daughters, Plain{});
    visit("growth", "stall_force", scene.growth.stall_force, Quantity{dim::force, positive});
    visit("growth", "stall_memory", scene.growth.stall_memory, Quantity{dim::time, positive, true});
    visit("growth", "death_rate", scene.growth.death_rate, Quantity{dim::rate, zero_or_positive});
    visit("growth", "division_every", scene.growth.division_every, Count{1, max_steps});
    visit("schedule", "self_propulsion", scene.schedule.self_propulsion, Quantity{dim::speed, zero_or_positive});
    visit("schedule", "kT", scene.schedule.kT, Quantity{dim::energy, zero_or_positive});
    visit("schedule", "edges", scene.schedule.edges, Quantity{dim::length, positive});
    visit("schedule", "volume_fraction", scene.schedule.volume_fraction,
          Quantity{dim::none, {Range::smallest, 1.0, false}});
    visit("schedule", "area_fraction", scene.schedule.area_fraction,
          Quantity{dim::none, {Range::smallest, 1.0, false}});
    visit("pressure", "external", scene.pressure.external, Quantity{dim::stress, positive});
    visit("pressure", "coupling", scene.pressure.coupling, Plain{});
    visit("pressure", "relaxation_time", scene.pressure.relaxation_time, Quantity{dim::time, positive, true});
    visit("pressure", "limit_volume_fraction", scene.pressure.limit_volume_fraction,
          Quantity{.dimension = dim::none, .range = {Range::smallest, 1.0, false}, .may_change = true});
    visit("springs", "file", scene.springs.file, Plain{});
    visit("contact", "model", scene.contact.model, Plain{});
    visit("contact", "energy", scene.contact.energy, Quantity{dim::energy, positive, true});
    visit("contact", "brownian_correction", scene.contact.brownian_correction, Plain{});
    visit("contact", "range", scene.contact.range, Quantity{dim::length, positive, true});
    visit("contact", "overlap_limit", scene.contact.overlap_limit,
          Quantity{.dimension = dim::none, .range = {0.0, 1.0, false, false}, .may_change = true});
    visit("solver", "method", scene.solver.method, Plain{});
    visit("solver", "warm_start", scene.solver.warm_start, Plain{});
    visit("solver", "step_rule", scene.solver.step_rule, Plain{});
    visit("solver", "residual", scene.solver.residual, Plain{});
    visit("solver", "tolerance", scene.solver.tolerance, Quantity{dim::none, {0.0, 0.1, false, false}});
    visit("solver", "max_iterations", scene.solver.max_iterations, Count{.lower = 1, .may_change = true});
    visit("time", "step", scene.time.step, Quantity{dim::time, positive, true});
    visit("time", "rms_step", scene.time.rms_step, Quantity{dim::none, {1e-6, 0.5}});
    visit("time", "accuracy", scene.time.accuracy, Quantity{dim::none, {1e-3, 0.05}});
    visit("time", "equilibration", scene.time.equilibration, Quantity{dim::time, zero_or_positive, true, true});
    visit("time", "production", scene.time.production,
          Quantity{.dimension = dim::time, .range = positive, .may_change = true});
    visit("output", "series_every", scene.output.series_every, Count{1, max_steps});
    visit("output", "trajectory_every", scene.output.trajectory_every, Count{.automatic = true, .may_change = true});
    visit("output", "trajectory_times", scene.output.trajectory_times, Plain{.may_change = true});
    visit("output", "checkpoint_every", scene.output.checkpoint_every, Count{.lower = 1, .may_change = true});
    visit("output", "contacts", scene.output.contacts, Plain{.may_change = true});
    visit("output", "stress_conventions", scene.output.stress_conventions, Plain{});
    visit("output", "stress_per_rod", scene.output.stress_per_rod, Plain{});
    visit("output", "field_every", scene.output.field_every, Count{.lower = 0, .may_change = true});
    visit("output", "field_spacing", scene.output.field_spacing, Quantity{dim::length, positive, true});
    visit("output", "active_stress_lag", scene.output.active_stress_lag, Quantity{dim::time, positive, true});
}

/// The words of a scene for each kind of choice.
constexpr auto words(UnitSystem) {
    return std::to_array<std::pair<std::string_view, UnitSystem>>(
        {{"reduced", UnitSystem::reduced}, {"micro", UnitSystem::micro}});
}
constexpr auto words(StartKind) {
    return std::to_array<std::pair<std::string_view, StartKind>>({{"random", StartKind::random},
                                                                  {"aligned", StartKind::aligned},
                                                                  {"lattice", StartKind::lattice},
                                                                  {"file", StartKind::file},
                                                                  {"run", StartKind::run}});
}
constexpr auto words(MobilityModel) {
    return std::to_array<std::pair<std::string_view, MobilityModel>>(
        {{"capsule", MobilityModel::capsule},
         {"finite_aspect_ratio", MobilityModel::finite_aspect_ratio},
         {"slender_body", MobilityModel::slender_body},
         {"hydrodynamic", MobilityModel::hydrodynamic}});
}
constexpr auto words(DivisionRule) {
    return std::to_array<std::pair<std::string_view, DivisionRule>>(
        {{"sizer", DivisionRule::sizer}, {"adder", DivisionRule::adder}, {"timer", DivisionRule::timer}});
}
constexpr auto words(DaughterDirection) {
    return std::to_array<std::pair<std::string_view, DaughterDirection>>(
        {{"same", DaughterDirection::same}, {"opposite", DaughterDirection::opposite}});
}
constexpr auto words(ContactModel) {
    return std::to_array<std::pair<std::string_view, ContactModel>>(
        {{"hard", ContactModel::hard}, {"wca", ContactModel::wca}});
}
constexpr auto words(SolverMethod) {
    return std::to_array<std::pair<std::string_view, SolverMethod>>(
        {{"auto", SolverMethod::automatic},
         {"projected_sor", SolverMethod::projected_sor},
         {"bbpgd", SolverMethod::bbpgd},
         {"adaptive_bb", SolverMethod::adaptive_bb},
         {"apgd", SolverMethod::apgd},
         {"minimum_map_newton", SolverMethod::minimum_map_newton}});
}
constexpr auto words(WarmStarts) {
    return std::to_array<std::pair<std::string_view, WarmStarts>>(
        {{"auto", WarmStarts::automatic}, {"always", WarmStarts::always}, {"never", WarmStarts::never}});
}
constexpr auto words(StepRule) {
    return std::to_array<std::pair<std::string_view, StepRule>>(
        {{"bb1", StepRule::bb1}, {"bb2", StepRule::bb2}, {"alternating", StepRule::alternating}});
}
constexpr auto words(ResidualKind) {
    return std::to_array<std::pair<std::string_view, ResidualKind>>(
        {{"length", ResidualKind::length}, {"paper", ResidualKind::paper}});
}
constexpr auto words(Container) {
    return std::to_array<std::pair<std::string_view, Container>>(
        {{"none", Container::none}, {"sphere", Container::sphere}, {"tube", Container::tube}});
}
constexpr auto words(Direction) {
    return std::to_array<std::pair<std::string_view, Direction>>(
        {{"x", Direction::x}, {"y", Direction::y}, {"z", Direction::z}});
}
constexpr auto words(StrainCoupling) {
    return std::to_array<std::pair<std::string_view, StrainCoupling>>({{"isotropic", StrainCoupling::isotropic},
                                                                       {"orthogonal", StrainCoupling::orthogonal},
                                                                       {"piston", StrainCoupling::piston}});
}
constexpr auto words(FrameTimes) {
    return std::to_array<std::pair<std::string_view, FrameTimes>>(
        {{"even", FrameTimes::even}, {"logarithmic", FrameTimes::logarithmic}});
}

/// The word for `choice` in scenes and outputs.
template <class Choice>
constexpr std::string_view word_of(Choice choice) {
    for (const auto& [word, value] : words(choice))
        if (value == choice) return word;
    return "";
}

/// Table and name of a full key; a key at the top has the table "".
inline std::pair<std::string_view, std::string_view> parts_of_key(std::string_view key) {
    const std::size_t dot = key.find('.');
    if (dot == std::string_view::npos) return {"", key};
    return {key.substr(0, dot), key.substr(dot + 1)};
}

/// "table.name", or the name alone at the top.
inline std::string full_key(std::string_view table, std::string_view name) {
    return table.empty() ? std::string(name) : std::string(table) + "." + std::string(name);
}

}  // namespace jostle
