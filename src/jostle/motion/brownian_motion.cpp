#include "jostle/motion/brownian_motion.hpp"

#include <cassert>
#include <cmath>
#include <sstream>

#include "jostle/error/input_error.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

void draw_normals(Forces& normals, const Rods& rods, const StepContext& context) {
    normals.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        const RandomKey key{context.seed, context.step, Stream::brownian, rods.id[i]};
        const auto xi = normal6(key);
        normals.force[i] = {xi[0], xi[1], xi[2]};
        normals.torque[i] = {xi[3], xi[4], xi[5]};
    });
}

}  // namespace

BrownianMotion::BrownianMotion(double kT, const Mobility& mobility) : kT_(kT), mobility_(mobility) {
    if (std::isfinite(kT) && kT >= 0.0) return;
    std::ostringstream value;
    value << kT;
    throw InputError({.key = "fluid.kT",
                      .value = value.str(),
                      .problem = "is no thermal energy",
                      .allowed = ">= 0, finite",
                      .suggestion = {},
                      .place = {}});
}

void BrownianMotion::add_to(Velocities& known, const Rods& rods, const StepContext& context) const {
    assert(known.size() == rods.size() && context.time_step > 0.0);
    draw_normals(normals_, rods, context);
    mobility_.apply_square_root(rods, normals_, velocities_);
    const double scale = std::sqrt(2.0 * kT_ / context.time_step);
    parallel_for(rods.size(), [&](std::size_t i) {
        known.linear[i] += scale * velocities_.linear[i];
        known.angular[i] += scale * velocities_.angular[i];
    });
}

}  // namespace jostle
