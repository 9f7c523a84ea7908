#include "bindings/python_motion.hpp"

#include "bindings/arrays.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle::python {

void PythonMotion::add_to(Velocities& known, const Rods& rods, const StepContext& context) const {
    const py::gil_scoped_acquire acquire;
    const auto velocities = ask_(context).cast<Numbers>();
    require_shape(velocities, {static_cast<py::ssize_t>(rods.size()), 6}, "velocities of a motion");
    const double* row = velocities.data();
    for (const std::uint32_t rod : id_order(rods)) {
        known.linear[rod] += {row[0], row[1], row[2]};
        known.angular[rod] += {row[3], row[4], row[5]};
        row += 6;
    }
}

}  // namespace jostle::python
