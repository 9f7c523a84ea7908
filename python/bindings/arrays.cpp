#include "bindings/arrays.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstring>

#include "jostle/error/input_error.hpp"

namespace jostle::python {

static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(Mat3) == 9 * sizeof(double));

namespace {

template <class Element>
std::span<const Element> elements(const Numbers& array) {
    return {reinterpret_cast<const Element*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

template <class Element>
py::array copied(std::span<const Element> from, std::vector<py::ssize_t> shape) {
    Numbers array(std::move(shape));
    if (!from.empty()) std::memcpy(array.mutable_data(), from.data(), from.size_bytes());
    return array;
}

py::ssize_t length(std::size_t size) {
    return static_cast<py::ssize_t>(size);
}

}  // namespace

void require_shape(const py::array& array, const std::vector<py::ssize_t>& shape, const std::string& name) {
    bool same = array.ndim() == length(shape.size());
    for (std::size_t k = 0; same && k < shape.size(); ++k)
        same = shape[k] < 0 || array.shape(static_cast<py::ssize_t>(k)) == shape[k];
    if (same) return;
    const std::vector<py::ssize_t> given(array.shape(), array.shape() + array.ndim());
    std::string wanted;
    for (const py::ssize_t extent : shape)
        wanted += (wanted.empty() ? "" : ", ") + (extent < 0 ? "n" : std::to_string(extent));
    throw InputError({.key = name,
                      .value = fmt::format("an array of shape ({})", fmt::join(given, ", ")),
                      .problem = "has the wrong shape",
                      .allowed = "(" + wanted + ")"});
}

std::span<const double> numbers_in(const Numbers& array, const std::string& name) {
    require_shape(array, {-1}, name);
    return elements<double>(array);
}

std::span<const std::int64_t> indices_in(const Indices& array, const std::string& name) {
    require_shape(array, {-1}, name);
    return {array.data(), static_cast<std::size_t>(array.shape(0))};
}

std::span<const Vec3> vectors_in(const Numbers& array, const std::string& name) {
    require_shape(array, {-1, 3}, name);
    return elements<Vec3>(array);
}

std::span<const Mat3> matrices_in(const Numbers& array, const std::string& name) {
    require_shape(array, {-1, 3, 3}, name);
    return elements<Mat3>(array);
}

py::array array_of(std::span<const double> numbers) {
    return copied(numbers, {length(numbers.size())});
}
py::array array_of(std::span<const Vec3> vectors) {
    return copied(vectors, {length(vectors.size()), 3});
}
py::array array_of(std::span<const Mat3> matrices) {
    return copied(matrices, {length(matrices.size()), 3, 3});
}
py::array array_of(const Mat3& matrix) {
    return copied(std::span<const double>(matrix.m), {3, 3});
}
py::array array_of(const Vec3& vector) {
    return copied(std::span<const Vec3>(&vector, 1), {3});
}

}  // namespace jostle::python
