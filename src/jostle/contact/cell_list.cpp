#include "jostle/contact/cell_list.hpp"

#include <algorithm>
#include <cmath>

namespace jostle {

namespace {

/// At most this many cells a rod: more would only cost memory in a dilute assembly.
constexpr double largest_cells_per_rod = 4.0;

int floor_divide(int a, int b) {
    return a >= 0 ? a / b : -((b - 1 - a) / b);
}

}  // namespace

CellList::CellList(const Rods& rods, const Box& box, double range) : periodic_(box.periodic) {
    Vec3 low{0, 0, 0}, extent = box.edges;
    for (int k = 0; k < 3; ++k) {
        if (periodic_[static_cast<std::size_t>(k)] || rods.size() == 0) continue;
        const auto less = [k](const Vec3& a, const Vec3& b) { return a[k] < b[k]; };
        const auto [lowest, highest] = std::minmax_element(rods.centre.begin(), rods.centre.end(), less);
        low[k] = (*lowest)[k];
        extent[k] = std::max((*highest)[k] - low[k], range);
    }
    origin_ = low;
    // Cells of half the range: 125 of them enclose less than 27 of the full range would.
    double edge = 0.5 * range;
    const double cells = extent.x / edge * (extent.y / edge) * (extent.z / edge);
    const double allowed = largest_cells_per_rod * static_cast<double>(rods.size()) + 64.0;
    if (cells > allowed) edge *= std::cbrt(cells / allowed);
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        const double number = std::clamp(std::floor(extent[k] / edge), 1.0, 1e6);
        count_[direction] = static_cast<int>(number);
        cells_per_length_[k] = number / extent[k];
        width_[direction] = static_cast<int>(std::ceil(range * cells_per_length_[k]));
    }
    const std::size_t total =
        static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) * static_cast<std::size_t>(count_[2]);
    begin_.assign(total + 1, 0);
    rods_.resize(rods.size());
    std::vector<std::uint32_t> cell_of_rod(rods.size());
    Image unused;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        cell_of_rod[i] = static_cast<std::uint32_t>(wrapped_cell(cell_of(rods.centre[i]), unused));
        ++begin_[cell_of_rod[i] + 1];
    }
    for (std::size_t cell = 0; cell < total; ++cell) begin_[cell + 1] += begin_[cell];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < rods.size(); ++i) rods_[next[cell_of_rod[i]]++] = static_cast<std::uint32_t>(i);
}

std::array<int, 3> CellList::cell_of(const Vec3& centre) const {
    std::array<int, 3> cell{};
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        const double position = std::floor((centre[k] - origin_[k]) * cells_per_length_[k]);
        // Rounding may put a wrapped centre on the upper face; in an open direction the outer cells are unbounded.
        cell[direction] = static_cast<int>(std::clamp(position, 0.0, static_cast<double>(count_[direction] - 1)));
    }
    return cell;
}

std::size_t CellList::wrapped_cell(const std::array<int, 3>& cell, Image& image) const {
    std::array<std::size_t, 3> wrapped{};
    for (std::size_t k = 0; k < 3; ++k) {
        image[k] = periodic_[k] ? floor_divide(cell[k], count_[k]) : 0;
        wrapped[k] = static_cast<std::size_t>(cell[k] - image[k] * count_[k]);
    }
    return (wrapped[2] * static_cast<std::size_t>(count_[1]) + wrapped[1]) * static_cast<std::size_t>(count_[0]) +
           wrapped[0];
}

}  // namespace jostle
