// Contacts of rods with bodies that forces do not move:
//
//      | o o |     spheres of diameter 1 in a row between two fixed bodies, each gap closing

#include <doctest/doctest.h>

#include <Eigen/Core>

#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/contact_problem/pair_colours.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "support/assemblies.hpp"

using namespace jostle;

namespace {

constexpr double mobility_of_sphere = 2.0;

DragMobility unit_drag() {
    return DragMobility([](double length, double) {
        return RodMobility{mobility_of_sphere, mobility_of_sphere, length > 0.0 ? 0.5 : 0.0};
    });
}

void add_fixed(std::uint32_t number, std::uint32_t rod, const Vec3& normal, double arm, Contacts& contacts) {
    contacts.push_back({fixed_body(number), rod, normal, 0.0, arm, 0.0, 0.0}, {0, 0, 0}, ContactFeature::end_of_j);
}

/// `count` spheres in a row along x, touching each other and a fixed body at both ends.
struct Row {
    Rods rods;
    Contacts contacts;

    explicit Row(std::uint32_t count) {
        for (std::uint32_t k = 0; k < count; ++k) rods.push_back(k, {0.5 + k, 0, 0}, {1, 0, 0}, 0.0, 1.0);
        add_fixed(0, 0, {1, 0, 0}, 0.0, contacts);
        for (std::uint32_t k = 0; k + 1 < count; ++k)
            contacts.push_back({k, k + 1, {1, 0, 0}, 0.0, 0.0, 0.0, 0.0}, {0, 0, 0}, ContactFeature::nearest);
        add_fixed(1, count - 1, {-1, 0, 0}, 0.0, contacts);
    }
};

/// Rods that meet each other, some of which lie on, or touch, one of two fixed bodies.
struct Crowd {
    Box box{{8, 8, 8}, {true, true, true}};
    Rods rods;
    Contacts contacts;

    explicit Crowd(std::mt19937_64& engine)
        : rods(test::thrown(30, box, 4.0, 1.0, engine)), contacts(test::contacts_of_pairs(rods, box, 0.3)) {
        for (std::uint32_t row = 0; row < rods.size(); row += 3) {
            const double half = 0.5 * rods.length[row];
            const Vec3 normal = test::random_direction(engine);
            add_fixed(row % 2, row, normal, half, contacts);
            if (half > 0.0) add_fixed(row % 2, row, normal, -half, contacts);
        }
    }
};

std::size_t colours_used(const Rods& rods, const Contacts& contacts) {
    PairColours colours;
    return colours.extend(ContactMatrix(contacts, rods.id)).size();
}

}  // namespace

TEST_CASE("a row between fixed bodies: A is that of springs in a row with both ends held") {
    const Row row(3);
    const DragMobility model = unit_drag();
    const auto mobility = model.at(row.rods, {});
    const ContactMatrix D(row.contacts, row.rods.id);
    const DelassusOperator A(D, row.rods, *mobility);
    Eigen::Matrix4d matrix;
    for (Eigen::Index l = 0; l < 4; ++l) {
        std::vector<double> unit(4, 0.0), column(4);
        unit[static_cast<std::size_t>(l)] = 1.0;
        A.apply(unit, column);
        matrix.col(l) = Eigen::Map<Eigen::Vector4d>(column.data());
        CHECK(A.diagonal()[static_cast<std::size_t>(l)] == matrix(l, l));
    }
    Eigen::Matrix4d expected;
    expected << 1, -1, 0, 0, -1, 2, -1, 0, 0, -1, 2, -1, 0, 0, -1, 1;
    CHECK(matrix == mobility_of_sphere * expected);
}

TEST_CASE("every solver finds the same forces on rods between fixed bodies") {
    const unsigned seed = 5;
    CAPTURE(seed);
    std::mt19937_64 engine(seed);
    const Crowd crowd(engine);
    const DragMobility model = unit_drag();
    const auto mobility = model.at(crowd.rods, crowd.box);
    std::vector<double> b(crowd.contacts.size());
    std::uniform_real_distribution<double> closing(-1.0, 0.2);
    for (double& rate : b) rate = closing(engine);
    LcpSettings settings;
    settings.tolerance = 1e-9;
    settings.max_iterations = 100000;
    std::vector<std::vector<ContactForce>> forces;
    for (const SolverMethod method : {SolverMethod::projected_sor, SolverMethod::bbpgd, SolverMethod::adaptive_bb,
                                      SolverMethod::apgd, SolverMethod::minimum_map_newton}) {
        ContactProblem problem(crowd.rods, *mobility, crowd.contacts, b, 1.0, 0.25);
        const auto solver = make_contact_solver(problem, method, settings);
        while (solver->run_to_next_stop()) continue;
        REQUIRE(solver->outcome().status == LcpStatus::converged);
        forces.push_back(solver->solution().forces);
    }
    double largest = 0.0;
    for (const ContactForce& force : forces[0]) largest = std::max(largest, norm(force.force));
    REQUIRE(largest > 0.1);
    for (const auto& others : forces)
        for (std::size_t k = 0; k < others.size(); ++k)
            CHECK(norm(others[k].force - forces[0][k].force) < 1e-6 * largest);
}

TEST_CASE("contacts with a fixed body share a colour, unless they share a rod") {
    Rods rods;
    Contacts contacts;
    for (std::uint32_t k = 0; k < 200; ++k) {
        rods.push_back(k, {3.0 * k, 0, 0.5}, {0, 0, 1}, 0.0, 1.0);
        add_fixed(0, k, {0, 0, 1}, 0.0, contacts);
    }
    CHECK(colours_used(rods, contacts) == 1);
    add_fixed(1, 7, {0, 0, -1}, 0.0, contacts);
    CHECK(colours_used(rods, contacts) == 2);
}

TEST_CASE("contacts with fixed bodies stand after those of rods in the order of ids") {
    const Row row(3);
    CHECK(order_of_ids(row.contacts, row.rods.id) == std::vector<std::size_t>{1, 2, 0, 3});
}
