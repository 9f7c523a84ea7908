#include "jostle/motion/brownian_motion.hpp"

#include <array>
#include <cassert>
#include <cmath>

#include "jostle/error/require_value.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

BrownianMotion::BrownianMotion(double kT, const Mobility& mobility) : kT_(kT), mobility_(mobility) {
    require_value(std::isfinite(kT) && kT >= 0.0, "fluid.kT", kT, "is no thermal energy", ">= 0, finite");
}

void BrownianMotion::add_to(Velocities& known, const Rods& rods, const StepContext& context) const {
    assert(known.size() == rods.size() && context.time_step > 0.0);
    const RandomKey key{context.seed, context.step, Stream::brownian, 0};
    const double scale = std::sqrt(2.0 * kT_ / context.time_step);
    if (mobility_.couples_rods()) {
        std::vector<Normals> normals(rods.size());
        fill_normals(key, rods.id, normals);
        mobility_.add_square_root(rods, 0, normals, scale, known);
        return;
    }
    parallel_for_blocks(rods.size(), normals_at_a_time, [&](std::size_t, std::size_t begin, std::size_t end) {
        std::array<Normals, normals_at_a_time> normals;
        fill_normals(key, {rods.id.data() + begin, end - begin}, {normals.data(), end - begin});
        mobility_.add_square_root(rods, begin, {normals.data(), end - begin}, scale, known);
    });
}

}  // namespace jostle
