#include "jostle/motion/brownian_motion.hpp"

#include <cassert>
#include <cmath>

#include "jostle/error/require_value.hpp"
#include "jostle/math/random.hpp"

namespace jostle {

BrownianMotion::BrownianMotion(double kT) : kT_(kT) {
    require_value(std::isfinite(kT) && kT >= 0.0, "fluid.kT", kT, "is no thermal energy", ">= 0, finite");
}

void BrownianMotion::add_velocities(Velocities& known, const Rods& /*rods*/, const MobilityOperator& mobility,
                                    const StepContext& context) const {
    assert(context.time_step > 0.0);
    const double scale = std::sqrt(2.0 * kT_ / context.time_step);
    mobility.add_square_root({context.seed, context.step, Stream::brownian, 0}, scale, known);
    mobility.add_drift(kT_, known);
}

}  // namespace jostle
