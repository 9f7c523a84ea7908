#pragma once

#include <pybind11/pybind11.h>

namespace jostle {
struct Average;
}

namespace jostle::python {

/// The keywords of python/jostle/statistics.py, `Average`.
pybind11::dict entries_of(const Average& found);

// What each file adds to the extension module `_jostle`.
void bind_errors(pybind11::module_& module);
void bind_segment_distance(pybind11::module_& module);
void bind_body_moments(pybind11::module_& module);
void bind_stress(pybind11::module_& module);
void bind_lcp(pybind11::module_& module);
void bind_scene(pybind11::module_& module);
void bind_rods(pybind11::module_& module);
void bind_simulation(pybind11::module_& module);
void bind_statistics(pybind11::module_& module);
void bind_trajectory(pybind11::module_& module);

}  // namespace jostle::python
