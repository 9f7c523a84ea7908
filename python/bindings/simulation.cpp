#include "bindings/simulation.hpp"

#include <pybind11/stl.h>

#include "bindings/bindings.hpp"
#include "bindings/python_motion.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/measurement/series_columns.hpp"
#include "jostle/measurement/side_tables.hpp"
#include "jostle/scene/validate_scene.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/scene_file/same_scene.hpp"
#include "jostle/scene_file/scene_writer.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/step_failure.hpp"
#include "jostle/simulation/contact_by_id.hpp"

namespace jostle::python {

namespace {

Beginning at_the_start(const SceneInPython& scene) {
    validate(scene.scene);
    return beginning_of(scene.scene, scene.path, [](const Annealing&) {
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    });
}

Beginning with_rods(const SceneInPython& scene, Rods rods) {
    validate(scene.scene);
    return beginning_of(scene.scene, std::move(rods));
}

Simulation assembled(const Scene& scene, Beginning beginning) {
    return assemble(scene, std::move(beginning.state));
}

}  // namespace

/// Marks that a step is under way.
class SimulationInPython::Step {
public:
    explicit Step(SimulationInPython& owner) : owner_(owner) {
        if (!owner_.functions_.empty()) owner_.rods();  // what motions see, before cells lengthen
        owner_.stepping_ = std::this_thread::get_id();
    }
    ~Step() {
        owner_.stepping_.reset();
        owner_.rods_.reset();
    }
    Step(const Step&) = delete;
    Step& operator=(const Step&) = delete;

private:
    SimulationInPython& owner_;
};

SimulationInPython::SimulationInPython(SceneInPython scene, Beginning beginning)
    : scene_(std::move(scene)),
      simulation_(assembled(scene_.scene, std::move(beginning))),
      measurement_(scene_.scene, simulation_) {}

SimulationInPython::SimulationInPython(SceneInPython scene) : SimulationInPython(scene, at_the_start(scene)) {}

SimulationInPython::SimulationInPython(SceneInPython scene, Rods rods)
    : SimulationInPython(scene, with_rods(scene, std::move(rods))) {}

SimulationInPython::SimulationInPython(SceneInPython scene, Checkpoint checkpoint)
    : scene_(std::move(scene)),
      simulation_(assemble(scene_.scene, std::move(checkpoint.state))),
      measurement_(scene_.scene, simulation_,
                   StepSums::from_named(std::move(checkpoint.sums), scene_.scene, simulation_.box())) {}

void SimulationInPython::step() {
    require_between_steps();
    if (simulation_.rods().size() == 0) throw std::runtime_error("all cells have died");
    const Step under_way(*this);
    {
        const py::gil_scoped_release release;
        const std::uint64_t before = simulation_.clock().step;
        try {
            report_ = simulation_.step();
        } catch (...) {
            broken_ = simulation_.clock().step != before;
            throw;
        }
        failure_ = step_failure(*report_, scene_.scene, simulation_.rods()).value_or("");
        if (report_->status != LcpStatus::converged) return;
        const Due due = measurement_.add(*report_, simulation_);
        for (Recording& recording : recordings_)
            if (recording.every == 0 ? due.frame : simulation_.clock().step % recording.every == 0)
                append_frame(recording);
    }
}

bool SimulationInPython::is_complete() {
    require_rest();
    return measurement_.is_complete();
}

bool SimulationInPython::run(std::uint64_t steps, bool to_the_end) {
    for (std::uint64_t k = 0; k < steps && simulation().rods().size() > 0; ++k) {
        if (to_the_end && measurement_.is_complete()) break;
        step();
        if (!failure_.empty()) return false;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
    return true;
}

void SimulationInPython::add_motion(py::function function) {
    require_between_steps();
    functions_.push_back(std::move(function));
    const std::size_t number = functions_.size() - 1;
    simulation_.add(std::make_unique<PythonMotion>(
        [this, number](const StepContext& context) { return functions_.at(number)(context.step, context.time_step); }));
}

/// Nothing may be read while another thread makes a step; within a motion the state is that before the step.
void SimulationInPython::require_rest() const {
    if (stepping_ && *stepping_ != std::this_thread::get_id())
        throw std::runtime_error("another thread makes a step of this simulation");
}

void SimulationInPython::require_between_steps() const {
    if (stepping_) throw std::runtime_error("this simulation is in the middle of a step");
    require_whole();
}

void SimulationInPython::require_whole() const {
    if (broken_)
        throw std::runtime_error("the last step of this simulation ended half way: go on from its last checkpoint");
}

const Simulation& SimulationInPython::simulation() const {
    require_rest();
    return simulation_;
}

std::shared_ptr<RodsInOrder> SimulationInPython::rods() {
    require_rest();
    if (!rods_) rods_ = std::make_shared<RodsInOrder>(simulation_.rods());
    return rods_;
}

py::array SimulationInPython::velocities(const Numbers& force, const Numbers& torque) {
    const Rods& rows = simulation().rods();
    const auto forces = vectors_in(force, "force"), torques = vectors_in(torque, "torque");
    const py::ssize_t count = static_cast<py::ssize_t>(rows.size());
    require_shape(force, {count, 3}, "force");
    require_shape(torque, {count, 3}, "torque");
    const std::vector<std::uint32_t> row_of = id_order(rows);  // within a step rows may be numbered anew
    Forces given(rows.size());
    Velocities found(rows.size());
    for (std::size_t k = 0; k < rows.size(); ++k) {
        given.force[row_of[k]] = forces[k];
        given.torque[row_of[k]] = torques[k];
    }
    simulation_.mobility().at(rows, simulation_.box())->apply(given, found);
    Numbers result({count, py::ssize_t{6}});
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::uint32_t row = row_of[k];
        for (int a = 0; a < 3; ++a) {
            result.mutable_at(static_cast<py::ssize_t>(k), a) = found.linear[row][a];
            result.mutable_at(static_cast<py::ssize_t>(k), a + 3) = found.angular[row][a];
        }
    }
    return result;
}

py::dict SimulationInPython::contacts() const {
    const bool known = simulation().contacts().size() > 0 && report_ && report_->status == LcpStatus::converged;
    const std::size_t count = known ? simulation_.contacts().size() : 0;
    const py::ssize_t rows = static_cast<py::ssize_t>(count);
    py::array_t<std::uint64_t> id({rows, py::ssize_t{2}});
    py::array_t<std::int32_t> image({rows, py::ssize_t{3}});
    py::array_t<std::int32_t> wall(rows);
    py::array_t<std::int64_t> fixed(rows);
    std::vector<double> arm_i(count), arm_j(count), gap(count), force(count);
    std::vector<Vec3> normal(count);
    const auto order = order_of_ids(simulation_.contacts(), simulation_.contact_ids());
    for (std::size_t l = 0; l < count; ++l) {
        const ContactById contact = contact_by_id(simulation_, order[l]);
        std::copy(contact.id.begin(), contact.id.end(), id.mutable_data(static_cast<py::ssize_t>(l), 0));
        std::copy(contact.image.begin(), contact.image.end(), image.mutable_data(static_cast<py::ssize_t>(l), 0));
        wall.mutable_at(static_cast<py::ssize_t>(l)) = contact.wall;
        fixed.mutable_at(static_cast<py::ssize_t>(l)) = contact.fixed;
        normal[l] = contact.normal;
        arm_i[l] = contact.arm[0];
        arm_j[l] = contact.arm[1];
        gap[l] = simulation_.contacts().contact[order[l]].gap;
        force[l] = simulation_.contact_solution().gamma[order[l]];
    }
    py::dict columns;
    columns["id"] = id;
    columns["image"] = image;
    columns["wall"] = wall;
    columns["fixed"] = fixed;
    columns["normal"] = array_of(std::span<const Vec3>(normal));
    columns["arm_i"] = array_of(std::span<const double>(arm_i));
    columns["arm_j"] = array_of(std::span<const double>(arm_j));
    columns["gap"] = array_of(std::span<const double>(gap));
    columns["force"] = array_of(std::span<const double>(force));
    return columns;
}

const std::optional<StepReport>& SimulationInPython::report() const {
    require_rest();
    return report_;
}

std::string SimulationInPython::failure() const {
    require_rest();
    return failure_;
}

py::array SimulationInPython::series() const {
    require_rest();
    const auto& columns = measurement_.series().columns;
    const std::size_t rows = measurement_.series().rows();
    Numbers table({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns.size())});
    double* place = table.mutable_data();
    for (std::size_t row = 0; row < rows; ++row)
        for (const std::vector<double>& column : columns) *place++ = column[row];
    return table;
}

py::array SimulationInPython::last_field() const {
    require_rest();
    const TableRows& rows = measurement_.last_field();
    const std::size_t columns = field_columns(scene_.scene).columns.size();
    Numbers table({static_cast<py::ssize_t>(rows.size()), static_cast<py::ssize_t>(columns)});
    double* place = table.mutable_data();
    for (const std::vector<double>& row : rows) place = std::copy(row.begin(), row.end(), place);
    return table;
}

std::string SimulationInPython::summary() const {
    require_between_steps();
    return measurement_.summary(simulation_).dump();
}

py::dict SimulationInPython::average_of(const Numbers& rows) const {
    require_between_steps();
    return entries_of(measurement_.average_of(numbers_in(rows, "rows"), simulation_));
}

std::size_t SimulationInPython::row_count() const {
    require_rest();
    return measurement_.series().rows();
}

void SimulationInPython::save(const std::string& folder) const {
    require_between_steps();  // within a motion cells have grown, and the clock has not moved
    const Checkpoint now = checkpoint_without_rods(simulation(), measurement_.sums(), to_toml(scene_.scene));
    write_checkpoint(folder, now, simulation().rods_in_order());
}

int SimulationInPython::traverse(visitproc visit, void* argument) const {
    for (const py::function& function : functions_)
        if (const int stop = visit(function.ptr(), argument)) return stop;
    return 0;
}

namespace {

std::unique_ptr<SimulationInPython> resumed(const std::string& folder) {
    auto checkpoint = latest_checkpoint(folder);
    if (!checkpoint)
        throw InputError({.key = "checkpoint",
                          .problem = "there is none to go on from",
                          .suggestion = "Give the folder of a run, or one that Simulation.save wrote",
                          .place = {folder}});
    SceneInPython scene{scene_of(*checkpoint, folder), {}};
    return std::make_unique<SimulationInPython>(std::move(scene), std::move(*checkpoint));
}

/// From arrays: centre, axis (N, 3), length, diameter (N), and speed (N) or (0).
std::unique_ptr<SimulationInPython> of_rods(const SceneInPython& scene, const Numbers& centre, const Numbers& axis,
                                            const Numbers& length, const Numbers& diameter, const Numbers& speed) {
    const auto centres = vectors_in(centre, "centre"), axes = vectors_in(axis, "axis");
    const auto lengths = numbers_in(length, "length"), diameters = numbers_in(diameter, "diameter");
    const auto speeds = numbers_in(speed, "speed");
    for (const Numbers* other : {&axis, &length, &diameter})
        if (other->shape(0) != centre.shape(0)) require_shape(*other, {centre.shape(0), -1}, "a row for each rod");
    if (!speeds.empty()) require_shape(speed, {centre.shape(0)}, "speed");
    Rods rods;
    for (std::size_t k = 0; k < centres.size(); ++k)
        rods.push_back(k, centres[k], normalised(axes[k]), lengths[k], diameters[k]);
    rods.speed.assign(speeds.begin(), speeds.end());
    return std::make_unique<SimulationInPython>(scene, std::move(rods));
}

py::object report_of(const SimulationInPython& self) {
    if (!self.report()) return py::none();
    const StepReport& report = *self.report();
    py::dict entries;
    entries["step"] = report.step;
    entries["time"] = report.time;
    entries["rods"] = report.rods;
    entries["converged"] = report.status == LcpStatus::converged;
    entries["residual"] = report.residual;
    entries["iterations"] = report.iterations;
    entries["solves"] = report.solves;
    entries["contacts"] = report.contacts;
    entries["active_contacts"] = report.active_contacts;
    entries["max_overlap"] = report.max_overlap;
    entries["collision_virial"] = array_of(report.collision_virial);
    entries["spring_virial"] = array_of(report.spring_virial);
    py::dict seconds;
    for (std::size_t k = 0; k < step_phase_count; ++k) seconds[step_phase_names[k]] = report.seconds[k];
    entries["seconds"] = seconds;
    return entries;
}

py::list lineage_of(const SimulationInPython& self) {
    py::list events;
    for (const LineageEvent& event : self.simulation().lineage())
        events.append(py::make_tuple(event.kind == LineageEvent::Kind::birth, event.id, event.mother, event.length));
    return events;
}

/// Name, unit, symbol, definition and sign of each.
std::vector<std::array<std::string, 5>> described(const std::vector<SeriesColumn>& columns) {
    std::vector<std::array<std::string, 5>> texts;
    for (const SeriesColumn& column : columns)
        texts.push_back({column.name, column.unit, column.symbol, column.definition, column.sign});
    return texts;
}

/// Lets the garbage collector see the functions that a simulation holds, which may hold the simulation.
void let_collect(PyHeapTypeObject* heap_type) {
    PyTypeObject* type = &heap_type->ht_type;
    type->tp_flags |= Py_TPFLAGS_HAVE_GC;
    type->tp_traverse = [](PyObject* self, visitproc visit, void* arg) {
        Py_VISIT(Py_TYPE(self));
        const py::handle handle(self);
        if (!py::detail::get_type_info(Py_TYPE(self)) ||
            !reinterpret_cast<py::detail::instance*>(self)->get_value_and_holder().holder_constructed())
            return 0;
        return handle.cast<const SimulationInPython&>().traverse(visit, arg);
    };
    type->tp_clear = [](PyObject* self) {
        py::handle(self).cast<SimulationInPython&>().clear();
        return 0;
    };
}

}  // namespace

void bind_simulation(py::module_& module) {
    py::class_<SimulationInPython>(module, "Simulation", py::custom_type_setup(let_collect))
        .def(py::init<SceneInPython>())
        .def_static("resume", &resumed)
        .def_static("of_rods", &of_rods)
        .def("step", &SimulationInPython::step)
        .def("run", &SimulationInPython::run)
        .def("add_motion", &SimulationInPython::add_motion)
        .def("rods", &SimulationInPython::rods)
        .def("velocities", &SimulationInPython::velocities)
        .def("contacts", &SimulationInPython::contacts)
        .def("series", &SimulationInPython::series)
        .def("columns",
             [](const SimulationInPython& self) { return described(series_columns(self.scene().scene).about()); })
        .def("row_count", &SimulationInPython::row_count)
        .def("is_complete", &SimulationInPython::is_complete)
        .def("summary", &SimulationInPython::summary)
        .def("average_of", &SimulationInPython::average_of)
        .def("last_field", &SimulationInPython::last_field)
        .def("field_columns",
             [](const SimulationInPython& self) { return described(field_columns(self.scene().scene).about()); })
        .def("save", &SimulationInPython::save)
        .def("record", &SimulationInPython::record)
        .def("frames_of", &SimulationInPython::frames_of)
        .def("end_recording", &SimulationInPython::end_recording)
        .def("report", &report_of)
        .def("failure", &SimulationInPython::failure)
        .def("lineage", &lineage_of)
        .def("scene", [](const SimulationInPython& self) { return self.scene(); })
        .def("clock",
             [](const SimulationInPython& self) {
                 const Simulation& now = self.simulation();
                 return py::make_tuple(now.clock().step, now.clock().time, now.settings().time_step);
             })
        .def("count", [](const SimulationInPython& self) { return self.simulation().rods().size(); })
        .def("kT", [](const SimulationInPython& self) { return self.simulation().settings().kT; })
        .def("box", [](const SimulationInPython& self) {
            const Box& box = self.simulation().box();
            return py::make_tuple(array_of(box.edges()), box.periodic(), box.volume(), box.offset());
        });
}

}  // namespace jostle::python
