#include <doctest/doctest.h>

#include <algorithm>
#include <random>

#include "jostle/rods/space_filling_order.hpp"

using namespace jostle;

namespace {

const Box box{{10, 20, 5}, {true, true, false}};

Rods scattered(std::size_t count) {
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> uniform;
    Rods rods;
    for (std::size_t k = 0; k < count; ++k) {
        // Along the open direction some have left the box.
        const Vec3 centre{10 * uniform(engine), 20 * uniform(engine), 9 * uniform(engine) - 2};
        rods.push_back(3 * ((7 * k) % count), centre, {0, 0, 1}, static_cast<double>(k), 1.0);
        rods.image[k] = {static_cast<std::int32_t>(k), 0, -1};
    }
    return rods;
}

double mean_distance_of_rows(const Rods& rods) {
    double sum = 0.0;
    for (std::size_t k = 1; k < rods.size(); ++k) sum += norm(rods.centre[k] - rods.centre[k - 1]);
    return sum / static_cast<double>(rods.size() - 1);
}

}  // namespace

TEST_CASE("the order holds every row once, and brings neighbours together") {
    const Rods rods = scattered(1000);
    auto order = space_filling_order(rods, box);
    const Rods along = reordered(rods, order);
    CHECK(mean_distance_of_rows(along) < 0.35 * mean_distance_of_rows(rods));
    std::sort(order.begin(), order.end());
    for (std::uint32_t k = 0; k < 1000; ++k) CHECK(order[k] == k);
}

TEST_CASE("the same rods in other rows come into the same order, also where centres coincide") {
    Rods rods = scattered(200);
    for (std::size_t k = 0; k < 50; ++k) rods.centre[k] = rods.centre[0];
    const Rods by_id = reordered(rods, id_order(rods));
    const Rods a = reordered(rods, space_filling_order(rods, box));
    const Rods b = reordered(by_id, space_filling_order(by_id, box));
    CHECK(a.id == b.id);
}

TEST_CASE("id_order sorts by id, and reordering keeps each rod whole") {
    const Rods rods = scattered(100);
    const Rods by_id = reordered(rods, id_order(rods));
    CHECK(std::is_sorted(by_id.id.begin(), by_id.id.end()));
    for (std::size_t k = 0; k < 100; ++k) {
        const auto row = static_cast<std::size_t>(by_id.length[k]);  // each rod's length is its first row
        CHECK(by_id.id[k] == rods.id[row]);
        CHECK(by_id.centre[k] == rods.centre[row]);
        CHECK(by_id.axis[k] == rods.axis[row]);
        CHECK(by_id.image[k] == rods.image[row]);
        CHECK(by_id.diameter[k] == rods.diameter[row]);
    }
    CHECK(reordered(Rods{}, space_filling_order(Rods{}, box)).size() == 0);
}
