#include "jostle/simulation/scattered_rods.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "jostle/contact/cell_grid.hpp"
#include "jostle/contact/pair_contacts.hpp"
#include "jostle/math/random.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/simulation/rod_size.hpp"

namespace jostle {

namespace {

/// Draws of a rod's place before what still overlaps is left to others; many more where it is but a few.
constexpr std::uint32_t most_draws = 100, most_draws_of_few = 1000;
constexpr double few = 0.01;

constexpr std::size_t rods_per_block = 64;

using Rows = std::vector<std::uint32_t>;

/// Rods in cells, that may be moved to other places one by one.
class MovableCells {
public:
    /// `range`: the largest distance of centres that `visit` must cover.
    MovableCells(const Rods& rods, const Box& box, double range)
        : box_(box), grid_(rods, box, range), first_(grid_.size(), none), next_(rods.size(), none) {
        for (std::size_t i = rods.size(); i-- > 0;) put_in(static_cast<std::uint32_t>(i), rods.centre[i]);
    }

    void put_in(std::uint32_t row, const Vec3& centre) {
        std::uint32_t& first = first_[grid_.cell_of(centre)];
        next_[row] = first;
        first = row;
    }

    void take_out(std::uint32_t row, const Vec3& centre) {
        std::uint32_t* link = &first_[grid_.cell_of(centre)];
        while (*link != row) link = &next_[*link];
        *link = next_[row];
    }

    /// Rows of one cell, and of neighbouring cells, come one after the other.
    void sort(Rows& rows, const Rods& rods) const {
        std::vector<std::uint64_t> keys(rows.size());
        parallel_for(rows.size(),
                     [&](std::size_t k) { keys[k] = grid_.cell_of(rods.centre[rows[k]]) << 32 | rows[k]; });
        std::sort(keys.begin(), keys.end());
        parallel_for(rows.size(), [&](std::size_t k) { rows[k] = static_cast<std::uint32_t>(keys[k]); });
    }

    /// Calls found(row, displacement of its image) with the rods of all cells near `centre`.
    template <class Found>
    void visit(const Vec3& centre, Found&& found) const {
        grid_.visit(grid_.cell_of(centre), [&](std::size_t first, std::size_t last, const Image& image) {
            const Vec3 displacement = box_.displacement(image);
            for (std::size_t cell = first; cell <= last; ++cell)
                for (std::uint32_t row = first_[cell]; row != none; row = next_[row]) found(row, displacement);
        });
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    Box box_;
    CellGrid grid_;
    Rows first_;  ///< (cells)
    Rows next_;   ///< (N) in the same cell
};

Vec3 random_axis(const RandomKey& key, std::uint32_t draw) {
    const auto u = uniform4(key, 2 * draw + 1);
    const double z = 2.0 * u[0] - 1.0;
    const double radius = std::sqrt(1.0 - z * z), angle = 2.0 * std::numbers::pi * u[1];
    return normalised({radius * std::cos(angle), radius * std::sin(angle), z});
}

/// Of every two rods that overlap, one of them in `rows`, the one with the higher id. Rods farther apart than `range`
/// do not.
Rows rows_to_draw_again(const Rods& rods, const MovableCells& cells, double range, const Rows& rows) {
    std::vector<Rows> found((rows.size() + rods_per_block - 1) / rods_per_block);
    const auto look_around = [&](std::uint32_t row, Rows& again) {
        cells.visit(rods.centre[row], [&](std::uint32_t other, const Vec3& displacement) {
            const Vec3 between = rods.centre[other] + displacement - rods.centre[row];
            const double squared_distance = squared_norm(between);
            if (squared_distance >= range * range || (other == row && squared_distance == 0.0)) return;
            // Most are told apart by the distance of the lines through their axes.
            const Vec3 across = cross(rods.axis[row], rods.axis[other]);
            const double touching = 0.5 * (rods.diameter[row] + rods.diameter[other]), shift = dot(between, across);
            if (shift * shift > 1.001 * touching * touching * squared_norm(across)) return;
            const bool is_first = rods.id[row] <= rods.id[other];
            const auto [i, j] = is_first ? std::pair(row, other) : std::pair(other, row);
            if (pair_gap(pair_geometry(rods, i, j, is_first ? displacement : -displacement, rods.centre, rods.axis)) <
                0.0)
                again.push_back(j);
        });
    };
    parallel_for_blocks(rows.size(), rods_per_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) look_around(rows[k], found[block]);
    });
    Rows again;
    for (const Rows& part : found) again.insert(again.end(), part.begin(), part.end());
    std::sort(again.begin(), again.end());
    again.erase(std::unique(again.begin(), again.end()), again.end());
    return again;
}

/// Puts the rods in the order of cells, so that those near each other come near each other in memory; `rows` follow.
void sort(Rods& rods, const MovableCells& cells, Rows& rows) {
    Rows order(rods.size());
    std::iota(order.begin(), order.end(), 0);
    cells.sort(order, rods);
    const Rows place = new_rows(order);
    rods = reordered(rods, order);
    for (std::uint32_t& row : rows) row = place[row];
}

}  // namespace

Rods scattered_rods(const Scene& scene, const Box& box, const std::optional<Vec3>& common_axis) {
    Rods rods;
    for (const RodSize& size : rod_sizes(scene))
        rods.push_back(rods.size(), {}, common_axis.value_or(Vec3{}), size.length, size.diameter);
    const auto draw_places = [&](const Rows& rows, std::uint32_t draw) {
        parallel_for(rows.size(), [&](std::size_t k) {
            const std::uint32_t i = rows[k];
            const RandomKey key{scene.seed, 0, Stream::start, rods.id[i]};
            const auto u = uniform4(key, 2 * draw);
            rods.centre[i] = {u[0] * box.edges.x, u[1] * box.edges.y, u[2] * box.edges.z};
            if (!common_axis) rods.axis[i] = random_axis(key, draw);
        });
    };
    Rows again(rods.size());
    std::iota(again.begin(), again.end(), 0);
    const double range =
        parallel_max(rods.size(), 0.0, [&](std::size_t i) { return rods.length[i] + rods.diameter[i]; });
    draw_places(again, 0);
    MovableCells cells(rods, box, range);
    std::size_t when_sorted = 0;
    const auto sort_all = [&] {
        sort(rods, cells, again);
        cells = MovableCells(rods, box, range);
        when_sorted = again.size();
    };
    sort_all();
    again = rows_to_draw_again(rods, cells, range, again);
    const std::size_t worth_sorting = rods.size() / 16;  // fewer are soon drawn anew wherever they lie in memory
    const auto most_few = static_cast<std::size_t>(few * static_cast<double>(rods.size()));
    for (std::uint32_t draw = 1; !again.empty() && draw < (again.size() <= most_few ? most_draws_of_few : most_draws);
         ++draw) {
        if (again.size() <= when_sorted / 2 && when_sorted > worth_sorting) sort_all();
        for (const std::uint32_t row : again) cells.take_out(row, rods.centre[row]);
        draw_places(again, draw);
        for (const std::uint32_t row : again) cells.put_in(row, rods.centre[row]);
        cells.sort(again, rods);
        again = rows_to_draw_again(rods, cells, range, again);
    }
    return reordered(rods, id_order(rods));
}

}  // namespace jostle
