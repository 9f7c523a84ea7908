#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "jostle/contact/cell_grid.hpp"

namespace jostle {

/// Rods in cells, that may be moved to other places one by one.
class MovableCells {
public:
    /// `range`: the largest distance of centres that `visit` must cover.
    MovableCells(const CellGrid& grid, const Box& box, double range)
        : grid_(grid),
          box_(box),
          // Places are kept in single precision.
          squared_range_(
              static_cast<float>(std::pow(range + 1e-6 * (box.edges().x + box.edges().y + box.edges().z), 2.0))),
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

    /// Whether overlaps(row, displacement of its image) for any of the rods within range of `centre`, each asked once,
    /// until one does; it may be asked of a few that are not. Rods in the same cell first: they overlap most often.
    template <class Overlaps>
    bool any_near(const Vec3& centre, Overlaps&& overlaps) const {
        const std::size_t home = grid_.cell_of(centre);
        if (any_in(home, centre, {}, overlaps)) return true;
        bool any = false;
        grid_.visit(home, [&](std::size_t first, std::size_t last, const Image& image) {
            if (any) return;
            const Vec3 displacement = box_.displacement(image);
            const bool at_home = image == Image{0, 0, 0};
            for (std::size_t cell = first; cell <= last && !any; ++cell)
                if (cell != home || !at_home) any = any_in(cell, centre, displacement, overlaps);
        });
        return any;
    }

private:
    static constexpr std::uint32_t none = 0xFFFFFFFF;
    struct Place {
        float x, y, z;
        std::uint32_t next;  ///< row in the same cell
    };

    template <class Overlaps>
    bool any_in(std::size_t cell, const Vec3& centre, const Vec3& displacement, Overlaps& overlaps) const {
        const auto [x, y, z] = in_float(centre - displacement);
        for (std::uint32_t row = first_[cell]; row != none;) {
            const Place& place = places_[row];
            const float dx = place.x - x, dy = place.y - y, dz = place.z - z;
            if (dx * dx + dy * dy + dz * dz < squared_range_ && overlaps(row, displacement)) return true;
            row = place.next;
        }
        return false;
    }

    const CellGrid& grid_;
    const Box& box_;
    float squared_range_;
    std::vector<std::uint32_t> first_;  ///< (cells)
    std::vector<Place> places_;         ///< (N) most of the time is spent in waiting for these: keep them small
};

}  // namespace jostle
