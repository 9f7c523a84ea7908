#pragma once

#include <optional>
#include <string>
#include <vector>

#include "jostle/math/named_numbers.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/stress/active_stress.hpp"
#include "jostle/stress/stress_field.hpp"

namespace jostle {

/// What is added up over the steps of one row of the series, and over the whole run. Goes into every checkpoint.
///
/// Where the box changes, sums that a volume divides are those of each step, times the present volume over that of the
/// step: divided by the present one they are means of stresses and densities.
struct StepSums {
    // since the last row
    double steps = 0.0;
    double rods = 0.0;         ///< summed over the steps
    std::optional<double> kT;  ///< likewise, where a schedule changes it
    Mat3 collision_virial, spring_virial, centre_of_mass_virial, centre_line_virial;
    std::optional<Mat3> torque_virial;           ///< where the scene has torques
    std::array<double, max_walls> wall_force{};  ///< by the numbers of the walls
    std::optional<Vec3> fixed_rod_force;         ///< where there are fixed rods
    std::optional<double> held_back;             ///< steps in which the box was, under a bath of pressure
    double contacts = 0.0;
    double active_contacts = 0.0;
    double iterations = 0.0;
    double residual = 0.0;     ///< the largest
    double max_overlap = 0.0;  ///< the largest, a length
    // since the start of the run
    double run_max_overlap = 0.0;
    // of swimmers
    std::optional<ActiveStress> active_stress;  ///< of several ranks each has that of ids that are at home there
    Mat3 active_virial;                         ///< V times it, at the step of the row
    Mat3 dipole_virial, thermal_virial;         ///< likewise of stresslets, where swimmers stir the fluid
    // since the last field
    std::optional<StressField> field;  ///< of several ranks the first one's

    /// Adds a step that was just made.
    void add(const StepReport& report, const Simulation& simulation);
    /// Measures the active stress, where rods swim; due at every row.
    void measure_swimmers(const Scene& scene, const Simulation& simulation);
    void start_row();

    /// Leaves to each rank its share of what belongs to rods, before the simulation is shared.
    void share(const Ranks& ranks);

    /// For checkpoints; of several ranks for rank 0, and all call it together.
    NamedNumbers to_named(const Ranks& ranks = {}) const;
    /// Of a run of `scene` in `box`. A stress field that the scene asks for, and that is not among them, begins here.
    /// Errors: InputError if others are missing, or not whole.
    static StepSums from_named(NamedNumbers numbers, const Scene& scene, const Box& box);

private:
    void add(const StepReport& report);
    void add_to_field(const Simulation& simulation);
    void stretch(const StepReport& report);
};

/// A checkpoint of the sums and of the state but for its rods, which are `simulation.rods_in_order()`; of files it
/// knows nothing yet. Of several ranks it is for rank 0, and all call this together.
Checkpoint checkpoint_without_rods(const Simulation& simulation, const StepSums& sums, std::string scene);

/// Sums at the beginning of a run.
StepSums first_sums(const Scene& scene, const Simulation& simulation);

}  // namespace jostle
