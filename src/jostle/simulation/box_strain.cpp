#include "jostle/simulation/box_strain.hpp"

#include <array>
#include <cmath>

#include "jostle/math/random.hpp"

namespace jostle {

Vec3 edges_under_pressure(const State& state, const PressureControl& control, double kT, const StepContext& context) {
    Vec3 edges = state.box.edges();
    if (!state.box_force) return edges;
    const Vec3 virial = control.orthogonal ? *state.box_force : [&] {
        const double mean = (state.box_force->x + state.box_force->y + state.box_force->z) / 3.0;
        return Vec3{mean, mean, mean};
    }();
    constexpr std::array<std::uint64_t, 1> of_the_box = {0};
    std::array<Normals, 1> normal;
    fill_normals({context.seed, context.step, Stream::box, 0}, of_the_box, normal);
    const double free = (static_cast<double>(state.rods.size()) + 1.0) * kT - control.external * state.box.volume();
    const double noise = std::sqrt(2.0 * kT * control.mobility * context.time_step);
    for (int k = 0; k < 3; ++k) {
        const auto own = static_cast<std::size_t>(control.orthogonal ? k : 0);
        const double strain = control.mobility * (free + virial[k]) * context.time_step + noise * normal[0][own];
        edges[k] *= std::exp(control.orthogonal ? strain : strain / 3.0);
    }
    return edges;
}

}  // namespace jostle
