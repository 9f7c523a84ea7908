#include "jostle/motion/brownian_motion.hpp"

#include <cassert>
#include <cmath>
#include <sstream>

#include "jostle/error/input_error.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

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
    normals_.resize(rods.size());
    const RandomKey key{context.seed, context.step, Stream::brownian, 0};
    parallel_for_blocks(rods.size(), parallel::sum_block, [&](std::size_t, std::size_t begin, std::size_t end) {
        fill_normals(key, {rods.id.data() + begin, end - begin}, {normals_.data() + begin, end - begin});
    });
    mobility_.add_square_root(rods, normals_, std::sqrt(2.0 * kT_ / context.time_step), known);
}

}  // namespace jostle
