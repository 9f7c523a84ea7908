#pragma once

#include <pybind11/pybind11.h>

#include <functional>

#include "jostle/motion/motion.hpp"

namespace jostle::python {

/// A motion that is written in Python: asks a function for velocities, (N, 6) in the order of ids.
class PythonMotion final : public Motion {
public:
    /// `ask(step context)`, called with the interpreter held, gives the array; it may throw, and then the step is not
    /// made.
    using Ask = std::function<pybind11::object(const StepContext& context)>;
    explicit PythonMotion(Ask ask) : ask_(std::move(ask)) {}

    void add_velocities(Velocities& known, const Rods& rods, const MobilityOperator& mobility,
                        const StepContext& context) const override;

private:
    Ask ask_;
};

}  // namespace jostle::python
