#include "jostle/simulation/scattered_rods.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "jostle/contact/cell_grid.hpp"
#include "jostle/contact/cell_list.hpp"
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

using Rows = std::vector<std::uint32_t>;

/// Rods in cells, that may be moved to other places one by one.
class MovableCells {
public:
    /// `range`: the largest distance of centres that `visit` must cover.
    MovableCells(const CellGrid& grid, const Box& box, double range)
        : grid_(grid),
          box_(box),
          // Places are kept in single precision.
          squared_range_(static_cast<float>(std::pow(range + 1e-6 * (box.edges.x + box.edges.y + box.edges.z), 2.0))),
          first_(grid.size()) {}

    void fill(const Rods& rods) {
        std::fill(first_.begin(), first_.end(), none);
        places_.resize(rods.size());
        for (std::size_t i = rods.size(); i-- > 0;) put_in(static_cast<std::uint32_t>(i), rods.centre[i]);
    }

    void put_in(std::uint32_t row, const Vec3& centre) {
        std::uint32_t& first = first_[grid_.cell_of(centre)];
        const auto [x, y, z] = in_float(centre);
        places_[row] = {x, y, z, first};
        first = row;
    }

    void take_out(std::uint32_t row, const Vec3& centre) {
        std::uint32_t* link = &first_[grid_.cell_of(centre)];
        while (*link != row) link = &places_[*link].next;
        *link = places_[row].next;
    }

    /// Whether overlaps(row, displacement of its image) for any of the rods within range of `centre`; it may be asked
    /// of a few that are not.
    template <class Overlaps>
    bool any_near(const Vec3& centre, Overlaps&& overlaps) const {
        bool any = false;
        grid_.visit(grid_.cell_of(centre), [&](std::size_t first, std::size_t last, const Image& image) {
            const Vec3 displacement = box_.displacement(image);
            const auto [x, y, z] = in_float(centre - displacement);
            for (std::size_t cell = first; cell <= last; ++cell)
                for (std::uint32_t row = first_[cell]; row != none && !any;) {
                    const Place& place = places_[row];
                    const float dx = place.x - x, dy = place.y - y, dz = place.z - z;
                    any = dx * dx + dy * dy + dz * dz < squared_range_ && overlaps(row, displacement);
                    row = place.next;
                }
        });
        return any;
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    struct Place {
        float x, y, z;
        std::uint32_t next;  ///< row in the same cell
    };

    const CellGrid& grid_;
    const Box& box_;
    float squared_range_;
    Rows first_;                 ///< (cells)
    std::vector<Place> places_;  ///< (N) most of the time is spent in waiting for these: keep them small
};

/// Rows in the order of the cells that the rods are in.
void sort_by_cell(Rows& rows, const Rods& rods, const CellGrid& grid) {
    std::vector<std::uint64_t> keys(rows.size());
    parallel_for(rows.size(), [&](std::size_t k) { keys[k] = grid.cell_of(rods.centre[rows[k]]) << 32 | rows[k]; });
    std::sort(keys.begin(), keys.end());
    parallel_for(rows.size(), [&](std::size_t k) { rows[k] = static_cast<std::uint32_t>(keys[k]); });
}

Vec3 random_axis(const RandomKey& key, std::uint32_t draw) {
    const auto u = uniform4(key, 2 * draw + 1);
    const double z = 2.0 * u[0] - 1.0;
    const double radius = std::sqrt(1.0 - z * z), angle = 2.0 * std::numbers::pi * u[1];
    return normalised({radius * std::cos(angle), radius * std::sin(angle), z});
}

bool overlap(const Rods& rods, std::uint32_t i, std::uint32_t j, const Vec3& displacement) {
    const PairGeometry pair = pair_geometry(rods, i, j, displacement, rods.centre, rods.axis);
    // Most are told apart by the distance of the lines through their axes.
    const Vec3 across = cross(pair.axis_i, pair.axis_j);
    const double shift = dot(pair.between, across);
    if (shift * shift > 1.001 * pair.radii * pair.radii * squared_norm(across)) return false;
    return pair_gap(pair) < 0.0;
}

/// Of the rods just drawn, those that overlap their own image, one that stays, or one just drawn with a lower id.
Rows rows_to_draw_again(const Rods& rods, const MovableCells& cells, const Rows& drawn) {
    std::vector<std::uint8_t> stays(rods.size(), 1), again(drawn.size());
    for (const std::uint32_t row : drawn) stays[row] = 0;
    parallel_for(drawn.size(), [&](std::size_t k) {
        const std::uint32_t row = drawn[k];
        again[k] = cells.any_near(rods.centre[row], [&](std::uint32_t other, const Vec3& displacement) {
            if (other == row && squared_norm(displacement) == 0.0) return false;
            const bool gives_way = !stays[other] && rods.id[other] > rods.id[row];
            return !gives_way && overlap(rods, row, other, displacement);
        });
    });
    Rows rows;
    for (std::size_t k = 0; k < drawn.size(); ++k)
        if (again[k]) rows.push_back(drawn[k]);
    return rows;
}

/// Puts the rods in the order of cells, so that those near each other come near each other in memory; `rows` follow.
void renumber(Rods& rods, const Box& box, double range, Rows& rows) {
    const CellList cells(rods, box, range);
    const Rows order(cells.rods().begin(), cells.rods().end()), place = new_rows(order);
    rods = reordered(rods, order);
    parallel_for(rows.size(), [&](std::size_t k) { rows[k] = place[rows[k]]; });
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
    const CellGrid grid(rods, box, range);
    MovableCells cells(grid, box, range);
    const auto renumber_all = [&] {
        renumber(rods, box, range, again);
        cells.fill(rods);
    };
    renumber_all();
    const std::size_t worth_renumbering = rods.size() / 64;  // fewer are soon looked at, wherever they lie
    const auto most_few = static_cast<std::size_t>(few * static_cast<double>(rods.size()));
    for (std::uint32_t draw = 1;; ++draw) {
        sort_by_cell(again, rods, grid);
        again = rows_to_draw_again(rods, cells, again);
        if (again.empty() || draw >= (again.size() <= most_few ? most_draws_of_few : most_draws)) break;
        for (const std::uint32_t row : again) cells.take_out(row, rods.centre[row]);
        draw_places(again, draw);
        for (const std::uint32_t row : again) cells.put_in(row, rods.centre[row]);
        if (again.size() > worth_renumbering) renumber_all();
    }
    return reordered(rods, id_order(rods));
}

}  // namespace jostle
