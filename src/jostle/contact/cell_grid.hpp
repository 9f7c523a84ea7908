#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// A box divided into cells, about half as wide as the range in which rods look for each other.
///
/// A periodic direction is divided evenly, however thin it is; `visit` then meets the same cell in several images. In
/// an open direction the cells span the rods' extent, or that of most of them, and the outermost reach to infinity.
class CellGrid {
public:
    /// `range`: the largest distance of centres that `visit` must cover.
    CellGrid(const Rods& rods, const Box& box, double range);

    std::size_t size() const {
        return static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]) *
               static_cast<std::size_t>(count_[2]);
    }

    std::size_t cell_of(const Vec3& centre) const;

    /// Where a cell stands along each direction.
    std::array<int, 3> indices_of(std::size_t cell) const;

    int cells_along(std::size_t direction) const { return count_[direction]; }
    /// So many cells to each side does `visit` reach.
    int range_along(std::size_t direction) const { return width_[direction]; }

    /// The images that `visit` names reach so far to both sides of 0.
    Image farthest_image() const {
        Image farthest;
        for (std::size_t k = 0; k < 3; ++k) farthest[k] = periodic_[k] ? image_of(count_[k] - 1 + width_[k], k) : 0;
        if (offset_ == 0.0) return farthest;
        const double beyond = std::ceil(std::fabs(offset_) * farthest[1]);
        farthest[0] = image_of(count_[0] - 1 + width_[0] + static_cast<int>(beyond), 0);
        return farthest;
    }

    /// Calls found(first, last, image) with all cells, in runs first ... last, that may, displaced by `image`, hold a
    /// centre within `range` of one in `home`; each (cell, image) once, (home, 0) too.
    template <class Found>
    void visit(std::size_t home, Found&& found) const {
        const auto place = indices_of(home);
        for (int z = first(place, 2); z <= last(place, 2); ++z)
            for (int y = first(place, 1); y <= last(place, 1); ++y) {
                const int image_y = image_of(y, 1), image_z = image_of(z, 2);
                const int row = ((z - image_z * count_[2]) * count_[1] + y - image_y * count_[1]) * count_[0];
                // The cells of copies above stand by a part of a cell beside those of the home: one more is in range.
                const double above = image_y * offset_;
                const int last_x = last(place, 0) + static_cast<int>(std::ceil(-above));
                for (int x = first(place, 0) + static_cast<int>(std::floor(-above)); x <= last_x;) {
                    const int image_x = image_of(x, 0), offset = image_x * count_[0];
                    const int end = std::min(last_x, offset + count_[0] - 1);
                    found(static_cast<std::size_t>(row + x - offset), static_cast<std::size_t>(row + end - offset),
                          Image{image_x, image_y, image_z});
                    x = end + 1;
                }
            }
    }

private:
    int first(const std::array<int, 3>& place, std::size_t k) const {
        const int cell = place[k] - width_[k];
        return periodic_[k] ? cell : std::max(cell, 0);
    }
    int last(const std::array<int, 3>& place, std::size_t k) const {
        const int cell = place[k] + width_[k];
        return periodic_[k] ? cell : std::min(cell, count_[k] - 1);
    }
    int image_of(int cell, std::size_t k) const {
        return cell >= 0 ? cell / count_[k] : -((count_[k] - 1 - cell) / count_[k]);
    }

    std::array<bool, 3> periodic_;
    std::array<int, 3> count_{};  ///< cells along each direction
    std::array<int, 3> width_{};  ///< how many cells `range` reaches to each side
    double offset_ = 0.0;         ///< of the copies above, in cells along x
    Vec3 origin_;
    Vec3 cells_per_length_;
};

}  // namespace jostle
