// Swimmers that never meet: how far they come, and the active stress, against sums over pairs of steps (theory, 2.6 and
// eq. 1.10) that are exact for any time step. A rod's velocity in step j is U s_j n_j, with s = 0 while it tumbles;
//     <s_j n_j . s_k n_k> = q_0 q^|k - j|,  q_0 = exp(-rate m dt) for tumbles of m steps,
//     q = <n_j . n_j+1> exp(-(tumble rate + 2 reversal rate) dt).
// In the plane a rod turns by one angle, not two, and forces have two components (theory, 9).
// Every mean is allowed five standard errors of its own sample: of 3000 rods, false-alarm rate 5.7e-7; of 20 groups of
// rods, 8e-5 (Student's t); in all 6e-4 per seed.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/start.hpp"
#include "jostle/stress/active_stress.hpp"

using namespace jostle;

namespace {

constexpr std::uint64_t seed = 404;
constexpr std::size_t rod_count = 3000, group_count = 20;
constexpr int settling = 100, steps = 1000, steps_a_look = 10;
constexpr std::uint64_t lag = 30;  // looks

/// Rates in units of D_R of Brownian rods; the length of the rods allows tumbles of 20 steps.
struct Case {
    std::string name;
    bool brownian;
    double tumble_rate, reversal_rate, deviation;
    std::uint64_t dimensions = 3;
};

struct Swimmers {
    Scene scene;
    RodMobility own = finite_aspect_ratio();
    double speed = 0.0;

    explicit Swimmers(const Case& kind) {
        const double D_R = own.rotational;  // kT = 1
        scene.seed = seed;
        scene.rods.count = rod_count;
        scene.rods.length = 2.0;
        scene.box.dimensions = kind.dimensions;
        (kind.dimensions == 2 ? scene.box.area_fraction : scene.box.volume_fraction) = 1e-9;
        leave_out_z(scene);
        const double turns = (kind.brownian ? d() - 1.0 : 0.0) + kind.tumble_rate + 2.0 * kind.reversal_rate;
        scene.time.step = 0.02 / (std::max(turns, 2.0) * D_R);  // a fiftieth of the persistence time
        speed = 10.0 * std::sqrt(own.parallel * D_R);           // swimming outweighs diffusion
        scene.motion = {kind.brownian,           speed,
                        kind.deviation * speed,  kind.tumble_rate * D_R,
                        20.0 * *scene.time.step, kind.reversal_rate * D_R};
    }

    static RodMobility finite_aspect_ratio() {
        Scene one;
        Rods rods;
        rods.push_back(0, {}, {1, 0, 0}, 2.0, 1.0);
        return make_mobility(one)->at(rods, {})->of_rod(0);
    }

    double d() const { return dimensions_of(scene); }
    double dt() const { return *scene.time.step; }
    double mean_square_speed() const {
        return speed * speed + scene.motion.self_propulsion_deviation * scene.motion.self_propulsion_deviation;
    }
    double running() const { return std::exp(-scene.motion.tumble_rate * 20.0 * dt()); }
    double decay() const {
        const double v = scene.motion.brownian ? 2.0 * own.rotational * dt() : 0.0;  // of a turn about each axis
        return (d() == 2.0 ? std::exp(-0.5 * v) : 1.0 - v + v * v / 3.0) *
               std::exp(-(scene.motion.tumble_rate + 2.0 * scene.motion.reversal_rate) * dt());
    }
    double persistence() const {
        const double D_R = scene.motion.brownian ? own.rotational : 0.0;
        return 1.0 / ((d() - 1.0) * D_R + scene.motion.tumble_rate + 2.0 * scene.motion.reversal_rate);
    }
};

struct Mean {
    double sum = 0.0, squares = 0.0, count = 0.0;
    void add(double value) {
        sum += value;
        squares += value * value;
        count += 1.0;
    }
    double value() const { return sum / count; }
    double standard_error() const { return std::sqrt((squares / count - value() * value()) / (count - 1.0)); }
};

void check_mean(const std::string& name, const Mean& mean, double expected, double largest_error) {
    MESSAGE(name, ": ", mean.value(), " +- ", mean.standard_error(), ", expected ", expected);
    CHECK(std::fabs(mean.value() - expected) < 5.0 * mean.standard_error());
    CHECK(mean.standard_error() < largest_error * expected);
}

std::vector<Vec3> unwrapped_by_id(const Simulation& simulation) {
    const Rods& rods = simulation.rods();
    std::vector<Vec3> place(rods.size());
    for (std::size_t i = 0; i < rods.size(); ++i)
        place[rods.id[i]] = rods.centre[i] + simulation.box().displacement(rods.image[i]);
    return place;
}

/// Active stress of groups of rods, each looked at alone.
struct Groups {
    std::vector<ActiveStress> stress{group_count, ActiveStress(lag)};
    std::vector<double> sum = std::vector<double>(group_count, 0.0);
    double looks = 0.0;

    void look(const Simulation& simulation, const std::vector<Vec3>& force) {
        looks += 1.0;
        const Rods& rods = simulation.rods();
        for (std::size_t g = 0; g < group_count; ++g) {
            std::vector<Vec3> of_group(force.size());
            for (std::size_t i = 0; i < force.size(); ++i)
                if (rods.id[i] % group_count == g) of_group[i] = force[i];
            const double virial = trace(stress[g].virial(rods, simulation.box(), of_group));
            if (looks >= lag) sum[g] += virial / simulation.box().dimensions();
        }
    }
    Mean mean() const {
        Mean mean;
        for (const double of_group : sum) mean.add(of_group * group_count / (looks - lag + 1.0) / rod_count);
        return mean;
    }
};

/// Mean square of the swum path after `steps`, and mean of x_k . F_k/d over the looks, per rod.
double swum_square(const Swimmers& swimmers) {
    double sum = steps;
    for (int d = 1; d < steps; ++d) sum += 2.0 * (steps - d) * std::pow(swimmers.decay(), d);
    return swimmers.mean_square_speed() * swimmers.dt() * swimmers.dt() * swimmers.running() * sum;
}
double active_stress_of_looks(const Swimmers& swimmers, double looks) {
    double sum = 0.0, count = 0.0;
    for (std::uint64_t look = lag; look <= static_cast<std::uint64_t>(looks); ++look, count += 1.0) {
        const double age = static_cast<double>((look % lag + lag) * steps_a_look), q = swimmers.decay();
        sum += swimmers.dt() * q * (1.0 - std::pow(q, age)) / (1.0 - q);
    }
    return swimmers.mean_square_speed() * swimmers.running() / (swimmers.d() * swimmers.own.parallel) * sum / count;
}

}  // namespace

TEST_CASE("without noise a rod moves U_0 t along its axis") {
    Swimmers swimmers({"", false, 0.0, 0.0, 0.0});
    swimmers.scene.rods.count = 10;
    const Box box{box_edges(swimmers.scene), box_periodic(swimmers.scene)};
    Simulation simulation = assemble(swimmers.scene, {box, make_start(swimmers.scene, box)});
    const Rods start = simulation.rods();
    for (int step = 0; step < steps; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
    const std::vector<Vec3> end = unwrapped_by_id(simulation);
    const double path = swimmers.speed * swimmers.dt() * steps;
    for (std::size_t i = 0; i < start.size(); ++i)
        CHECK(norm(end[start.id[i]] - start.centre[i] - path * start.axis[i]) < 1e-9 * path);
}

TEST_CASE("diffusion and active stress of free swimmers") {
    MESSAGE("seed " << seed);
    parallel::set_thread_count(1);  // so few rods are not worth more
    for (const Case& kind :
         {Case{"Brownian", true, 0, 0, 0}, Case{"reversals", false, 0, 5, 0}, Case{"tumbles", false, 10, 0, 0},
          Case{"all, and speeds of their own", true, 4, 2, 0.3}, Case{"Brownian, in the plane", true, 0, 0, 0, 2},
          Case{"tumbles in the plane", false, 10, 0, 0, 2},
          Case{"all, and speeds of their own, in the plane", true, 4, 2, 0.3, 2}}) {
        const Swimmers swimmers(kind);
        const Scene& scene = swimmers.scene;
        MESSAGE(kind.name);
        const Box box{box_edges(scene), box_periodic(scene)};
        Simulation simulation = assemble(scene, {box, make_start(scene, box)});
        const SelfPropulsion propulsion(swimming_of(scene));
        for (int step = 0; step < settling; ++step) REQUIRE(simulation.step().status == LcpStatus::converged);
        const std::vector<Vec3> begin = unwrapped_by_id(simulation);
        Groups groups;
        for (ActiveStress& stress : groups.stress) stress.begin(simulation.rods(), box);
        for (int step = 1; step <= steps; ++step) {
            REQUIRE(simulation.step().status == LcpStatus::converged);
            if (step % steps_a_look != 0) continue;
            const auto mobility = simulation.mobility().at(simulation.rods(), box);
            groups.look(simulation, propulsion.propulsion(simulation.rods(), *mobility,
                                                          {seed, simulation.clock().step, swimmers.dt()}));
        }
        const std::vector<Vec3> end = unwrapped_by_id(simulation);
        const double t = steps * swimmers.dt();
        Mean diffusion;
        for (std::size_t id = 0; id < rod_count; ++id)
            diffusion.add(squared_norm(end[id] - begin[id]) / (2.0 * swimmers.d() * t));
        const double thermal =
            scene.motion.brownian ? translational_diffusion(1.0, swimmers.own, dimensions_of(scene)) : 0.0;
        check_mean("diffusion", diffusion, thermal + swum_square(swimmers) / (2.0 * swimmers.d() * t), 0.03);
        check_mean("active stress", groups.mean(), active_stress_of_looks(swimmers, groups.looks), 0.03);

        // What these sums are for long times and short steps.
        const double swimming =
            swimmers.mean_square_speed() * swimmers.running() * swimmers.persistence() / swimmers.d();
        CHECK(swum_square(swimmers) / (2.0 * swimmers.d() * t) ==
              doctest::Approx(swimming * (1.0 - swimmers.persistence() / t)).epsilon(0.02));
        CHECK(active_stress_of_looks(swimmers, groups.looks) ==
              doctest::Approx(swimming / swimmers.own.parallel).epsilon(0.04));
    }
}
