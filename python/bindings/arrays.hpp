#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "jostle/math/mat3.hpp"
#include "jostle/math/vec3.hpp"

// NumPy arrays as spans of jostle's types and back. The package's Python side has turned every argument into a
// contiguous array of the right kind (python/jostle/_arrays.py); shapes are looked at again here, where a wrong one
// would read beyond the end.

namespace jostle::python {

namespace py = pybind11;

using Numbers = py::array_t<double, py::array::c_style>;
using Indices = py::array_t<std::int64_t, py::array::c_style>;

/// Throws InputError unless the array has the shape; -1 admits any extent.
void require_shape(const py::array& array, const std::vector<py::ssize_t>& shape, const std::string& name);

std::span<const double> numbers_in(const Numbers& array, const std::string& name);        ///< (n)
std::span<const std::int64_t> indices_in(const Indices& array, const std::string& name);  ///< (n)
std::span<const Vec3> vectors_in(const Numbers& array, const std::string& name);          ///< (n, 3)
std::span<const Mat3> matrices_in(const Numbers& array, const std::string& name);         ///< (n, 3, 3)

/// A new array with these numbers.
py::array array_of(std::span<const double> numbers);  ///< (n)
py::array array_of(std::span<const Vec3> vectors);    ///< (n, 3)
py::array array_of(std::span<const Mat3> matrices);   ///< (n, 3, 3)
py::array array_of(const Mat3& matrix);               ///< (3, 3)
py::array array_of(const Vec3& vector);               ///< (3)

/// A read-only array on memory that `owner` keeps alive as long as the array lives.
template <class Number>
py::array view_of(const Number* first, std::vector<py::ssize_t> shape, py::handle owner) {
    py::array array(py::dtype::of<Number>(), std::move(shape), first, owner);
    array.attr("setflags")(py::arg("write") = false);
    return array;
}

}  // namespace jostle::python
