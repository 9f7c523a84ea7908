#include "jostle/contact/segment_distance.hpp"

#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "jostle/contact/nearest_fractions.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle::python {

namespace {

py::tuple segment_distance_of_rows(const Numbers& p0, const Numbers& p1, const Numbers& q0, const Numbers& q1) {
    const auto start_i = vectors_in(p0, "p0"), end_i = vectors_in(p1, "p1");
    const auto start_j = vectors_in(q0, "q0"), end_j = vectors_in(q1, "q1");
    for (const Numbers* other : {&p1, &q0, &q1}) require_shape(*other, {p0.shape(0), 3}, "p0, p1, q0, q1");
    const std::size_t count = start_i.size();
    std::vector<double> distance(count), s(count), t(count);
    {
        const py::gil_scoped_release release;
        parallel_for(count, [&](std::size_t k) {
            const NearestFractions nearest = nearest_fractions(start_i[k], end_i[k], start_j[k], end_j[k]);
            distance[k] = nearest.distance;
            s[k] = nearest.s;
            t[k] = nearest.t;
        });
    }
    return py::make_tuple(array_of(std::span<const double>(distance)), array_of(std::span<const double>(s)),
                          array_of(std::span<const double>(t)));
}

}  // namespace

void bind_segment_distance(py::module_& module) {
    module.def("segment_distance", &segment_distance_of_rows);
}

}  // namespace jostle::python
