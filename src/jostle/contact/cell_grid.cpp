#include "jostle/contact/cell_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace jostle {

namespace {

/// At most this many cells a rod: more would only cost memory in a dilute assembly.
constexpr double largest_cells_per_rod = 4.0;
/// So much of the rods, at either end of an open direction, may lie in the outermost cells where there are too many.
constexpr double outliers = 0.02;
/// Along a direction; and to either side of a cell. Sums and products of both stay whole numbers.
constexpr double max_cells = 1e6, max_width = 1 << 30;

/// The whole number nearest to `value` within bounds: a plain cast has no meaning beyond them.
int whole(double value, double lowest, double highest) {
    return static_cast<int>(value > lowest ? (value < highest ? value : highest) : lowest);
}

/// Along one direction: all rods but a part of them at either end lie between.
std::pair<double, double> middle_of(const Rods& rods, int direction, double part) {
    std::vector<double> places(rods.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = rods.centre[i][direction];
    const auto first = static_cast<std::ptrdiff_t>(part * static_cast<double>(places.size() - 1));
    std::nth_element(places.begin(), places.begin() + first, places.end());
    const double low = places[static_cast<std::size_t>(first)];
    std::nth_element(places.begin(), places.end() - 1 - first, places.end());
    return {low, *(places.end() - 1 - first)};
}

}  // namespace

CellGrid::CellGrid(const Rods& rods, const Box& box, double range) : periodic_(box.periodic()) {
    Vec3 extent = box.edges();
    const auto span_open_directions = [&](double left_out) {
        for (int k = 0; k < 3; ++k) {
            if (periodic_[static_cast<std::size_t>(k)] || rods.size() == 0) continue;
            const auto [low, high] = middle_of(rods, k, left_out);
            origin_[k] = low;
            extent[k] = std::max(high - low, range);
        }
    };
    // Cells of half the range: 125 of them enclose less than 27 of the full range would.
    double edge = 0.5 * range;
    const auto cells = [&] { return extent.x / edge * (extent.y / edge) * (extent.z / edge); };
    const double allowed = largest_cells_per_rod * static_cast<double>(rods.size()) + 64.0;
    span_open_directions(0.0);
    if (cells() > allowed) span_open_directions(outliers);  // a few far away must not make the cells of all wide
    if (cells() > allowed) edge *= std::cbrt(cells() / allowed);
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        count_[direction] = whole(std::floor(extent[k] / edge), 1.0, max_cells);
        cells_per_length_[k] = count_[direction] / extent[k];
        width_[direction] = whole(std::ceil(range * cells_per_length_[k]), 0.0, max_width);
    }
    offset_ = box.offset() * cells_per_length_.x;
}

std::size_t CellGrid::cell_of(const Vec3& centre) const {
    std::array<std::size_t, 3> cell{};
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        const double position = std::floor((centre[k] - origin_[k]) * cells_per_length_[k]);
        // Rounding may put a wrapped centre on the upper face; in an open direction the outer cells are unbounded.
        cell[direction] = static_cast<std::size_t>(whole(position, 0.0, count_[direction] - 1));
    }
    return (cell[2] * static_cast<std::size_t>(count_[1]) + cell[1]) * static_cast<std::size_t>(count_[0]) + cell[0];
}

std::array<int, 3> CellGrid::indices_of(std::size_t cell) const {
    const auto nx = static_cast<std::size_t>(count_[0]), ny = static_cast<std::size_t>(count_[1]);
    return {static_cast<int>(cell % nx), static_cast<int>(cell / nx % ny), static_cast<int>(cell / (nx * ny))};
}

}  // namespace jostle
