#include "jostle/contact/fixed_rod_grid.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// Cells along one direction, and in all.
constexpr double max_along = 200.0;
/// The grid is made for a longer range than is asked for, so that it lasts.
constexpr double range_margin = 1.1;

double distance_from_axis(const Vec3& point, const Vec3& centre, const Vec3& axis, double half) {
    const Vec3 between = point - centre;
    const double along = std::clamp(dot(between, axis), -half, half);
    return norm(between - along * axis);
}

}  // namespace

void FixedRodGrid::fit(const Box& box, double range) {
    if (!box.fixed_rods()) {
        fixed_.reset();
        return;
    }
    if (fixed_ == box.fixed_rods() && edges_ == box.edges() && range <= range_) return;
    fixed_ = box.fixed_rods();
    edges_ = box.edges();
    range_ = range_margin * range;
    list_copies(box);
}

void FixedRodGrid::list_copies(const Box& box) {
    set_cells(box);
    const Rods& fixed = *fixed_;
    const double within = range_ + 0.5 * norm(spacing_);
    std::vector<std::vector<FixedCopy>> cells(cells_[0] * cells_[1] * cells_[2]);
    for (std::uint32_t f = 0; f < fixed.size(); ++f) {
        std::array<std::int32_t, 3> most{};
        for (int k = 0; k < 3; ++k)
            if (box.periodic()[static_cast<std::size_t>(k)])
                most[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(
                    std::ceil((0.5 * fixed.length[f] * std::fabs(fixed.axis[f][k]) + within) / edges_[k]) + 1.0);
        for (std::int32_t x = -most[0]; x <= most[0]; ++x)
            for (std::int32_t y = -most[1]; y <= most[1]; ++y)
                for (std::int32_t z = -most[2]; z <= most[2]; ++z)
                    add_copy({f, {x, y, z}, fixed.centre[f] - box.displacement({x, y, z})}, within, cells);
    }
    begin_.assign(cells.size() + 1, 0);
    in_cells_.clear();
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        in_cells_.insert(in_cells_.end(), cells[cell].begin(), cells[cell].end());
        begin_[cell + 1] = in_cells_.size();
    }
}

/// Corner, spacing and number of the cells. Along directions that are not periodic they cover all where fixed rods lie.
void FixedRodGrid::set_cells(const Box& box) {
    const Rods& fixed = *fixed_;
    Vec3 upper = edges_;
    corner_ = {0, 0, 0};
    for (int k = 0; k < 3; ++k) {
        if (box.periodic()[static_cast<std::size_t>(k)]) continue;
        for (std::size_t f = 0; f < fixed.size(); ++f) {
            const double beyond = 0.5 * fixed.length[f] * std::fabs(fixed.axis[f][k]) + range_;
            corner_[k] = std::min(corner_[k], fixed.centre[f][k] - beyond);
            upper[k] = std::max(upper[k], fixed.centre[f][k] + beyond);
        }
    }
    for (int k = 0; k < 3; ++k) {
        const double width = upper[k] - corner_[k];
        const double along = std::clamp(std::floor(width / (0.5 * range_)), 1.0, max_along);
        cells_[static_cast<std::size_t>(k)] = static_cast<std::size_t>(along);
        spacing_[k] = width / along;
    }
}

/// Adds a copy to the cells whose middles its axis comes to within this distance.
void FixedRodGrid::add_copy(const FixedCopy& copy, double within, std::vector<std::vector<FixedCopy>>& cells) const {
    const Vec3& axis = fixed_->axis[copy.number];
    const double half = 0.5 * fixed_->length[copy.number];
    std::array<std::size_t, 3> first{}, last{};
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        const double beyond = half * std::fabs(axis[k]) + within;
        const double from = (copy.centre[k] - beyond - corner_[k]) / spacing_[k];
        const double to = (copy.centre[k] + beyond - corner_[k]) / spacing_[k];
        const auto most = static_cast<double>(cells_[direction]);
        if (to < 0.0 || from >= most) return;
        first[direction] = static_cast<std::size_t>(std::max(from, 0.0));
        last[direction] = static_cast<std::size_t>(std::min(to, most - 1.0));
    }
    for (std::size_t x = first[0]; x <= last[0]; ++x)
        for (std::size_t y = first[1]; y <= last[1]; ++y)
            for (std::size_t z = first[2]; z <= last[2]; ++z) {
                const Vec3 middle = corner_ + Vec3{(static_cast<double>(x) + 0.5) * spacing_.x,
                                                   (static_cast<double>(y) + 0.5) * spacing_.y,
                                                   (static_cast<double>(z) + 0.5) * spacing_.z};
                if (distance_from_axis(middle, copy.centre, axis, half) <= within)
                    cells[(x * cells_[1] + y) * cells_[2] + z].push_back(copy);
            }
}

std::span<const FixedCopy> FixedRodGrid::near(const Vec3& point) const {
    std::size_t cell = 0;
    for (int k = 0; k < 3; ++k) {
        const double place = std::floor((point[k] - corner_[k]) / spacing_[k]);
        const auto most = static_cast<double>(cells_[static_cast<std::size_t>(k)]);
        // Beyond a periodic edge only by rounding; beyond others by more, and far from all.
        if (!(place >= -1.0 && place <= most)) return {};
        cell =
            cell * cells_[static_cast<std::size_t>(k)] + static_cast<std::size_t>(std::clamp(place, 0.0, most - 1.0));
    }
    return std::span(in_cells_).subspan(begin_[cell], begin_[cell + 1] - begin_[cell]);
}

PairGeometry FixedRodGrid::pair(const FixedCopy& copy, const Rods& rods, std::size_t row, const Vec3& centre,
                                const Vec3& axis) const {
    return pair_with(*fixed_, copy, rods, row, centre, axis);
}

FixedCopy copy_of(const Contact& contact, const Image& image, const Box& box) {
    const std::uint32_t number = number_of_fixed_rod(contact.i);
    return {number, image, box.fixed_rods()->centre[number] - box.displacement(image)};
}

PairGeometry pair_with(const Rods& fixed, const FixedCopy& copy, const Rods& rods, std::size_t row, const Vec3& centre,
                       const Vec3& axis) {
    const std::uint32_t f = copy.number;
    return {centre - copy.centre,  fixed.axis[f],          axis,
            0.5 * fixed.length[f], 0.5 * rods.length[row], 0.5 * (fixed.diameter[f] + rods.diameter[row])};
}

FixedRodGrid grid_of_fixed_rods(const Box& box, const Rods& rods) {
    FixedRodGrid grid;
    if (box.fixed_rods())
        grid.fit(box, range_from_centre(rods, *box.fixed_rods(), std::vector<double>(rods.size(), 0.0)));
    return grid;
}

double range_from_centre(const Rods& rods, const Rods& fixed, std::span<const double> range) {
    double thickest = 0.0;
    for (const double diameter : fixed.diameter) thickest = std::max(thickest, diameter);
    return parallel_max(rods.size(), 0.0,
                        [&](std::size_t i) { return 0.5 * (rods.length[i] + rods.diameter[i] + thickest) + range[i]; });
}

}  // namespace jostle
