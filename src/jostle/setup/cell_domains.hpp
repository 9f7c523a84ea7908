#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "jostle/contact/cell_grid.hpp"

namespace jostle {

/// The cells of a grid in blocks that are at least as wide as a search reaches. No search from one domain meets another
/// of the same colour, so that the rods of all domains of a colour may be moved at the same time.
///
///     | 0 | 1 | 0 | 1 |    two colours along each direction that has room for two domains;
///     | 2 | 3 | 2 | 3 |    none is divided that is open
class CellDomains {
public:
    /// `shift`: by how many cells the borders are moved along each direction; any numbers.
    CellDomains(const CellGrid& grid, const Box& box, const std::array<std::uint64_t, 3>& shift);

    std::size_t size() const { return colour_.size(); }
    static constexpr int colours = 8;
    /// Of every domain: 0 to 7.
    const std::vector<int>& colour() const { return colour_; }

    std::size_t domain_of(const Vec3& centre) const;

    /// The point of a domain that lies at these parts (0 to 1) of its edges.
    Vec3 point_in(std::size_t domain, const std::array<double, 3>& parts) const;

private:
    /// The domains along one direction.
    struct Slabs {
        std::vector<std::size_t> of_cell;  ///< (cells) which slab a cell is in
        std::vector<int> first;            ///< (slabs + 1) first cells; cells count on beyond the last
        std::size_t count() const { return first.size() - 1; }
    };

    const CellGrid& grid_;
    const Box& box_;
    std::array<Slabs, 3> slabs_;
    std::vector<int> colour_;
};

}  // namespace jostle
