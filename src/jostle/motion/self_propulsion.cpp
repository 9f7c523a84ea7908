#include "jostle/motion/self_propulsion.hpp"

#include <cassert>
#include <cmath>
#include <sstream>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

SelfPropulsion::SelfPropulsion(double speed) : speed_(speed) {
    if (std::isfinite(speed)) return;
    std::ostringstream value;
    value << speed;
    throw InputError({.key = "motion.self_propulsion",
                      .value = value.str(),
                      .problem = "is no speed",
                      .allowed = "any finite number",
                      .suggestion = {},
                      .place = {}});
}

void SelfPropulsion::add_to(Velocities& known, const Rods& rods, const StepContext& /*context*/) const {
    assert(known.size() == rods.size());
    parallel_for(rods.size(), [&](std::size_t i) { known.linear[i] += speed_ * rods.axis[i]; });
}

}  // namespace jostle
