#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "jostle/run_files/trajectory_journal.hpp"

namespace jostle::python {

namespace {

template <class Number, class Element>
py::array copied(const std::vector<Element>& values, py::ssize_t width) {
    std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(values.size())};
    if (width > 0) shape.push_back(width);
    return py::array(py::dtype::of<Number>(), shape, reinterpret_cast<const Number*>(values.data()));
}

/// The next frame of a journal as (step, time, edges, periodic, offset, columns), or None at the end.
py::object next_frame(TrajectoryReader& reader) {
    TrajectoryFrame frame;
    if (!reader.next(frame)) return py::none();
    py::dict columns;
    columns["id"] = copied<std::uint64_t>(frame.id, 0);
    columns["centre"] = copied<float>(frame.centre, 3);
    columns["axis"] = copied<float>(frame.axis, 3);
    columns["image"] = copied<std::int32_t>(frame.image, 3);
    columns["length"] = copied<float>(frame.length, 0);
    columns["diameter"] = copied<float>(frame.diameter, 0);
    const auto& periodic = frame.box.periodic();
    return py::make_tuple(frame.step, frame.time, array_of(frame.box.edges()),
                          py::make_tuple(periodic[0], periodic[1], periodic[2]), frame.box.offset(), columns);
}

}  // namespace

void bind_trajectory(py::module_& module) {
    py::class_<TrajectoryReader>(module, "JournalReader").def(py::init<const std::string&>()).def("next", &next_frame);
}

}  // namespace jostle::python
