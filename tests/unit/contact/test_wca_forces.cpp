#include <doctest/doctest.h>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/contact/wca_forces.hpp"

using namespace jostle;

namespace {

double potential(double distance, double diameter, double energy) {
    const double sixth = std::pow(diameter / distance, 6);
    return 4.0 * energy * (sixth * sixth - sixth) + energy;
}

/// Contacts of two rods L/D = 4 side by side along x, `apart` between their centre lines; the second is turned by
/// `angle` about z.
struct Pair {
    Rods rods;
    Contacts contacts;

    Pair(double apart, double angle) {
        rods.push_back(0, {5, 5, 5}, {1, 0, 0}, 4.0, 1.0);
        rods.push_back(1, {6, 5, 5 + apart}, {std::cos(angle), std::sin(angle), 0}, 4.0, 1.0);
        const Box box{{10, 10, 10}, {false, false, false}};
        const std::vector<double> ranges(2, 0.5);
        NeighbourList neighbours(0.5);
        neighbours.update(rods, box, ranges);
        find_contacts(rods, box, neighbours, ranges, contacts);
    }
};

}  // namespace

TEST_CASE("the force is the slope of the potential, and both vanish where it ends") {
    for (const double diameter : {1.0, 0.7})
        for (const double distance : {0.85, 0.95, 1.0, 1.05, 1.12}) {
            const double r = distance * diameter, h = 1e-6 * r;
            const double slope = (potential(r + h, diameter, 2.0) - potential(r - h, diameter, 2.0)) / (2.0 * h);
            CHECK(wca_force(r, diameter, 2.0) == doctest::Approx(-slope).epsilon(1e-7));
        }
    CHECK(potential(wca_range, 1.0, 1.0) == doctest::Approx(0.0));
    CHECK(wca_force(wca_range, 1.0, 1.0) == 0.0);
    CHECK(wca_force(wca_range * (1.0 - 1e-9), 1.0, 1.0) == doctest::Approx(0.0).epsilon(1e-6));
}

TEST_CASE("a pair feels its potential once, however many contacts it has") {
    for (const double angle : {0.0, 1e-5, 0.05, 0.12, 0.5, 1.5}) {
        const Pair pair(1.02, angle);
        const std::vector<double> forces = wca_forces(pair.contacts, pair.rods, 3.0);
        double sum = 0.0;
        for (const double force : forces) sum += force;
        CAPTURE(angle);
        CAPTURE(forces.size());
        CHECK(sum == doctest::Approx(wca_force(1.02, 1.0, 3.0)).epsilon(0.02));  // ends may be 5e-4 D farther away
    }
    CHECK(Pair(1.02, 0.0).contacts.size() > 1);
}
