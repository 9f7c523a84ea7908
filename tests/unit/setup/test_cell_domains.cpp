#include <doctest/doctest.h>

#include <cmath>

#include "jostle/math/random.hpp"
#include "jostle/setup/cell_domains.hpp"

using namespace jostle;

namespace {

Rods points_in(const Box& box, std::uint64_t count) {
    Rods rods;
    for (std::uint64_t id = 0; id < count; ++id) {
        const auto u = uniform4({3, 0, Stream::test, id}, 0);
        rods.push_back(id, box.point_at({u[0], u[1], u[2]}), {1, 0, 0}, 0.0, 1.0);
    }
    return rods;
}

double nearest(double difference, double edge, bool periodic) {
    return periodic ? difference - edge * std::round(difference / edge) : difference;
}

}  // namespace

TEST_CASE("no point of a domain is within range of one in another domain of the same colour") {
    constexpr double range = 2.0;
    for (const Box& box : {Box{{13, 9, 17}, {true, true, true}}, Box{{13, 3, 8}, {true, true, true}},
                           Box{{13, 9, 17}, {true, false, true}}}) {
        const Rods rods = points_in(box, 1500);
        const CellGrid grid(rods, box, range);
        const CellDomains domains(grid, box, {5, 2, 7});
        CHECK(domains.size() > 1);
        for (std::size_t i = 0; i < rods.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                Vec3 between = rods.centre[i] - rods.centre[j];
                for (int k = 0; k < 3; ++k)
                    between[k] = nearest(between[k], box.edges()[k], box.periodic()[static_cast<std::size_t>(k)]);
                if (norm(between) > range) continue;
                const std::size_t a = domains.domain_of(rods.centre[i]), b = domains.domain_of(rods.centre[j]);
                if (a != b) REQUIRE(domains.colour()[a] != domains.colour()[b]);
            }
    }
}

TEST_CASE("points of a domain lie in it, and in all of it") {
    const Box box{{13, 9, 17}, {true, true, false}};
    const Rods rods = points_in(box, 1500);
    const CellGrid grid(rods, box, 2.0);
    const CellDomains domains(grid, box, {11, 3, 4});
    std::vector<int> met(domains.size());
    double share = 0.0;  // of the box that domains hold: the sum of the parts of random points
    for (std::size_t domain = 0; domain < domains.size(); ++domain)
        for (std::uint64_t id = 0; id < 100; ++id) {
            const auto u = uniform4({4, domain, Stream::test, id}, 0);
            const Vec3 point = domains.point_in(domain, {u[0], u[1], u[2]});
            REQUIRE(domains.domain_of(point) == domain);
            for (int k = 0; k < 3; ++k) REQUIRE((point[k] >= 0.0 && point[k] <= box.edges()[k]));
        }
    for (std::size_t i = 0; i < rods.size(); ++i) ++met[domains.domain_of(rods.centre[i])];
    for (const int count : met) share += count > 0 ? 1.0 : 0.0;
    CHECK(share == static_cast<double>(domains.size()));
}
