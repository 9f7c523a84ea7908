#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "jostle/rods/box.hpp"

namespace jostle {

/// Rods sorted into cells by their centres.
///
/// A periodic direction is divided evenly, however thin it is; `visit` then meets the same cell in several images. In
/// an open direction the cells span the rods' extent, and the outermost reach to infinity.
class CellList {
public:
    /// `range`: the largest distance of centres that `visit` must cover.
    CellList(const Rods& rods, const Box& box, double range);

    /// Calls found(j, image) for every rod j and image whose displaced centre may lie within `range` of rod i's centre;
    /// each (j, image) once, (i, 0) too.
    template <class Found>
    void visit(const Vec3& centre, Found&& found) const {
        const auto home = cell_of(centre);
        std::array<int, 3> first{}, last{};
        for (std::size_t k = 0; k < 3; ++k) {
            first[k] = home[k] - width_[k];
            last[k] = home[k] + width_[k];
            if (!periodic_[k]) {
                first[k] = first[k] < 0 ? 0 : first[k];
                last[k] = last[k] > count_[k] - 1 ? count_[k] - 1 : last[k];
            }
        }
        for (int z = first[2]; z <= last[2]; ++z)
            for (int y = first[1]; y <= last[1]; ++y)
                for (int x = first[0]; x <= last[0]; ++x) {
                    Image image;
                    const std::size_t cell = wrapped_cell({x, y, z}, image);
                    for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k) found(rods_[k], image);
                }
    }

private:
    std::array<int, 3> cell_of(const Vec3& centre) const;
    std::size_t wrapped_cell(const std::array<int, 3>& cell, Image& image) const;

    std::array<bool, 3> periodic_;
    std::array<int, 3> count_{};  ///< cells along each direction
    std::array<int, 3> width_{};  ///< how many cells `range` reaches to each side
    Vec3 origin_;
    Vec3 cells_per_length_;
    std::vector<std::uint32_t> begin_;  ///< (cells + 1)
    std::vector<std::uint32_t> rods_;   ///< rows, ascending inside each cell
};

}  // namespace jostle
