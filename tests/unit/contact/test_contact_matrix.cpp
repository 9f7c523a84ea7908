#include <doctest/doctest.h>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/contact/find_contacts.hpp"
#include "jostle/math/rotation.hpp"
#include "support/assemblies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

struct Assembly {
    Box box;
    Rods rods;
    Contacts contacts;

    Assembly(const Vec3& edges, std::size_t count, unsigned seed) : box{edges, {true, true, true}} {
        std::mt19937_64 engine(seed);
        rods = thrown(count, box, 5.0, 1.0, engine);
        NeighbourList neighbours(0.1);
        const std::vector<double> ranges(rods.size(), 0.2);
        neighbours.update(rods, box, ranges);
        find_contacts(rods, box, neighbours, ranges, contacts);
    }
};

Velocities random_velocities(std::size_t count, std::mt19937_64& engine) {
    std::normal_distribution<double> normal;
    Velocities velocities;
    for (std::size_t k = 0; k < count; ++k) {
        velocities.linear.push_back({normal(engine), normal(engine), normal(engine)});
        velocities.angular.push_back({normal(engine), normal(engine), normal(engine)});
    }
    return velocities;
}

/// U and W = Omega x axis of the rods with contacts.
std::vector<ContactVelocity> of_local_rods(const Velocities& velocities, const ContactMatrix& D, const Rods& rods) {
    std::vector<ContactVelocity> result;
    for (const std::uint32_t row : D.rods()) result.push_back(contact_velocity(velocities, row, rods.axis[row]));
    return result;
}

}  // namespace

TEST_CASE("D^T is the gradient of the gaps: finite differences") {
    for (const auto& edges : {Vec3{8, 8, 8}, Vec3{20, 4, 3}}) {  // the thin box has rods that meet their own images
        Assembly assembly(edges, 24, 5);
        REQUIRE(assembly.contacts.size() > 20);
        std::mt19937_64 engine(17);
        const Velocities velocities = random_velocities(assembly.rods.size(), engine);
        const ContactMatrix D(assembly.contacts, assembly.rods.id);
        std::vector<double> rates(assembly.contacts.size());
        D.apply_transpose(of_local_rods(velocities, D, assembly.rods), rates);

        const double h = 1e-6;
        const auto gap_after = [&](std::size_t l, double time) {
            std::vector<Vec3> centre = assembly.rods.centre, axis = assembly.rods.axis;
            for (std::size_t k = 0; k < centre.size(); ++k) {
                centre[k] += time * velocities.linear[k];
                axis[k] = rotated(axis[k], time * velocities.angular[k]);
            }
            return gap_at(assembly.contacts, l, assembly.rods, assembly.box, centre, axis);
        };
        for (std::size_t l = 0; l < rates.size(); ++l) {
            // Deep overlaps of nearly parallel or crossing axes turn their normal quickly: central differences see that
            // at order h^2.
            if (assembly.contacts.contact[l].gap < -0.6) continue;
            const double difference = (gap_after(l, h) - gap_after(l, -h)) / (2.0 * h);
            CHECK(rates[l] == doctest::Approx(difference).epsilon(1e-5).scale(1.0));
        }
    }
}

TEST_CASE("D and D^T are transposes, also where a rod meets its own image") {
    Assembly assembly({15, 4, 3}, 16, 9);
    std::mt19937_64 engine(23);
    std::normal_distribution<double> normal;
    const ContactMatrix D(assembly.contacts, assembly.rods.id);
    bool self_contact = false;
    for (const Contact& contact : assembly.contacts.contact) self_contact |= contact.i == contact.j;
    REQUIRE(self_contact);
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<double> gamma(assembly.contacts.size()), rates(assembly.contacts.size());
        for (double& value : gamma) value = normal(engine);
        const Velocities velocities = random_velocities(assembly.rods.size(), engine);
        std::vector<ContactForce> forces(D.rods().size());
        const std::vector<ContactVelocity> moving = of_local_rods(velocities, D, assembly.rods);
        D.apply(gamma, forces);
        D.apply_transpose(moving, rates);
        double by_contacts = 0.0, by_rods = 0.0, by_torques = 0.0;
        for (std::size_t l = 0; l < gamma.size(); ++l) by_contacts += gamma[l] * rates[l];
        for (std::size_t k = 0; k < forces.size(); ++k) {
            const std::uint32_t row = D.rods()[k];
            const double centre = dot(forces[k].force, moving[k].centre);
            by_rods += centre + dot(forces[k].moment, moving[k].axis_rate);
            by_torques += centre + dot(cross(assembly.rods.axis[row], forces[k].moment), velocities.angular[row]);
        }
        CHECK(by_torques == doctest::Approx(by_rods).epsilon(1e-12));
        CHECK(by_contacts == doctest::Approx(by_rods).epsilon(1e-12));
    }
}

TEST_CASE("contact forces have no net force") {
    Assembly assembly({8, 8, 8}, 24, 13);
    const ContactMatrix D(assembly.contacts, assembly.rods.id);
    const std::vector<double> gamma(assembly.contacts.size(), 1.0);
    std::vector<ContactForce> forces(D.rods().size());
    D.apply(gamma, forces);
    Vec3 net;
    for (const ContactForce& force : forces) net += force.force;
    CHECK(norm(net) < 1e-12 * static_cast<double>(gamma.size()));
}

TEST_CASE("rods without contacts have no local index, unless all rods are asked for") {
    Rods rods;
    for (std::uint64_t k = 0; k < 5; ++k) rods.push_back(k, {3.0 * static_cast<double>(k), 0, 0}, {0, 0, 1}, 1.0, 1.0);
    Contacts contacts;
    contacts.push_back({1, 3, {1, 0, 0}, 0.1, 0.2, 0.0, 0.0}, {0, 0, 0}, ContactFeature::nearest);
    const ContactMatrix some(contacts, rods.id);
    CHECK(std::vector<std::uint32_t>(some.rods().begin(), some.rods().end()) == std::vector<std::uint32_t>{1, 3});
    CHECK(some.rod_pairs()[0].i == 0);
    CHECK(some.rod_pairs()[0].j == 1);
    const ContactMatrix all(contacts, rods.id, ContactMatrix::Include::all_rods);
    CHECK(all.rods().size() == 5);
    CHECK(all.rod_pairs()[0].j == 3);
}
