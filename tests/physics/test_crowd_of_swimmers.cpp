// The active stress where swimmers meet. Contacts do not turn spheres, so the propulsion F of a sphere forgets its
// direction at a rate that is known, whatever the crowd does to the positions. With q the correlation of a step,
//     <x_k . F_k> = dt sum_d q^d <v . F> over d = 1 ... age,
// where v is how fast the spheres really are: not U_0, as in (theory, eq. 1.10) of free swimmers.

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "jostle/motion/self_propulsion.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/statistics/time_series.hpp"
#include "jostle/stress/active_stress.hpp"

using namespace jostle;

namespace {

constexpr int steps_a_look = 10;
constexpr std::uint64_t lag = 20, looks = 600;

/// 200 spheres that swim at U_0 = 20 D D_R, and turn round now and then.
Scene crowd() {
    Scene scene;
    scene.seed = 12;
    scene.rods.count = 200;
    scene.rods.length = 0.0;
    scene.box.volume_fraction = 0.35;
    scene.time.step = 0.002;
    const double D_R = 1.0 / std::acos(-1.0);
    scene.motion.self_propulsion = 20.0 * D_R;
    scene.motion.reversal_rate = 4.0 * D_R;
    return scene;
}

/// sum over rods of F times what the rod has moved since.
double work(const Rods& before, const Rods& after, const Box& box, const std::vector<Vec3>& force) {
    double sum = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        Vec3 moved = after.centre[i] + box.displacement(after.image[i]);
        moved -= before.centre[i] + box.displacement(before.image[i]);
        sum += dot(moved, force[i]);
    }
    return sum;
}

std::vector<Vec3> propulsion_of(const SelfPropulsion& propulsion, const Simulation& simulation,
                                const StepContext& context) {
    const auto mobility = simulation.mobility().at(simulation.rods(), simulation.box());
    return propulsion.propulsion(simulation.rods(), *mobility, context);
}

}  // namespace

// Difference of two sides that fluctuate together, five of its standard errors: false-alarm rate below 1e-5, as the
// error itself is known to a tenth.
TEST_CASE("active stress of spheres in a crowd, from paths and from velocities") {
    parallel::set_thread_count(1);
    const Scene scene = crowd();
    MESSAGE("seed " << scene.seed);
    const Box box{box_edges(scene), {true, true, true}};
    Simulation simulation = assemble(scene, {box, make_start(scene, box)});
    const RodMobility own = simulation.mobility().at(simulation.rods(), box)->of_rod(0);
    const double dt = *scene.time.step, D_R = own.rotational;
    const double variance = 2.0 * D_R * dt;
    const double q = (1.0 - variance + variance * variance / 3.0) * std::exp(-2.0 * scene.motion.reversal_rate * dt);
    const SelfPropulsion propulsion(scene.motion.self_propulsion);
    ActiveStress stress(lag);
    stress.begin(simulation.rods(), box);
    std::vector<double> from_paths, difference;
    double past = 0.0, counted = 0.0;  // v . F dt, sum over the steps since the last look
    for (std::uint64_t step = 1; step <= looks * steps_a_look; ++step) {
        const StepContext context = {scene.seed, simulation.clock().step, dt};
        const std::vector<Vec3> force = propulsion_of(propulsion, simulation, context);
        const Rods before = simulation.rods();
        REQUIRE(simulation.step().status == LcpStatus::converged);
        // Rows change places every 512 steps, at the beginning of a step: then the two do not belong together.
        if (before.id == simulation.rods().id) {
            past += work(before, simulation.rods(), box, force);
            counted += 1.0;
        }
        if (step % steps_a_look != 0) continue;
        const std::uint64_t look = step / steps_a_look;
        const std::vector<Vec3> now = propulsion_of(propulsion, simulation, context);
        const double virial = trace(stress.virial(simulation.rods(), box, now));
        const auto age = static_cast<double>((lag + look % lag) * steps_a_look);
        if (look >= 5 * lag) {
            from_paths.push_back(virial);
            difference.push_back(virial - past / counted * q * (1.0 - std::pow(q, age)) / (1.0 - q));
        }
        past = counted = 0.0;
    }
    const double free = 200.0 * scene.motion.self_propulsion * scene.motion.self_propulsion / own.parallel /
                        (2.0 * D_R + 2.0 * scene.motion.reversal_rate);
    const Average paths = average(from_paths), both = average(difference);
    REQUIRE(paths.standard_error.has_value());
    REQUIRE(both.standard_error.has_value());
    MESSAGE("active stress over that of free swimmers: ", paths.mean / free, " +- ", *paths.standard_error / free,
            ", less that from velocities: ", both.mean / free, " +- ", *both.standard_error / free);
    CHECK(std::fabs(both.mean) < 5.0 * *both.standard_error);
    CHECK(*both.standard_error < 0.02 * free);
    CHECK(paths.mean < 0.9 * free);  // the crowd holds them up
}
