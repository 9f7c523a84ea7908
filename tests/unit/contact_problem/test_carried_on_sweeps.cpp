// Sweeps that are carried on by momentum keep the velocities that belong to the forces, V = M D gamma, also where
// contacts are added between two of them, and know how far these forces are from a solution.

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "jostle/contact_problem/block_gauss_seidel.hpp"
#include "jostle/mobility/drag_mobility.hpp"
#include "support/assemblies.hpp"

using namespace jostle;

namespace {

double largest_difference(const std::vector<ContactVelocity>& a, const std::vector<ContactVelocity>& b) {
    REQUIRE(a.size() == b.size());
    double largest = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
        largest = std::max({largest, norm(a[k].centre - b[k].centre), norm(a[k].axis_rate - b[k].axis_rate)});
    return largest;
}

double largest(const std::vector<ContactVelocity>& velocities) {
    return largest_difference(velocities, std::vector<ContactVelocity>(velocities.size()));
}

Contacts part_of(const Contacts& contacts, std::size_t begin, std::size_t end) {
    Contacts part;
    for (std::size_t l = begin; l < end; ++l)
        part.push_back(contacts.contact[l], contacts.image[l], contacts.feature[l]);
    return part;
}

}  // namespace

TEST_CASE("contacts that are added between sweeps leave the momentum of the others as it is") {
    const unsigned seed = 3;
    CAPTURE(seed);
    std::mt19937_64 engine(seed);
    const Box box({12, 12, 12}, {true, true, true});
    const Rods rods = test::thrown(400, box, 3.0, 1.0, engine);
    const Contacts all = test::contacts_of_pairs(rods, box, 0.3);
    std::uniform_real_distribution<double> closing(-1.0, 1.0);  // half of them push only once others do
    std::vector<double> b(all.size());
    for (double& rate : b) rate = closing(engine);
    const DragMobility model([](double, double) { return RodMobility{1.0, 1.0, 0.5}; });
    const auto mobility = model.at(rods, box);

    const std::size_t known = all.size() - all.size() / 4;
    const auto known_end = b.begin() + static_cast<std::ptrdiff_t>(known);
    ContactProblem problem(rods, *mobility, part_of(all, 0, known), {b.begin(), known_end}, 1.0, 0.25);
    ContactSolution solution;
    problem.complete(solution);
    BlockGaussSeidel<double> sweeps(problem, 1e-9, solution.gamma);
    const auto sweep_and_check = [&](double beta) {
        sweeps.sweep_on(beta);
        sweeps.read_velocities(solution);
        const std::vector<ContactVelocity> kept = solution.velocities;
        const double violation = sweeps.violation();
        sweeps.refresh(solution);
        std::vector<double> gap_velocity(problem.size());
        problem.gap_velocities(solution, gap_velocity);
        const double residual = lcp_residual(problem.lcp(), LcpResidual::length, solution.gamma, gap_velocity);
        REQUIRE(residual > 1e-3);
        CHECK(problem.time_step() * violation == doctest::Approx(residual).epsilon(1e-9));
        REQUIRE(largest(kept) > 0.1);
        CHECK(largest_difference(kept, solution.velocities) < 1e-11 * largest(kept));
    };
    sweep_and_check(0.0);
    for (int k = 0; k < 4; ++k) sweep_and_check(0.8);
    problem.append(part_of(all, known, all.size()), {known_end, b.end()});
    solution.resize(problem.contact_matrix());
    sweeps.extend();
    for (int k = 0; k < 4; ++k) sweep_and_check(0.8);
}
