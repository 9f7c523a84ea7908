#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "jostle/contact_problem/solver_method.hpp"
#include "jostle/growth/growth_law.hpp"
#include "jostle/math/vec3.hpp"
#include "jostle/rods/walls.hpp"
#include "jostle/scene/ramp.hpp"

namespace jostle {

enum class UnitSystem { reduced, micro };
enum class StartKind { random, aligned, lattice, file, run };
enum class MobilityModel { slender_body, finite_aspect_ratio, capsule, hydrodynamic };
enum class ContactModel { hard, wca };
enum class WarmStarts { automatic, always, never };
enum class StepRule { bb1, bb2, alternating };
enum class ResidualKind { length, paper };
enum class FrameTimes { even, logarithmic };
enum class Direction { x, y, z };
enum class StrainCoupling { isotropic, orthogonal, piston };

/// A scene: everything that the user decides. Member names are the keys of the TOML file; one struct a table.
///
/// All numbers are in the units of `units.system`. `validate` says whether the values make sense together;
/// scene_keys.hpp lists the keys with the dimension and the range of each.
struct Scene {
    std::string title;
    std::uint64_t seed = 1;

    struct Units {
        UnitSystem system = UnitSystem::reduced;  // "reduced": D = kT = 1; "micro": um, s, pN
        bool operator==(const Units&) const = default;
    } units;

    struct BoxTable {
        std::uint64_t dimensions = 3;           // 2: a monolayer in the plane z = 0; no vector has a part along z then
        std::optional<double> volume_fraction;  // either this, in two dimensions ...
        std::optional<double> area_fraction;    // ... this, with `shape` ...
        Vec3 shape{1, 1, 1};                    // ratio of the edges
        std::optional<Vec3> edges;              // ... or the edges
        std::array<bool, 3> periodic{true, true, true};
        bool operator==(const BoxTable&) const = default;
    } box;

    struct WallsTable {
        std::array<bool, 3> faces{false, false, false};  // planes at both faces of the box across x, y, z
        Container container = Container::none;           // "sphere", "tube": rods are inside, and the box bounds it
        Direction axis = Direction::x;                   // of the tube
        bool torque = true;                              // false: walls push at a rod's centre
        bool operator==(const WallsTable&) const = default;
    } walls;

    struct RodsTable {
        std::uint64_t count = 0;          // with start = "file": 0, as many as the file holds
        double length = 0.0;              // of the cylinder part; mean over rods
        double diameter = 1.0;            // mean over rods
        double length_deviation = 0.0;    // standard deviations of the rods' own lengths ...
        double diameter_deviation = 0.0;  // ... and diameters
        StartKind start = StartKind::random;
        Vec3 axis{1, 0, 0};  // direction of aligned and lattice starts
        std::string file;    // for start = "file"; relative to the scene's folder
        std::string run{};   // for start = "run": the folder of a run, relative to the scene's folder ...
        std::optional<std::uint64_t> frame{};  // ... and the number of its frame; "auto" (empty): its last state
        std::string fixed{};                   // a file of rods that do not move; relative to the scene's folder
        bool operator==(const RodsTable&) const = default;
    } rods;

    struct Fluid {
        double viscosity = 1.0;
        double kT = 1.0;
        bool operator==(const Fluid&) const = default;
    } fluid;

    struct MobilityTable {
        MobilityModel model = MobilityModel::capsule;
        double tolerance = 1e-3;       // relative error of flows in a periodic box
        std::optional<double> cutoff;  // of their sums in real space; "auto" (empty): what costs least
        bool operator==(const MobilityTable&) const = default;
    } mobility;

    struct MotionTable {
        bool brownian = true;
        double self_propulsion = 0.0;            // mean speed along the axis
        double self_propulsion_deviation = 0.0;  // of the rods' own speeds
        double tumble_rate = 0.0;
        std::optional<double> tumble_time;  // how long a tumble takes; "auto" (empty): 0.1/tumble_rate
        double reversal_rate = 0.0;
        double force_dipole = 0.0;  // of each swimmer in the fluid, an energy: > 0 pushers, < 0 pullers
        bool operator==(const MotionTable&) const = default;
    } motion;

    struct ForcesTable {
        Vec3 on_rods{};                 // on every rod, as gravity
        bool drift = false;             // also along directions in which nothing stops the rods
        double alignment_energy = 0.0;  // epsilon of -epsilon (n.h)^2
        Vec3 alignment_axis{0, 0, 1};   // h; of any length but 0
        bool operator==(const ForcesTable&) const = default;
    } forces;

    struct FlowTable {
        double shear_rate = 0.0;        // of the flow u = shear_rate y along x; either this ...
        double strain_amplitude = 0.0;  // ... or a strain amplitude sin(2 pi frequency t)
        double frequency = 0.0;         // periods in a unit of time
        double start_strain = 0.0;      // of the box when the run begins
        bool operator==(const FlowTable&) const = default;
    } flow;

    GrowthLaw growth;  // rate 0: none

    struct ScheduleTable {
        Ramp<double> self_propulsion, kT;  // from motion.self_propulsion, fluid.kT
        Ramp<Vec3> edges;                  // of the box: either this ...
        Ramp<double> volume_fraction;      // ... or this, with the shape that the box has, ...
        Ramp<double> area_fraction;        // ... or in two dimensions this
        bool operator==(const ScheduleTable&) const = default;
    } schedule;

    struct PressureTable {
        std::optional<double> external;  // of the bath; without it the volume stays
        StrainCoupling coupling = StrainCoupling::isotropic;
        std::optional<double> relaxation_time;        // "auto" (empty): `pressure_relaxation_time`
        std::optional<double> limit_volume_fraction;  // ends the run
        bool operator==(const PressureTable&) const = default;
    } pressure;

    struct SpringsTable {
        std::string file;  // relative to the scene's folder; empty: no springs
        bool operator==(const SpringsTable&) const = default;
    } springs;

    struct ContactTable {
        ContactModel model = ContactModel::hard;  // "hard": the contact problem; "wca": a soft potential
        std::optional<double> energy;             // of the potential; "auto" (empty): kT
        bool brownian_correction = true;          // reflected steps, true gap after the known motion (theory, 3)
        std::optional<double> range;  // "auto" (empty): from the step; a length: at least all pairs with a smaller gap
        double overlap_limit = 0.2;   // in D; a larger overlap at the beginning of a step ends the run (exit 3)
        bool operator==(const ContactTable&) const = default;
    } contact;

    struct Solver {
        SolverMethod method = SolverMethod::automatic;
        WarmStarts warm_start = WarmStarts::automatic;  // whether a step begins from the forces of the last one
        StepRule step_rule = StepRule::bb1;
        ResidualKind residual = ResidualKind::length;
        double tolerance = 1e-5;  // residual "length": largest remaining overlap per step, in D; "paper": its norm
        std::uint64_t max_iterations = 10000;
        bool operator==(const Solver&) const = default;
    } solver;

    struct Time {
        std::optional<double> step;           // either this; "auto" (empty): from all that moves, `time_step` ...
        std::optional<double> rms_step;       // ... or sqrt(2 D_t step), fastest rod, over D, thinnest
        std::optional<double> accuracy;       // of Z, relative: the diffusion in an automatic step follows from it
        std::optional<double> equilibration;  // "auto" (empty) or a time
        double production = 0.0;              // time averaged over
        bool operator==(const Time&) const = default;
    } time;

    struct Output {
        std::uint64_t series_every = 10;                // steps a row
        std::optional<std::uint64_t> trajectory_every;  // steps a frame; 0: none; "auto" (empty): FrameSteps
        FrameTimes trajectory_times = FrameTimes::even;
        std::uint64_t checkpoint_every = 1000;    // steps
        bool contacts = false;                    // write the active contacts of every series step
        bool stress_conventions = false;          // other conventions of the collision stress, too
        bool stress_per_rod = false;              // write the stress of every rod with every frame
        std::uint64_t field_every = 0;            // steps that a stress field is the mean of; 0: none
        std::optional<double> field_spacing;      // least edge of its cells; "auto" (empty): length + diameter of a rod
        std::optional<double> active_stress_lag;  // time; "auto" (empty): 5 persistence times of a free rod
        bool operator==(const Output&) const = default;
    } output;

    bool operator==(const Scene&) const = default;
};

/// 2 or 3.
inline int dimensions_of(const Scene& scene) {
    return scene.box.dimensions == 2 ? 2 : 3;
}

/// In two dimensions: what vectors that are left out would say of z.
inline void leave_out_z(Scene& scene) {
    if (dimensions_of(scene) == 3) return;
    scene.box.shape.z = 0.0;
    scene.box.periodic[2] = false;
    if (scene.forces.alignment_axis == Vec3{0, 0, 1}) scene.forces.alignment_axis = {1, 0, 0};
}

/// Whether the rods come from outside, and the scene tells only what they are measured by.
inline bool rods_are_given(const Scene& scene) {
    return scene.rods.start == StartKind::file || scene.rods.start == StartKind::run;
}

}  // namespace jostle
