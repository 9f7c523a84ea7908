#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// Rods sorted into cells by their centres.
///
/// A periodic direction is divided evenly, however thin it is; `visit` then meets the same cell in several images. In
/// an open direction the cells span the rods' extent, and the outermost reach to infinity.
class CellList {
public:
    /// `range`: the largest distance of centres that `visit` must cover.
    CellList(const Rods& rods, const Box& box, double range);

    std::size_t size() const { return begin_.size() - 1; }

    /// Rows of the rods in a cell, ascending.
    std::span<const std::uint32_t> rods_in(std::size_t cell) const {
        return {rods_.data() + begin_[cell], begin_[cell + 1] - begin_[cell]};
    }

    /// Calls found(rods, image) with the rods of every cell, displaced by `image`, that may hold a centre within
    /// `range` of one in `home`; each (cell, image) once, (home, 0) too. Cells in a row come together.
    template <class Found>
    void visit(std::size_t home, Found&& found) const {
        const auto place = place_of(home);
        for (int z = first(place, 2); z <= last(place, 2); ++z)
            for (int y = first(place, 1); y <= last(place, 1); ++y) {
                const int image_y = image_of(y, 1), image_z = image_of(z, 2);
                const int row = ((z - image_z * count_[2]) * count_[1] + y - image_y * count_[1]) * count_[0];
                for (int x = first(place, 0); x <= last(place, 0);) {
                    const int image_x = image_of(x, 0), offset = image_x * count_[0];
                    const int end = std::min(last(place, 0), offset + count_[0] - 1);
                    const std::uint32_t begin = begin_[static_cast<std::size_t>(row + x - offset)];
                    const std::uint32_t behind = begin_[static_cast<std::size_t>(row + end - offset) + 1];
                    if (begin != behind)
                        found(std::span(rods_.data() + begin, behind - begin), Image{image_x, image_y, image_z});
                    x = end + 1;
                }
            }
    }

private:
    std::array<int, 3> cell_of(const Vec3& centre) const;
    std::array<int, 3> place_of(std::size_t cell) const;

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
    Vec3 origin_;
    Vec3 cells_per_length_;
    std::vector<std::uint32_t> begin_;  ///< (cells + 1)
    std::vector<std::uint32_t> rods_;   ///< rows, ascending inside each cell
};

}  // namespace jostle
