#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/contact/pair_contacts.hpp"
#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/math/rotation.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "support/assemblies.hpp"
#include "support/two_rods.hpp"

using namespace jostle;

TEST_CASE("A is symmetric and positive semi-definite, and its diagonal is as told; in a roomy and in a thin box") {
    for (const Vec3& edges : {Vec3{8, 8, 8}, Vec3{16, 4, 3}}) {
        const unsigned seed = 41;
        std::mt19937_64 engine(seed);
        const Box box{edges, {true, true, true}};
        const Rods rods = test::thrown(20, box, 5.0, 1.0, engine);
        const DragMobility model(
            [](double length, double diameter) { return finite_aspect_ratio_drag(length, diameter, 1.0); });
        const auto mobility = model.at(rods, box);
        NeighbourList neighbours(0.1);
        const std::vector<double> reach(rods.size(), 0.1);
        neighbours.update(rods, box, reach);
        Contacts contacts;
        find_contacts(rods, box, neighbours, reach, contacts);
        const ContactMatrix D(contacts, rods.id);
        const DelassusOperator A(D, rods, *mobility);
        const auto count = static_cast<Eigen::Index>(A.size());
        REQUIRE(count > 20);

        Eigen::MatrixXd matrix(count, count);
        std::vector<double> unit(A.size(), 0.0), column(A.size());
        for (Eigen::Index l = 0; l < count; ++l) {
            unit[static_cast<std::size_t>(l)] = 1.0;
            A.apply(unit, column);
            unit[static_cast<std::size_t>(l)] = 0.0;
            matrix.col(l) = Eigen::Map<Eigen::VectorXd>(column.data(), count);
            CHECK(A.diagonal()[static_cast<std::size_t>(l)] ==
                  doctest::Approx(matrix(l, l)).epsilon(1e-12).scale(1e-3));
        }
        const double size = matrix.norm();
        CHECK((matrix - matrix.transpose()).norm() < 1e-13 * size);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
        CHECK(eigen.eigenvalues()(0) > -1e-12 * size);
    }
}

namespace {

/// (grad gap) M (grad gap) of two rods by differences: each rod along and across its axis, and about two axes across
/// it.
double mobility_of_gap(const Rods& rods, const MobilityOperator& mobility) {
    const double h = 1e-5;
    double sum = 0.0;
    for (std::size_t row = 0; row < rods.size(); ++row) {
        const RodMobility own = mobility.of_rod(row);
        const Vec3 axis = rods.axis[row], first = any_perpendicular(axis), second = cross(axis, first);
        const auto slope = [&](const Vec3& along, const Vec3& about) {
            Rods ahead = rods, behind = rods;
            ahead.centre[row] += h * along;
            behind.centre[row] -= h * along;
            ahead.axis[row] = rotated(axis, h * about);
            behind.axis[row] = rotated(axis, -h * about);
            return (pair_gap(test::first_pair(ahead)) - pair_gap(test::first_pair(behind))) / (2.0 * h);
        };
        const auto squared = [](double x) { return x * x; };
        sum += own.parallel * squared(slope(axis, {}));
        for (const Vec3& across : {first, second})
            sum += own.perpendicular * squared(slope(across, {})) + own.rotational * squared(slope({}, across));
    }
    return sum;
}

}  // namespace

TEST_CASE("of rods that move and turn, A is that of rods half way: with their normals, arms, and axes") {
    const Box box{{40, 40, 40}, {false, false, false}};
    const DragMobility model([](double length, double diameter) { return capsule_drag(length, diameter, 1.0); });
    struct Case {
        const char* name;
        Rods before, after;
    };
    for (const Case& test_case : {Case{"sides", test::two_rods({0.2, 0.3, 1.0}, {1, 0.1, 0}, {0.1, 1, 0}),
                                       test::two_rods({0.4, 0.1, 0.8}, {1, 0.4, 0.1}, {0.3, 1, -0.2})},
                                  Case{"end and side", test::two_rods({0.3, 2.5, 0.1}, {1, 0, 0}, {0.4, 1, 0.3}),
                                       test::two_rods({0.1, 2.3, 0.1}, {1, 0.3, 0}, {0.1, 1, 0.5})},
                                  Case{"ends", test::two_rods({3.7, 0.6, 0.3}, {1, 0, 0.1}, {1, 0.5, 0.3}),
                                       test::two_rods({3.5, 0.5, 0.2}, {1, 0.2, 0.3}, {1, 0.7, 0.1})}}) {
        CAPTURE(test_case.name);
        const Rods &before = test_case.before, &after = test_case.after;
        const PairGeometry first = test::first_pair(before), last = test::first_pair(after);
        Contacts contacts;
        append_moving_contacts({0, 1, {}}, {first, nearest_points(first), last, 0.5}, 1.0, 3, contacts);
        REQUIRE(contacts.size() == 1);

        const ArmAxes axes = {before.axis, after.axis, 0.5};
        Rods half_way = before;
        for (std::size_t row = 0; row < 2; ++row) {
            half_way.centre[row] = 0.5 * (before.centre[row] + after.centre[row]);
            half_way.axis[row] = normalised(before.axis[row] + after.axis[row]);
        }
        const auto mobility = model.at(before, box);
        const ContactMatrix D(contacts, before.id);
        const DelassusOperator A(D, before, *mobility, 0.0, {}, axes);
        CHECK(A.diagonal()[0] == doctest::Approx(mobility_of_gap(half_way, *mobility)).epsilon(1e-6));
        CHECK(std::fabs(A.diagonal()[0] / mobility_of_gap(before, *mobility) - 1.0) > 1e-3);
        const std::vector<double> one = {1.0};
        std::vector<double> rate = {0.0};
        A.apply(one, rate);
        CHECK(rate[0] == doctest::Approx(A.diagonal()[0]).epsilon(1e-12));
    }
}
