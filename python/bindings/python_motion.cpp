#include "bindings/python_motion.hpp"

#include <fmt/format.h>

#include <numbers>

#include "bindings/arrays.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle::python {

namespace {

/// Beyond these, pairs that a rod meets on its way could not be found, and images not be counted.
constexpr double max_lengths = 10.0;  ///< that a rod may be taken in a step, of itself with its caps
constexpr double max_turn = 2.0 * std::numbers::pi;

void require_bounded(const Vec3& velocity, double most, const char* of, const char* problem) {
    if (norm(velocity) <= most) return;  // false for nan, and for what overflows
    throw InputError({.key = of,
                      .value = fmt::format("({:.6g}, {:.6g}, {:.6g})", velocity.x, velocity.y, velocity.z),
                      .problem = problem,
                      .allowed = fmt::format("a size of at most {:.6g}", most),
                      .suggestion = "Use a smaller time.step"});
}

}  // namespace

void PythonMotion::add_velocities(Velocities& known, const Rods& rods, const MobilityOperator& /*mobility*/,
                                  const StepContext& context) const {
    const py::gil_scoped_acquire acquire;
    const auto velocities = ask_(context).cast<Numbers>();
    require_shape(velocities, {static_cast<py::ssize_t>(rods.size()), 6}, "velocities of a motion");
    const double* row = velocities.data();
    for (const std::uint32_t rod : id_order(rods)) {
        const double most = max_lengths * (rods.length[rod] + rods.diameter[rod]) / context.time_step;
        const Vec3 linear = {row[0], row[1], row[2]}, angular = {row[3], row[4], row[5]};
        require_bounded(linear, most, "velocities of a motion",
                        "take a rod by more than ten times its length in a step");
        require_bounded(angular, max_turn / context.time_step, "angular velocities of a motion",
                        "turn a rod by more than a whole turn in a step");
        known.linear[rod] += linear;
        known.angular[rod] += angular;
        row += 6;
    }
}

}  // namespace jostle::python
