// A sweep passes over contacts whose rods no other contact has stirred since they were solved last, and over no others.

#include <doctest/doctest.h>

#include <span>
#include <vector>

#include "jostle/contact_problem/contact_blocks.hpp"

using namespace jostle;

namespace {

/// A row of spheres, each of which touches the next: gaps would close at speed 1 without forces.
struct Row {
    std::vector<SpatialVector<float>> velocities;
    std::vector<MobileRod> rods;
    std::vector<ScalarBlock<float>> contacts;
    std::vector<Visit> visits;

    explicit Row(std::uint32_t count) : velocities(count), rods(count) {
        for (std::uint32_t k = 0; k + 1 < count; ++k) {
            ScalarBlock<float> contact;
            contact.jacobian_i.lanes[0] = contact.response_i.lanes[0] = -1.0F;
            contact.jacobian_j.lanes[0] = contact.response_j.lanes[0] = 1.0F;
            contact.b = -1.0F;
            contact.diagonal = 2.0F;
            contact.inverse_diagonal = 0.5F;
            contact.i = k;
            contact.j = k + 1;
            contact.number = k;
            contacts.push_back(contact);
            visits.push_back({k, k + 1});
        }
    }
    double sweep(float number, double still, std::size_t begin = 0, std::size_t count = std::dynamic_extent) {
        return sweep_over(std::span(contacts).subspan(begin, count), std::span(visits).subspan(begin),
                          {.omega = 1.0, .sweep = number, .still = still}, {rods.data(), velocities.data()});
    }
};

}  // namespace

TEST_CASE("a contact that is solved is passed over until one of its rods is stirred") {
    Row row(3);
    CHECK(row.sweep(1.0F, 1e-3, 0, 1) == doctest::Approx(1.0));
    CHECK(row.visits[0].solved == 1.0F);
    CHECK(row.velocities[0].stirred() == 1.0F);
    CHECK(row.sweep(2.0F, 1e-3, 0, 1) <= 1e-6);  // its own change was large: it is solved once more
    CHECK(row.visits[0].solved == 2.0F);
    row.velocities[1].lanes[0] -= 0.5F;  // nobody has said so
    CHECK(row.sweep(3.0F, 1e-3, 0, 1) == 0.0);
    CHECK(row.visits[0].solved == 2.0F);
    row.velocities[1].stir(3.0F);
    CHECK(row.sweep(4.0F, 1e-3, 0, 1) == doctest::Approx(0.5));
}

TEST_CASE("contacts pass on what stirs them, in both directions, also within a sweep") {
    Row row(3);
    row.sweep(1.0F, 1e-3);
    CHECK(row.visits[0].solved == 1.0F);
    row.sweep(2.0F, 1e-3);  // the first one feels what the second did in the sweep before
    CHECK(row.contacts[0].gamma > 0.6F);
    Row backwards(3);
    for (float k = 1.0F; k < 40.0F; ++k) backwards.sweep(k, 1e-6);
    CHECK(backwards.contacts[0].gamma == doctest::Approx(1.0));  // 2 g - g' = 1 of both
    CHECK(backwards.contacts[1].gamma == doctest::Approx(1.0));
    CHECK(backwards.visits[0].solved < 39.0F);
    CHECK(backwards.sweep(40.0F, 1e-6) == 0.0);
}

TEST_CASE("forces of a long row are exact where no change is small enough to be kept to itself") {
    Row row(40);
    float number = 1.0F;
    while (number < 20000.0F && row.sweep(number, 0.0) > 0.0) ++number;
    CHECK(number < 20000.0F);
    for (const auto& contact : row.contacts) {  // -g'' = 1, with g = 0 beyond both ends
        const double place = static_cast<double>(contact.number + 1);
        CHECK(static_cast<double>(contact.gamma) == doctest::Approx(0.5 * place * (40.0 - place)).epsilon(2e-4));
    }
}
