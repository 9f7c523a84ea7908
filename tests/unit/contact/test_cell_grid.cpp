#include <doctest/doctest.h>

#include <limits>

#include "jostle/contact/cell_grid.hpp"

using namespace jostle;

TEST_CASE("a range beyond all whole numbers of cells reaches as far as can be counted, not to nothing") {
    Rods rods;
    for (int k = 0; k < 20; ++k) rods.push_back(static_cast<std::uint64_t>(k), {0.2 * k, 1, 2}, {1, 0, 0}, 2.0, 1.0);
    const Box box{{4, 4, 4}, {true, true, true}};
    std::int32_t last = 0;
    for (const double range : {1.0, 1e3, 1e9, 1e12, 1e30, std::numeric_limits<double>::infinity()}) {
        const std::int32_t farthest = CellGrid(rods, box, range).farthest_image()[0];
        CHECK(farthest >= last);
        last = farthest;
    }
    CHECK(last > 1'000'000);
}
