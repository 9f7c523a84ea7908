#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "jostle/error/input_error.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/motion/external_forces.hpp"

using namespace jostle;

namespace {

Rods one_rod(const Vec3& axis) {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, normalised(axis), 4.0, 1.0);
    return rods;
}

std::string refused_key(const Vec3& force, double energy, const Vec3& axis) {
    try {
        ForceOnRods{force};
        AligningTorque{energy, axis};
    } catch (const InputError& error) {
        return error.parts().key;
    }
    return "";
}

double amount_in_step(const Motion& motion, double step) {
    const DragMobility model([](double length, double diameter) { return capsule_drag(length, diameter, 1.0); });
    const Rods rods = one_rod({1, 0, 0});
    const auto limits = motion.step_limits(rods, *model.at(rods, {}), 1);
    REQUIRE(limits.size() == 1);
    return limits.front().amount(step);
}

}  // namespace

TEST_CASE("an aligning torque is that of its energy, and knows no heads") {
    // U = -epsilon (n.h)^2; turned by a small angle about u, n changes by angle u x n, and U by -angle T.u
    const double energy = 1.5, angle = 1e-6;
    const Vec3 h = normalised(Vec3{0.2, -0.4, 0.9}), n = normalised(Vec3{0.8, 0.3, 0.1});
    const AligningTorque motion(energy, 7.0 * h);
    const Vec3 torque = motion.forces(one_rod(n), {})->torque[0];
    const auto energy_of = [&](const Vec3& axis) { return -energy * dot(axis, h) * dot(axis, h); };
    for (const Vec3& u : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const double difference = energy_of(normalised(n + angle * cross(u, n))) - energy_of(n - angle * cross(u, n));
        CHECK(dot(torque, u) == doctest::Approx(-0.5 * difference / angle).epsilon(1e-4));
    }
    CHECK(motion.forces(one_rod(-n), {})->torque[0] == torque);
    CHECK(norm(motion.forces(one_rod(h), {})->torque[0]) < 1e-15);
    CHECK(motion.keeps_equilibrium());
}

TEST_CASE("a force on all rods keeps equilibrium where something stops them") {
    CHECK(ForceOnRods({0, 0, -1}, false).keeps_equilibrium());
    CHECK(!ForceOnRods({0, 0, -1}, true).keeps_equilibrium());
    CHECK(ForceOnRods({0, 0, -1}).forces(one_rod({1, 0, 0}), {})->force[0] == Vec3{0, 0, -1});
}

TEST_CASE("the limits of the step are how far the force drags a rod, and what the torque takes of a small angle") {
    const RodMobility rod = capsule_drag(4.0, 1.0, 1.0);
    CHECK(amount_in_step(ForceOnRods({0, 0, -3}), 0.5) == doctest::Approx(1.5 * rod.parallel));
    CHECK(amount_in_step(AligningTorque(-2.0, {0, 0, 1}), 0.5) == doctest::Approx(2.0 * rod.rotational));
}

TEST_CASE("forces and torques that are none are refused") {
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    CHECK(refused_key({0, 0, -1}, 1.0, {0, 0, 1}) == "");
    CHECK(refused_key({0, nan, -1}, 1.0, {0, 0, 1}) == "forces.on_rods");
    CHECK(refused_key({0, 0, -1}, infinite, {0, 0, 1}) == "forces.alignment_energy");
    CHECK(refused_key({0, 0, -1}, 1.0, {0, 0, 0}) == "forces.alignment_axis");
    CHECK(refused_key({0, 0, -1}, 1.0, {nan, 0, 0}) == "forces.alignment_axis");
}
