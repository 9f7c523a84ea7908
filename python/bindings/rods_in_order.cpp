#include "bindings/rods_in_order.hpp"

#include "bindings/bindings.hpp"

namespace jostle::python {

namespace {

/// A read-only property that looks at one array of the rods; `width` 0: one number a rod, else a vector of so many.
template <class Number, class Element>
auto view(std::vector<Element> Rods::*member, py::ssize_t width) {
    return [member, width](const py::object& self) {
        const std::vector<Element>& values = self.cast<const RodsInOrder&>().rods().*member;
        std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(values.size())};
        if (width > 0) shape.push_back(width);
        return view_of(reinterpret_cast<const Number*>(values.data()), std::move(shape), self);
    };
}

}  // namespace

void bind_rods(py::module_& module) {
    py::class_<RodsInOrder, std::shared_ptr<RodsInOrder>>(module, "Rods")
        .def("__len__", [](const RodsInOrder& self) { return self.rods().size(); })
        .def_property_readonly("id", view<std::uint64_t>(&Rods::id, 0))
        .def_property_readonly("centre", view<double>(&Rods::centre, 3))
        .def_property_readonly("axis", view<double>(&Rods::axis, 3))
        .def_property_readonly("length", view<double>(&Rods::length, 0))
        .def_property_readonly("diameter", view<double>(&Rods::diameter, 0))
        .def_property_readonly("image", view<std::int32_t>(&Rods::image, 3));
}

}  // namespace jostle::python
