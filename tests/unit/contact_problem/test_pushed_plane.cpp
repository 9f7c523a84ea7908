// Contacts with a plane that they push: it is one more body, which all of them share.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/contact_problem/pair_colours.hpp"
#include "jostle/contact_problem/plane_contacts.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "support/assemblies.hpp"

using namespace jostle;

namespace {

constexpr std::uint32_t plane = fixed_body(5);

/// Spheres on a plane, none beside another: contact k closes its gap at speed `closing[k]`, and a sphere alone gives
/// way by `mobility[k]` a force.
struct OnPlane {
    std::vector<SpatialVector<double>> velocities;
    std::vector<MobileRod> rods;
    PlaneContacts<double> contacts;
    double velocity = 0.0;  ///< of the plane

    OnPlane(const std::vector<double>& closing, const std::vector<double>& mobility, double of_plane)
        : velocities(closing.size()), rods(closing.size()), of_plane_(of_plane) {
        for (std::uint32_t k = 0; k < closing.size(); ++k) {
            ScalarBlock<double> contact;
            contact.jacobian_j.lanes[2] = -1.0;
            contact.response_j.lanes[2] = -mobility[k];
            contact.b = -closing[k];
            contact.diagonal = mobility[k] + of_plane;
            contact.i = contact.j = contact.number = k;
            contacts.push_back(contact);
        }
        contacts.tell_ranks(Domain::whole().ranks());
    }
    double sweep(double still = 0.0) {
        return contacts.sweep(velocity, of_plane_, {.omega = 1.0, .sweep = 1.0F, .still = still},
                              {rods.data(), velocities.data()}, Domain::whole().ranks());
    }
    std::vector<double> forces() {
        std::vector<double> gamma(velocities.size());
        contacts.for_each([&](const auto& contact) { gamma[contact.number] = contact.gamma; });
        return gamma;
    }

private:
    double of_plane_;
};

/// Rods that meet each other between two planes, the upper one of which they push; some lie along it.
struct Crowd {
    Box box{{8, 8, 6}, {true, true, false}, {{false, false, true}}};
    Rods rods;
    Contacts contacts;

    explicit Crowd(std::mt19937_64& engine)
        : rods(test::thrown(40, box, 3.0, 1.0, engine)), contacts(test::contacts_of_pairs(rods, box, 0.3)) {
        for (std::uint32_t row = 0; row < rods.size(); row += 2)
            for (const double side : {-0.5, 0.5})
                contacts.push_back({row % 4 == 0 ? plane : fixed_body(4),
                                    row,
                                    {0, 0, row % 4 == 0 ? -1.0 : 1.0},
                                    0.0,
                                    side * rods.length[row],
                                    0.0,
                                    0.0},
                                   {0, 0, 0}, ContactFeature::end_of_j);
    }
};

DragMobility unit_drag() {
    return DragMobility([](double length, double) { return RodMobility{1.0, 0.8, length > 0.0 ? 0.5 : 0.0}; });
}

}  // namespace

TEST_CASE("two spheres push a plane: it goes where both forces take it, or the one that reaches it") {
    // v = m (g_1 + g_2), g_k = (speed_k - v)/mobility_k: with m = 1, speeds 2 and 3, mobilities 1 and 2 v = 1.4.
    OnPlane both({2.0, 3.0}, {1.0, 2.0}, 1.0);
    CHECK(both.sweep() == doctest::Approx(3 * 0.8));
    CHECK(both.velocity == doctest::Approx(1.4).epsilon(1e-15));
    CHECK(both.forces()[0] == doctest::Approx(0.6).epsilon(1e-15));
    CHECK(both.forces()[1] == doctest::Approx(0.8).epsilon(1e-15));
    CHECK(both.sweep() < 1e-14);
    // The slower one at 0.5: the other takes the plane away from it, v = (3 - v)/2.
    OnPlane one({0.5, 3.0}, {1.0, 2.0}, 1.0);
    one.sweep();
    CHECK(one.velocity == doctest::Approx(1.0).epsilon(1e-15));
    CHECK(one.forces() == std::vector<double>{0.0, 1.0});
}

TEST_CASE("many spheres: the plane's velocity is that of bisection, in one sweep, whatever their order") {
    std::mt19937_64 engine(5);
    std::normal_distribution<double> normal;
    constexpr std::size_t count = 500;
    constexpr double of_plane = 0.02;
    std::vector<double> closing(count), mobility(count);
    for (std::size_t k = 0; k < count; ++k) {
        closing[k] = normal(engine);
        mobility[k] = 0.5 + std::fabs(normal(engine));
    }
    const auto excess = [&](double v) {
        double forces = 0.0;
        for (std::size_t k = 0; k < count; ++k) forces += std::max(0.0, closing[k] - v) / mobility[k];
        return v - of_plane * forces;
    };
    double below = 0.0, above = 10.0;
    for (int halved = 0; halved < 100; ++halved) {
        const double middle = 0.5 * (below + above);
        (excess(middle) < 0.0 ? below : above) = middle;
    }
    OnPlane spheres(closing, mobility, of_plane);
    spheres.sweep();
    CHECK(spheres.velocity == doctest::Approx(below).epsilon(1e-13));
    CHECK(spheres.sweep() < 1e-13);
    std::reverse(closing.begin(), closing.end());
    std::reverse(mobility.begin(), mobility.end());
    OnPlane backwards(closing, mobility, of_plane);
    backwards.sweep();
    backwards.sweep();
    CHECK(backwards.velocity == spheres.velocity);
}

TEST_CASE("a contact with the plane is solved again after others have moved it, although its rod stands still") {
    OnPlane sphere({1.0}, {1.0}, 1.0);
    sphere.sweep(1e9);
    CHECK(sphere.forces()[0] == doctest::Approx(0.5));
    sphere.velocity -= 0.5;  // what contacts of another colour did is undone
    sphere.sweep(1e9);
    CHECK(sphere.forces()[0] == doctest::Approx(0.75));
}

TEST_CASE("each end of a rod at the plane has a colour of its own") {
    Rods rods;
    rods.push_back(0, {0, 0, 0}, {1, 0, 0}, 2.0, 1.0);
    Contacts contacts;
    for (const double arm : {-1.0, 1.0})
        contacts.push_back({plane, 0, {0, 0, -1}, 0.0, arm, 0.0, 0.0}, {0, 0, 0}, ContactFeature::end_of_j);
    const ContactMatrix D(contacts, rods.id);
    CHECK(PairColours{}.extend(D).size() == 1);
    CHECK(PairColours(plane).extend(D).size() == 2);
}

TEST_CASE("all solvers find the same forces and the same velocity of the plane") {
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal;
    const DragMobility model = unit_drag();
    LcpSettings settings;
    settings.tolerance = 1e-9;
    for (const double of_plane : {0.01, 0.3, 5.0}) {
        CAPTURE(of_plane);
        const Crowd crowd(engine);
        const auto mobility = model.at(crowd.rods, crowd.box);
        std::vector<double> b(crowd.contacts.size());
        for (double& value : b) value = normal(engine) - 0.5;
        const auto solved = [&](SolverMethod method) {
            ContactProblem problem(crowd.rods, *mobility, crowd.contacts, b, 1.0, 0.01, {}, Domain::whole(),
                                   {of_plane, plane});
            const auto solver = make_contact_solver(problem, method, settings);
            while (solver->run_to_next_stop()) {
            }
            CHECK(solver->outcome().status == LcpStatus::converged);
            return std::move(*solver).take_solution();
        };
        const ContactSolution by_sweeps = solved(SolverMethod::projected_sor);
        const ContactSolution by_newton = solved(SolverMethod::minimum_map_newton);
        double pushing = 0.0, largest = 0.0, difference = 0.0;
        for (std::size_t l = 0; l < b.size(); ++l) {
            if (crowd.contacts.contact[l].i == plane) pushing += by_sweeps.gamma[l];
            largest = std::max(largest, by_newton.gamma[l]);
            difference = std::max(difference, std::fabs(by_sweeps.gamma[l] - by_newton.gamma[l]));
        }
        CHECK(pushing > 0.0);
        CHECK(difference < 1e-6 * largest);
        CHECK(by_sweeps.box_rate == doctest::Approx(of_plane * pushing).epsilon(1e-12));
        CHECK(by_newton.box_rate == doctest::Approx(by_sweeps.box_rate).epsilon(1e-6));
    }
}
