#include "jostle/motion/brownian_motion.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/math/random.hpp"

namespace jostle {

namespace {

// Root-mean-square steps, in D: docs/guide/scene.md, "Time step".
constexpr double automatic_rms_step = 0.04, advised_rms_step = 0.1;

}  // namespace

BrownianMotion::BrownianMotion(double kT, int dimensions) : kT_(kT), dimensions_(dimensions) {
    require_value(std::isfinite(kT) && kT >= 0.0, "fluid.kT", kT, "is no thermal energy", ">= 0, finite");
}

void BrownianMotion::add_velocities(Velocities& known, const Rods& /*rods*/, const MobilityOperator& mobility,
                                    const StepContext& context) const {
    assert(context.time_step > 0.0);
    const double scale = std::sqrt(2.0 * kT_ / context.time_step);
    mobility.add_square_root({context.seed, context.step, Stream::brownian, 0}, scale, known);
}

AxialStresslets BrownianMotion::stresslets(const Rods& /*rods*/, const StepContext& /*context*/) const {
    return {.kT = kT_, .dipole = {}};
}

std::vector<StepLimit> BrownianMotion::step_limits(const Rods& rods, const MobilityOperator& mobility,
                                                   std::uint64_t /*seed*/) const {
    if (rods.size() == 0) return {};
    return {{.key = "fluid.kT",
             .value = "",
             .harm = "moves rods far",
             .what = "the fastest rod diffuses, in the root mean square per axis,",
             .unit = "D",
             .remedy = "",
             .rate = 2.0 * fastest_diffusion(kT_, mobility, rods.size(), dimensions_),
             .scale = *std::min_element(rods.diameter.begin(), rods.diameter.end()),
             .diffusive = true,
             .automatic = automatic_rms_step,
             .advised = advised_rms_step}};
}

double fastest_diffusion(double kT, const MobilityOperator& mobility, std::size_t rod_count, int dimensions) {
    double fastest = 0.0;
    for (std::size_t i = 0; i < rod_count; ++i)
        fastest = std::max(fastest, translational_diffusion(kT, mobility.of_rod(i), dimensions));
    return fastest;
}

}  // namespace jostle
