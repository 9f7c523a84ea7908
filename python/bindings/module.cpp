#include <pybind11/pybind11.h>

#include "bindings/bindings.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/run_files/version.hpp"

// The extension module behind the package `jostle`: C++ functions on NumPy arrays, and nothing more. Names, defaults,
// conversions and docstrings for users are in python/jostle.
PYBIND11_MODULE(_jostle, module) {
    using namespace jostle;
    module.attr("version") = program_version;
    module.def("set_thread_count", [](long long count) { parallel::set_thread_count(count); });
    module.def("thread_count", &parallel::thread_count);
    python::bind_errors(module);
    python::bind_segment_distance(module);
    python::bind_body_moments(module);
    python::bind_stress(module);
    python::bind_lcp(module);
    python::bind_scene(module);
    python::bind_rods(module);
    python::bind_simulation(module);
    python::bind_statistics(module);
    python::bind_trajectory(module);
}
