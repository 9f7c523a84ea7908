#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/parallel/parallel_for.hpp"

using namespace jostle;

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kT = 1.3;
const Vec3 oblique = normalised(Vec3{0.4, -0.5, 0.9});

RodMobility drag_law(double length, double diameter) {
    return finite_aspect_ratio_drag(length, diameter, 0.7);
}

Rods equal_rods(std::size_t count) {
    Rods rods;
    for (std::uint64_t id = 0; id < count; ++id) rods.push_back(id, {0, 0, 0}, oblique, 4.0, 1.0);
    return rods;
}

Velocities brownian_velocities(const Rods& rods, const StepContext& context) {
    const DragMobility model(drag_law);
    Velocities known(rods.size());
    BrownianMotion(kT).add_velocities(known, rods, *model.at(rods, {}), context);
    return known;
}

Vector6 row(const Velocities& velocities, std::size_t i) {
    const Vec3 &u = velocities.linear[i], &w = velocities.angular[i];
    return Vector6{u.x, u.y, u.z, w.x, w.y, w.z};
}

Matrix6 mobility_of_oblique_rod() {
    const RodMobility own = drag_law(4.0, 1.0);
    const Eigen::Vector3d n(oblique.x, oblique.y, oblique.z);
    const Eigen::Matrix3d along = n * n.transpose(), across = Eigen::Matrix3d::Identity() - along;
    Matrix6 m = Matrix6::Zero();
    m.topLeftCorner<3, 3>() = own.parallel * along + own.perpendicular * across;
    m.bottomRightCorner<3, 3>() = own.rotational * across;
    return m;
}

}  // namespace

// 2e5 samples; 27 numbers, each allowed five of its own standard errors: false-alarm rate 27 * 5.7e-7 = 1.5e-5 per
// seed.
TEST_CASE("velocities of an oblique rod have mean 0 and covariance (2 kT/dt) M") {
    constexpr std::uint64_t seed = 11;
    MESSAGE("seed " << seed);
    const Rods rods = equal_rods(20000);
    constexpr std::size_t steps = 10;
    const double dt = 0.02, samples = static_cast<double>(steps * rods.size());
    Vector6 mean = Vector6::Zero();
    Matrix6 covariance = Matrix6::Zero();
    for (std::uint64_t step = 0; step < steps; ++step) {
        const Velocities velocities = brownian_velocities(rods, {seed, step, dt});
        for (std::size_t i = 0; i < rods.size(); ++i) {
            const Vector6 sample = row(velocities, i);
            mean += sample / samples;
            covariance += sample * sample.transpose() / samples;
        }
    }
    const Matrix6 expected = 2.0 * kT / dt * mobility_of_oblique_rod();
    for (int a = 0; a < 6; ++a) {
        CAPTURE(a);
        CHECK(std::fabs(mean(a)) < 5.0 * std::sqrt(expected(a, a) / samples));
        for (int b = 0; b <= a; ++b) {
            CAPTURE(b);
            const double variance = expected(a, a) * expected(b, b) + expected(a, b) * expected(a, b);
            CHECK(std::fabs(covariance(a, b) - expected(a, b)) < 5.0 * std::sqrt(variance / samples));
        }
    }
}

// 2e4 products of two independent normal numbers, five standard errors, three numbers: false-alarm rate 2e-6 per seed.
TEST_CASE("other rods, other steps and other seeds get independent numbers") {
    constexpr std::uint64_t seed = 12;
    MESSAGE("seed " << seed);
    const Rods rods = equal_rods(20000);
    const Velocities now = brownian_velocities(rods, {seed, 5, 1.0}), next = brownian_velocities(rods, {seed, 6, 1.0});
    const Velocities other = brownian_velocities(rods, {seed + 1, 5, 1.0});
    double between_rods = 0.0, between_steps = 0.0, between_seeds = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        between_rods += now.linear[i].x * now.linear[(i + 1) % rods.size()].x;
        between_steps += now.linear[i].x * next.linear[i].x;
        between_seeds += now.linear[i].x * other.linear[i].x;
    }
    const double variance = 2.0 * kT * mobility_of_oblique_rod()(0, 0);
    const double tolerance = 5.0 * variance * std::sqrt(static_cast<double>(rods.size()));
    CHECK(std::fabs(between_rods) < tolerance);
    CHECK(std::fabs(between_steps) < tolerance);
    CHECK(std::fabs(between_seeds) < tolerance);
}

TEST_CASE("numbers belong to the id, not to the row; the velocity is added and scales as 1/sqrt(dt)") {
    const Rods rods = equal_rods(5);
    const Velocities whole = brownian_velocities(rods, {3, 7, 0.01});
    Rods part;
    part.push_back(4, {1, 1, 1}, oblique, 4.0, 1.0);
    part.push_back(1, {2, 2, 2}, oblique, 4.0, 1.0);
    const Velocities chosen = brownian_velocities(part, {3, 7, 0.01});
    CHECK(chosen.linear[0] == whole.linear[4]);
    CHECK(chosen.angular[1] == whole.angular[1]);

    const DragMobility model(drag_law);
    Velocities known(rods.size());
    known.linear[2] = {100, 0, 0};
    known.angular[2] = {0, 100, 0};
    BrownianMotion(kT).add_velocities(known, rods, *model.at(rods, {}), {3, 7, 0.04});
    CHECK(norm(known.linear[2] - Vec3{100, 0, 0} - 0.5 * whole.linear[2]) < 1e-13);
    CHECK(norm(known.angular[2] - Vec3{0, 100, 0} - 0.5 * whole.angular[2]) < 1e-13);
}

TEST_CASE("the same bits for any number of threads") {
    const Rods rods = equal_rods(3001);
    const int threads_before = parallel::thread_count();
    parallel::set_thread_count(1);
    const Velocities one = brownian_velocities(rods, {1, 2, 0.1});
    parallel::set_thread_count(3);
    const Velocities three = brownian_velocities(rods, {1, 2, 0.1});
    parallel::set_thread_count(threads_before);
    CHECK(one.linear == three.linear);
    CHECK(one.angular == three.angular);
}

TEST_CASE("kT: zero gives no motion; negative or not finite is refused by key") {
    const Rods rods = equal_rods(2);
    const DragMobility model(drag_law);
    Velocities known(rods.size());
    BrownianMotion(0.0).add_velocities(known, rods, *model.at(rods, {}), {1, 1, 0.1});
    CHECK(known.linear[1] == Vec3{0, 0, 0});
    for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
        try {
            BrownianMotion{bad};
            FAIL_CHECK("accepted kT = " << bad);
        } catch (const InputError& error) {
            CHECK(error.parts().key == "fluid.kT");
        }
    }
}
