// The stress of many rods from sums, and the numbers read off a stress.

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/stress/collision_stress.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"
#include "jostle/stress/stress.hpp"
#include "random_bodies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

Rods random_rods(std::mt19937_64& generator, std::size_t count) {
    std::uniform_real_distribution<double> length(0.0, 6.0), diameter(0.5, 1.5);
    Rods rods;
    for (std::size_t k = 0; k < count; ++k) {
        const Vec3 centre = 5.0 * random_vector(generator), axis = random_direction(generator);
        const double rod_length = k % 5 == 0 ? 0.0 : length(generator);  // every fifth is a sphere
        rods.push_back(k, centre, axis, rod_length, diameter(generator));
    }
    return rods;
}

std::vector<std::uint32_t> all_rows(const Rods& rods) {
    std::vector<std::uint32_t> rows(rods.size());
    std::iota(rows.begin(), rows.end(), 0U);
    return rows;
}

/// A contact of any two rods at random points of their segments; the normal has any direction, so the torques have,
/// too.
Contact random_contact(std::mt19937_64& generator, const Rods& rods) {
    std::uniform_int_distribution<std::uint32_t> pick(0, static_cast<std::uint32_t>(rods.size() - 2));
    std::uniform_real_distribution<double> along(-0.5, 0.5);
    const std::uint32_t i = pick(generator), j = i + 1;
    const Vec3 normal = random_direction(generator);
    const double arm_i = along(generator) * rods.length[i], arm_j = along(generator) * rods.length[j];
    return {i, j, normal, arm_i, arm_j, 0.1 * along(generator)};
}

RigidBody body_at(const Rods& rods, std::size_t i, const Vec3& centre) {
    return {centre, second_moment(spherocylinder_moments(rods.length[i], rods.diameter[i]), rods.axis[i])};
}

}  // namespace

TEST_CASE("sum over contacts of the pair stress = sum of virials + sum over rods of the geometric stress") {
    std::mt19937_64 generator(11);
    MESSAGE("seed 11");
    const Rods rods = random_rods(generator, 40);
    std::uniform_real_distribution<double> force(0.0, 2.0);
    for (const ContactDistance distance : {ContactDistance::touching, ContactDistance::at_start}) {
        Contacts contacts;
        std::vector<double> gamma;
        std::vector<Vec3> torque(rods.size());
        const std::vector<std::uint32_t> rows = all_rows(rods);
        Mat3 over_contacts;
        for (int k = 0; k < 200; ++k) {
            const Contact contact = random_contact(generator, rods);
            const auto& [i, j, normal, arm_i, arm_j, gap, room] = contact;
            contacts.push_back(contact, {0, 0, 0}, ContactFeature::nearest);
            gamma.push_back(force(generator));
            const double apart = distance == ContactDistance::touching ? 0.0 : gap;
            const Vec3 point_i = arm_i * rods.axis[i], point_j = arm_j * rods.axis[j];
            const Vec3 centre_j = point_i + (0.5 * (rods.diameter[i] + rods.diameter[j]) + apart) * normal - point_j;
            const RigidBody body_i = body_at(rods, i, {0, 0, 0}), body_j = body_at(rods, j, centre_j);
            over_contacts += pair_stress(body_i, body_j, point_i, point_j, gamma.back() * normal).total();
            torque[i] -= cross(point_i, gamma.back() * normal);
            torque[j] += cross(point_j, gamma.back() * normal);
        }
        const Mat3 over_rods = sum_of_pair_stresses(contacts, gamma, rods, rods.axis, {rows, torque}, distance);
        const Mat3 virial = centre_of_mass_virial(contacts, gamma, rods, rods.axis, distance);
        CHECK(norm(over_rods - over_contacts) < 1e-12 * norm(over_contacts));
        CHECK(relative_asymmetry(over_rods) < 1e-12);
        CHECK(trace(over_rods) == doctest::Approx(trace(virial)).epsilon(1e-12));
        CHECK(relative_asymmetry(virial) > 1e-3);  // the bare virial would not have done
        // The forces here act from centre line to centre line, so that stress is symmetric, but another one.
        const Mat3 centre_line = centre_line_virial(contacts, gamma, rods, distance);
        CHECK(relative_asymmetry(centre_line) < 1e-12);
        CHECK(norm(centre_line - over_rods) > 1e-3 * norm(over_rods));
        gamma.pop_back();
        const RodTorques torques = {rows, torque};
        CHECK_THROWS_AS(sum_of_pair_stresses(contacts, gamma, rods, rods.axis, torques, distance), InputError);
    }
}

// Two rods of length 1 touch at arms s_1, s_2 across both axes; D shrinks. The stress tends to (r_2 + x_2 - r_1 - x_1)
// F with x on the centre lines, with an error that falls as (D/L)^2.
TEST_CASE("long thin rods: the centre-line stress, error O(beta^-2)") {
    const Vec3 axis_1 = {1, 0, 0}, axis_2 = {0.6, 0.8, 0}, force = {0, 0, 1};
    const double s_1 = 0.31, s_2 = -0.42;
    double previous = 0.0;
    for (const double beta : {25.0, 50.0, 100.0, 200.0, 400.0}) {
        const double diameter = 1.0 / beta;
        const auto moments = spherocylinder_moments(1.0, diameter);
        const RigidBody body_1 = {{0, 0, 0}, second_moment(moments, axis_1)};
        const RigidBody body_2 = {s_1 * axis_1 + diameter * force - s_2 * axis_2, second_moment(moments, axis_2)};
        const auto in = [&](StressConvention convention) {
            return pair_stress(convention, body_1, body_2, s_1 * axis_1, s_2 * axis_2, force);
        };
        const double error = norm(in(StressConvention::rigid_body)-in(StressConvention::centre_line));
        CHECK(error > 0.0);
        // Halving D divides the error by 4; the next order in 1/beta shifts that by about 4/beta.
        if (previous > 0.0) CHECK(previous / error == doctest::Approx(4.0).epsilon(4.0 / beta));
        previous = error;
    }
}

TEST_CASE("the sum over rods has the same bits for any number of threads") {
    std::mt19937_64 generator(12);
    MESSAGE("seed 12");
    const Rods rods = random_rods(generator, 3000);
    std::vector<Vec3> torque(rods.size());
    const std::vector<std::uint32_t> rows = all_rows(rods);
    for (Vec3& value : torque) value = random_vector(generator);
    parallel::set_thread_count(1);
    const Mat3 one = geometric_stress(rods, rods.axis, {rows, torque});
    for (const int threads : {2, 3, 4}) {
        parallel::set_thread_count(threads);
        CHECK(geometric_stress(rods, rods.axis, {rows, torque}).m == one.m);
    }
    Mat3 plain;
    for (std::size_t i = 0; i < rods.size(); ++i)
        plain += geometric_stress_of_rod(rods.axis[i], rods.length[i], rods.diameter[i], torque[i]);
    CHECK(norm(plain - one) < 1e-12 * norm(one));
    torque.pop_back();
    CHECK_THROWS_AS(geometric_stress(rods, rods.axis, {rows, torque}), InputError);
    CHECK_THROWS_AS(geometric_stress(rods, torque, {{}, {}}), InputError);  // an axis is missing
}

TEST_CASE("eq. (1.19): n kT I + sums/V, pressure, Z") {
    const Mat3 sum = {{30, 1, 0, 1, 60, 0, 0, 0, 90}};
    const Stress stress = assembly_stress(0.5, 2.0, 10.0, {.collision = sum});
    CHECK(stress.total()(0, 0) == doctest::Approx(4.0));
    CHECK(stress.total()(0, 1) == doctest::Approx(0.1));
    CHECK(pressure_collision(stress) == doctest::Approx(6.0));
    CHECK(pressure(stress) == doctest::Approx(7.0));
    CHECK(compressibility(stress, 0.5, 2.0) == doctest::Approx(7.0));
    // Orientation stress is in the total, and has no trace; springs are in both.
    const Mat3 turning = {{-2, 3, 0, 3, 1, 0, 0, 0, 1}};
    const Stress whole =
        assembly_stress(0.5, 2.0, 10.0, {.collision = sum, .orientation = turning, .springs = -1.0 * sum});
    CHECK(whole.total()(0, 0) == doctest::Approx(0.8));
    CHECK(whole.total()(1, 0) == doctest::Approx(0.3));
    CHECK(whole.total()(2, 2) == doctest::Approx(1.1));
    CHECK(pressure(whole) == doctest::Approx(1.0));
    CHECK_THROWS_AS(compressibility(assembly_stress(0.5, 0.0, 10.0, {.collision = sum}), 0.5, 0.0), InputError);
    CHECK_THROWS_AS(assembly_stress(0.5, 2.0, 0.0, {.collision = sum}), InputError);
    CHECK_THROWS_AS(assembly_stress(-0.5, 2.0, 1.0, {.collision = sum}), InputError);
    CHECK_THROWS_AS(assembly_stress(0.5, std::nan(""), 1.0, {.collision = sum}), InputError);
}

TEST_CASE("principal stresses, anisotropy ratio and asymmetry") {
    const Mat3 symmetric = {{2, 1, 0, 1, 2, 0, 0, 0, 5}};  // eigenvalues 1, 3, 5
    const std::vector<double> principal = principal_stresses(symmetric).values;
    CHECK(principal[0] == doctest::Approx(1.0));
    CHECK(principal[1] == doctest::Approx(3.0));
    CHECK(principal[2] == doctest::Approx(5.0));
    CHECK(anisotropy_ratio(symmetric) == doctest::Approx(5.0));
    CHECK(relative_asymmetry(symmetric) == 0.0);
    Mat3 skewed = symmetric;
    skewed(0, 2) += 0.1;
    skewed(2, 0) -= 0.1;
    CHECK(anisotropy_ratio(skewed) == doctest::Approx(5.0));  // of the symmetric part
    CHECK(relative_asymmetry(skewed) == doctest::Approx(0.2 * std::sqrt(2.0) / norm(skewed)));
    CHECK(std::isnan(anisotropy_ratio(Mat3{{1, 0, 0, 0, 1, 0, 0, 0, -1}})));
    CHECK(std::isnan(anisotropy_ratio(Mat3{})));
    CHECK(relative_asymmetry(Mat3{}) == 0.0);
    const Mat3 flat = {{2, 1, 0, 1, 2, 0, 0, 0, 0}};  // of the plane: 1 and 3, whatever stands along z
    CHECK(principal_stresses(flat, 2).values.size() == 2);
    CHECK(anisotropy_ratio(flat, 2) == doctest::Approx(3.0));
    CHECK(principal_stresses(flat, 2).directions[1].z == 0.0);
}
