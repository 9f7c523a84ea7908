#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/cell_grid.hpp"

namespace jostle {

/// Rods sorted into the cells of a grid by their centres.
class CellList {
public:
    /// `range`: the largest distance of centres that `visit` must cover.
    CellList(const Rods& rods, const Box& box, double range);

    std::size_t size() const { return begin_.size() - 1; }
    Image farthest_image() const { return grid_.farthest_image(); }

    /// All rows, cell by cell.
    std::span<const std::uint32_t> rods() const { return rods_; }

    /// Rows of the rods in a cell, ascending.
    std::span<const std::uint32_t> rods_in(std::size_t cell) const { return rods_in(cell, cell); }

    /// Calls found(rods, image) with the rods of every cell that CellGrid::visit names, cells in a row together.
    template <class Found>
    void visit(std::size_t home, Found&& found) const {
        grid_.visit(home, [&](std::size_t first, std::size_t last, const Image& image) {
            const auto rods = rods_in(first, last);
            if (!rods.empty()) found(rods, image);
        });
    }

private:
    std::span<const std::uint32_t> rods_in(std::size_t first, std::size_t last) const {
        return {rods_.data() + begin_[first], begin_[last + 1] - begin_[first]};
    }

    CellGrid grid_;
    std::vector<std::uint32_t> begin_;  ///< (cells + 1)
    std::vector<std::uint32_t> rods_;   ///< rows, ascending inside each cell
};

}  // namespace jostle
