#include <doctest/doctest.h>

#include <Eigen/Eigenvalues>
#include <random>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/mobility/drag.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "support/assemblies.hpp"

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
