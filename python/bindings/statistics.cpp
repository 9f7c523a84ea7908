#include "bindings/arrays.hpp"
#include "bindings/bindings.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle::python {

py::dict entries_of(const Average& found) {
    py::dict entries;
    entries["mean"] = found.mean;
    entries["standard_error"] = found.standard_error ? py::object(py::float_(*found.standard_error)) : py::none();
    entries["n_eff"] = found.effective_samples;
    entries["standard_deviation"] = found.standard_deviation;
    entries["correlation_time_rows"] = found.correlation_time;
    entries["no_standard_error_because"] = found.no_error_reason;
    return entries;
}

void bind_statistics(py::module_& module) {
    module.def("average", [](const Numbers& series) { return entries_of(average(numbers_in(series, "series"))); });
}

}  // namespace jostle::python
