#include "jostle/setup/scattered_rods.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "jostle/contact/cell_list.hpp"
#include "jostle/contact/fixed_rod_search.hpp"
#include "jostle/contact/pair_contacts.hpp"
#include "jostle/math/random.hpp"
#include "jostle/math/random_direction.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/rods/wall.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/setup/movable_cells.hpp"

namespace jostle {

namespace {

/// Draws of a rod's place before what still overlaps is left to others; many more where it is but a few.
constexpr std::uint32_t max_draws = 100, max_draws_of_few = 1000;
constexpr double few = 0.01;

using Rows = std::vector<std::uint32_t>;

/// Rows in the order of the cells that the rods are in.
void sort_by_cell(Rows& rows, const Rods& rods, const CellGrid& grid) {
    std::vector<std::uint64_t> keys(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) { keys[k] = grid.cell_of(rods.centre[rows[k]]) << 32 | rows[k]; });
    std::sort(keys.begin(), keys.end());
    parallel_for(rows.size(), [&](std::size_t k) { rows[k] = static_cast<std::uint32_t>(keys[k]); });
}

/// Of the rods just drawn, those that overlap a wall, a fixed rod, their own image, one that stays, or one just drawn
/// with a lower id. Each rank looks at a part of those drawn.
Rows rows_to_draw_again(const Rods& rods, const Box& box, const MovableCells& cells, const Rows& drawn,
                        const Ranks& ranks) {
    const auto part_before = [&](int rank) {
        return drawn.size() * static_cast<std::size_t>(rank) / static_cast<std::size_t>(ranks.count());
    };
    const std::size_t begin = part_before(ranks.rank()), end = part_before(ranks.rank() + 1);
    const std::vector<Wall> walls = walls_of(box);
    const FixedRodGrid fixed = grid_of_fixed_rods(box, rods);
    std::vector<std::uint8_t> stays(rods.size(), 1), again(end - begin);
    for (const std::uint32_t row : drawn) stays[row] = 0;
    parallel_for(again.size(), [&](std::size_t k) {
        const std::uint32_t row = drawn[begin + k];
        again[k] = overlap_with_walls(walls, box.walls(), rods, row) > 0.0 ||
                   overlap_with_fixed_rods(fixed, rods, row) > 0.0 ||
                   cells.any_near(rods.centre[row], [&](std::uint32_t other, const Vec3& displacement) {
                       if (other == row && squared_norm(displacement) == 0.0) return false;
                       const bool gives_way = !stays[other] && rods.id[other] > rods.id[row];
                       return !gives_way &&
                              pair_overlaps(pair_geometry(rods, row, other, displacement, rods.centre, rods.axis));
                   });
    });
    Rows rows;
    for (std::size_t k = 0; k < again.size(); ++k)
        if (again[k]) rows.push_back(drawn[begin + k]);
    return ranks.gather_at_all(std::move(rows));
}

/// Puts the rods in the order of cells, so that those near each other come near each other in memory; `rows` follow.
void renumber(Rods& rods, const Box& box, double range, Rows& rows) {
    const CellList cells(rods, box, range);
    const Rows order(cells.rods().begin(), cells.rods().end()), place = new_rows(order);
    rods = reordered(rods, order);
    parallel_for(rows.size(), [&](std::size_t k) { rows[k] = place[rows[k]]; });
}

}  // namespace

Rods scattered_rods(const Scene& scene, const Box& box, const std::optional<Vec3>& common_axis, const Ranks& ranks) {
    Rods rods;
    for (const RodSize& size : rod_sizes(scene))
        rods.push_back(rods.size(), {}, common_axis.value_or(Vec3{}), size.length, size.diameter);
    const auto draw_places = [&](const Rows& rows, std::uint32_t draw) {
        parallel_for(rows.size(), [&](std::size_t k) {
            const std::uint32_t i = rows[k];
            const RandomKey key{scene.seed, 0, Stream::start, rods.id[i]};
            const auto u = uniform4(key, 2 * draw);
            rods.centre[i] = box.point_at({u[0], u[1], u[2]});
            if (common_axis) return;
            const auto v = uniform4(key, 2 * draw + 1);
            rods.axis[i] = random_direction(v[0], v[1], box.dimensions());
        });
    };
    Rows again(rods.size());
    std::iota(again.begin(), again.end(), 0);
    const double range =
        parallel_max(rods.size(), 0.0, [&](std::size_t i) { return rods.length[i] + rods.diameter[i]; });
    draw_places(again, 0);
    const CellGrid grid(rods, box, range);
    MovableCells cells(grid, box, range);
    const auto renumber_all = [&] {
        renumber(rods, box, range, again);
        cells.fill(rods);
    };
    renumber_all();
    const std::size_t worth_renumbering = rods.size() / 64;  // fewer are soon looked at, wherever they lie
    const auto max_few = static_cast<std::size_t>(few * static_cast<double>(rods.size()));
    for (std::uint32_t draw = 1;; ++draw) {
        sort_by_cell(again, rods, grid);
        again = rows_to_draw_again(rods, box, cells, again, ranks);
        if (again.empty() || draw >= (again.size() <= max_few ? max_draws_of_few : max_draws)) break;
        for (const std::uint32_t row : again) cells.take_out(row, rods.centre[row]);
        draw_places(again, draw);
        for (const std::uint32_t row : again) cells.put_in(row, rods.centre[row]);
        if (again.size() > worth_renumbering) renumber_all();
    }
    return in_order_of_ids(rods);
}

}  // namespace jostle
