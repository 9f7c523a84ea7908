#pragma once

#include <thread>

#include "bindings/rods_in_order.hpp"
#include "bindings/scene.hpp"
#include "jostle/measurement/measurement.hpp"
#include "jostle/run_files/checkpoint.hpp"
#include "jostle/run_files/trajectory_journal.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/simulation/simulation.hpp"

namespace jostle::python {

/// A simulation with what is measured of it, as `jostle run` does; makes its steps without the interpreter.
///
/// Between steps it is whole, whatever ended the last one: what belongs to a step (rods, clock, sums, row) is done in
/// one go, and signals are looked at only after it. Where a step throws once rods have moved, no other is made.
class SimulationInPython {
public:
    explicit SimulationInPython(SceneInPython scene);
    SimulationInPython(SceneInPython scene, Checkpoint checkpoint);
    /// Of rods that the caller has, ids 0, 1, 2, ...; the scene has start = "run".
    SimulationInPython(SceneInPython scene, Rods rods);

    /// One step. Throws std::runtime_error where a step is under way, one has ended half way, or no rods are left. A
    /// step that fails is told by the report; where its contacts could not be resolved nothing has changed.
    void step();
    /// At most so many steps, until no rods are left or one fails, and with `to_the_end` until the series is complete;
    /// false if one failed. Throws what signal handlers raise.
    bool run(std::uint64_t steps, bool to_the_end);
    bool is_complete();

    /// `function(context)` gives (N, 6) velocities; see PythonMotion.
    void add_motion(py::function function);

    std::shared_ptr<RodsInOrder> rods();
    const Simulation& simulation() const;
    const SceneInPython& scene() const { return scene_; }
    const std::optional<StepReport>& report() const;
    std::string failure() const;  ///< of the last step; "" if it was sound
    py::array velocities(const Numbers& force, const Numbers& torque);
    py::dict contacts() const;
    py::array series() const;      ///< (rows, columns)
    py::array last_field() const;  ///< (rows, columns); (0, columns) before the first
    std::string summary() const;   ///< JSON
    py::dict average_of(const Numbers& rows) const;
    std::size_t row_count() const;
    void save(const std::string& folder) const;

    /// Writes the rods as they are to a new journal, and after every step whose number is a multiple of `every`; 0:
    /// when the scene has frames due. Result: the number of the recording. Errors: DiskError, also of later steps.
    std::size_t record(const std::string& journal, std::uint64_t every);
    std::size_t frames_of(std::size_t recording) const;
    /// Ends it; with a path, makes an H5MD file of the journal.
    void end_recording(std::size_t recording, const std::string& h5md);

    int traverse(visitproc visit, void* argument) const;
    void clear() { functions_.clear(); }

private:
    SimulationInPython(SceneInPython scene, Beginning beginning);
    class Step;
    struct Recording {
        std::optional<TrajectoryJournal> journal;  ///< empty once it has ended
        std::string path;
        std::uint64_t every;
        std::size_t frames = 0;
    };
    void append_frame(Recording& recording);
    void require_rest() const;
    void require_between_steps() const;
    void require_whole() const;

    SceneInPython scene_;
    Simulation simulation_;
    Measurement measurement_;
    std::vector<py::function> functions_;  ///< here, not in the motions, where the garbage collector can see them
    std::vector<Recording> recordings_;
    std::shared_ptr<RodsInOrder> rods_;  ///< empty until they are asked for
    std::optional<StepReport> report_;
    std::string failure_;
    bool broken_ = false;  ///< a step ended half way, as where cells become what no mobility is there for
    std::optional<std::thread::id> stepping_;  ///< the thread that makes a step; read and written with the interpreter
};

}  // namespace jostle::python
