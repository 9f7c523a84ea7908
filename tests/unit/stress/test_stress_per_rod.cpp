// The stress of every rod, and what it is made of.

#include <doctest/doctest.h>

#include "jostle/error/input_error.hpp"
#include "jostle/stress/stress_per_rod.hpp"
#include "random_crowd.hpp"

using namespace jostle;
using namespace jostle::test;

TEST_CASE("the stresses of the rods sum to V Sigma_col, for rods of any shape and both distances") {
    std::mt19937_64 generator(21);
    MESSAGE("seed 21");
    const Crowd crowd(generator);
    for (const ContactDistance distance : {ContactDistance::touching, ContactDistance::at_start}) {
        const Mat3 total = sum_of_pair_stresses(crowd.contacts, crowd.gamma, crowd.rods, crowd.rods.axis,
                                                {crowd.rows, crowd.torque}, distance);
        const CollisionMoments moments = crowd.moments(distance);
        CHECK(norm(moments.total() - total) < 1e-13 * norm(total));
        const std::vector<Mat3> stress = stress_per_rod(moments, crowd.sorted_ids());
        REQUIRE(stress.size() == crowd.rods.size());
        CHECK(norm(sum_of(stress) - total) < 1e-13 * norm(total));
    }
}

TEST_CASE("rods that are not asked for are left out, rods without contacts have none") {
    std::mt19937_64 generator(22);
    MESSAGE("seed 22");
    const Crowd crowd(generator);
    const CollisionMoments moments = crowd.moments(ContactDistance::touching);
    const std::vector<std::uint64_t> ids = crowd.sorted_ids();
    const std::vector<Mat3> all = stress_per_rod(moments, ids);
    const std::vector<std::uint64_t> some = {ids[3], ids[3] + 1, ids[20]};
    const std::vector<Mat3> stress = stress_per_rod(moments, some);
    CHECK(stress[0].m == all[3].m);
    CHECK(norm(stress[1]) == 0.0);
    CHECK(stress[2].m == all[20].m);
    CHECK(stress_per_rod(moments, {}).empty());
}

// Two rods of L = 4, D = 1: rod 1 along z stands on the head of rod 0, which lies along x. F = 3 along z.
//
//                 | 1         r_1 - r_0 = s_0 x + (1 + 2) z = (2, 0, 3); F = (0, 0, 3) on 1
//                 |           torque on 0: (2, 0, 0) x (0, 0, -3) = (0, 6, 0); on 1: none
//      ===========            half of (r_1 - r_0) F: xz 3, zz 4.5
//           0                 s^G of 0 for T = 6 y, u = T x n = -6 z: 1/2 eps_ijk T_k + B/2 (n u + u n)
TEST_CASE("a rod that stands on another's end: values by hand, and through a periodic face") {
    Rods rods;
    rods.push_back(0, {8, 5, 9}, {1, 0, 0}, 4.0, 1.0);
    rods.push_back(1, {0, 5, 2}, {0, 0, 1}, 4.0, 1.0);
    const Box box{{10, 10, 10}, {true, true, true}};
    Contacts contacts;
    contacts.push_back({0, 1, {0, 0, 1}, 2.0, -2.0, 0.0}, {1, 0, 1}, ContactFeature::nearest);
    const std::vector<double> gamma = {3.0};
    const std::vector<std::uint32_t> rows = {0, 1}, one_row = {0};
    const std::vector<Vec3> torque = {{0, 6, 0}, {0, 0, 0}};
    const CollisionMoments moments =
        collision_moments(contacts, gamma, rods, box, rods.axis, {rows, torque}, ContactDistance::touching);
    REQUIRE(moments.pairs.size() == 1);
    CHECK(moments.bodies.size() == 1);  // nothing turns rod 1
    CHECK(norm(moments.pairs[0].separation - Vec3{2, 0, 3}) < 1e-15);
    CHECK(norm(moments.pairs[0].middle - Vec3{9, 5, 10.5}) < 1e-15);
    const double b = 4.0, B = 5 * b * (2 * b + 1) * (2 * b + 3) / (20 * b * b * b + 40 * b * b + 45 * b + 16);
    const std::vector<Mat3> stress = stress_per_rod(moments, std::vector<std::uint64_t>{0, 1});
    const Mat3 of_0 = {{0, 0, 3 - 3 - 3 * B, 0, 0, 0, 3 - 3 * B, 0, 4.5}}, of_1 = {{0, 0, 3, 0, 0, 0, 0, 0, 4.5}};
    CHECK(norm(stress[0] - of_0) < 1e-14);
    CHECK(norm(stress[1] - of_1) < 1e-14);

    const auto moments_of = [&](std::span<const double> forces, std::span<const Vec3> axis, const RodTorques& torques) {
        return collision_moments(contacts, forces, rods, box, axis, torques, ContactDistance::touching);
    };
    CHECK_THROWS_AS(moments_of({}, rods.axis, {rows, torque}), InputError);
    CHECK_THROWS_AS(moments_of(gamma, {}, {rows, torque}), InputError);
    CHECK_THROWS_AS(moments_of(gamma, rods.axis, {one_row, torque}), InputError);
}
