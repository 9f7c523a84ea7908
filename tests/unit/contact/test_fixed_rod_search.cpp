#include <doctest/doctest.h>

#include <memory>
#include <set>

#include "jostle/contact/find_contacts.hpp"
#include "jostle/contact/fixed_rod_search.hpp"
#include "support/assemblies.hpp"

using namespace jostle;
using namespace jostle::test;

namespace {

Box with_fixed(const Box& box, Rods fixed) {
    return box.with_fixed_rods(std::make_shared<const Rods>(std::move(fixed)));
}

}  // namespace

TEST_CASE("the grid finds what comparing all copies of all fixed rods finds, in boxes shorter than rods, too") {
    std::mt19937_64 engine(20261124);
    for (const std::array<bool, 3>& periodic :
         {std::array{true, true, true}, {true, false, true}, {false, false, false}})
        for (const double edge : {5.0, 12.0}) {
            const Box empty{{edge, 1.3 * edge, 0.8 * edge}, periodic};
            const Rods rods = thrown(40, empty, 6.0, 1.0, engine);
            Rods fixed = thrown(8, empty, 9.0, 2.0, engine);
            const Box box = with_fixed(empty, fixed);
            const double range = 0.3;
            Contacts contacts;
            const double overlap =
                append_fixed_rod_contacts(rods, box, std::vector<double>(rods.size(), range), contacts);
            std::set<PairKey> found;
            for (std::size_t l = 0; l < contacts.size(); ++l) {
                CHECK(contact_radii(contacts.contact[l], rods) == 0.5 * rods.diameter[contacts.contact[l].j]);
                found.insert(pair_of(contacts, l));
            }
            Rods all = fixed;  // rows of fixed rods, then the others
            for (std::uint32_t row = 0; row < rods.size(); ++row)
                all.push_back(all.size(), rods.centre[row], rods.axis[row], rods.length[row], rods.diameter[row]);
            std::set<PairKey> expected;
            double deepest = 0.0;
            for (const auto& [i, j, image, gap] : brute_force_pairs(all, box, range)) {
                if (i >= fixed.size() || j < fixed.size()) continue;
                expected.insert({body_of_fixed_rod(static_cast<std::uint32_t>(i)),
                                 static_cast<std::uint32_t>(j - fixed.size()), image});
                deepest = std::max(deepest, -gap);
            }
            CHECK(!expected.empty());
            CHECK(found == expected);
            CHECK(overlap == doctest::Approx(deepest));
        }
}

TEST_CASE("a rod beside a fixed one: gap, normal and arms; beyond an edge it meets the copy") {
    Rods fixed, rods;
    fixed.push_back(0, {1, 1, 1}, {0, 0, 1}, 4.0, 2.0);
    rods.push_back(0, {8.4, 1, 2}, {0, 1, 0}, 2.0,
                   1.0);  // 2.6 from the copy at -1 edges of 10 ... of which 1.5 are radii
    const Box box = with_fixed(Box{{10, 10, 10}}, fixed);
    Contacts contacts;
    append_fixed_rod_contacts(rods, box, std::vector<double>{1.2}, contacts);
    REQUIRE(contacts.size() == 1);
    const Contact& contact = contacts.contact[0];
    CHECK(is_fixed_rod(contact.i));
    CHECK(number_of_fixed_rod(contact.i) == 0);
    CHECK(contact.gap == doctest::Approx(2.6 - 1.5));
    CHECK(norm(contact.normal - Vec3{-1, 0, 0}) < 1e-12);
    CHECK(contact.arm_i == doctest::Approx(1.0));
    CHECK(contact.arm_j == doctest::Approx(0.0));
    CHECK(contacts.image[0] == Image{-1, 0, 0});
    CHECK(points_of(contact, rods).distance == doctest::Approx(1.1 + 0.5));  // from the fixed rod's surface
}

TEST_CASE("the overlap of a place with fixed rods") {
    Rods fixed;
    fixed.push_back(0, {5, 5, 5}, {1, 0, 0}, 2.0, 1.0);
    Rods rods;
    rods.push_back(0, {5, 5, 5.9}, {1, 0, 0}, 1.0, 1.0);
    const FixedRodGrid grid = grid_of_fixed_rods(with_fixed(Box{{10, 10, 10}}, fixed), rods);
    CHECK(overlap_with_fixed_rods(grid, rods, 0) == doctest::Approx(0.1));
    CHECK(overlap_with_fixed_rods(grid, {5, 5, 8}, {1, 0, 0}, 1.0, 1.0) < 0.0);
    CHECK(grid_of_fixed_rods(Box{{10, 10, 10}}, rods).empty());
}
