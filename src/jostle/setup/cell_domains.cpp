#include "jostle/setup/cell_domains.hpp"

namespace jostle {

CellDomains::CellDomains(const CellGrid& grid, const Box& box, const std::array<std::uint64_t, 3>& shift)
    : grid_(grid), box_(box) {
    for (std::size_t k = 0; k < 3; ++k) {
        const int cells = grid.cells_along(k), range = grid.range_along(k);
        // Across y, the slabs along x of a sheared box meet others than those beside them.
        const bool apart = box.periodic()[k] && (box.offset() == 0.0 || k == 2);
        const int count = apart && cells >= 2 * range ? cells / range / 2 * 2 : 1;
        const int begin = count > 1 ? static_cast<int>(shift[k] % static_cast<std::uint64_t>(cells)) : 0;
        Slabs& slabs = slabs_[k];
        for (std::int64_t slab = 0; slab <= count; ++slab)
            slabs.first.push_back(begin + static_cast<int>(slab * cells / count));
        slabs.of_cell.resize(static_cast<std::size_t>(cells));
        for (std::size_t slab = 0; slab < slabs.count(); ++slab)
            for (int cell = slabs.first[slab]; cell < slabs.first[slab + 1]; ++cell)
                slabs.of_cell[static_cast<std::size_t>(cell % cells)] = slab;
    }
    for (std::size_t z = 0; z < slabs_[2].count(); ++z)
        for (std::size_t y = 0; y < slabs_[1].count(); ++y)
            for (std::size_t x = 0; x < slabs_[0].count(); ++x)
                colour_.push_back(static_cast<int>(x % 2 + 2 * (y % 2) + 4 * (z % 2)));
}

std::size_t CellDomains::domain_of(const Vec3& centre) const {
    const auto place = grid_.indices_of(grid_.cell_of(centre));
    const auto slab = [&](std::size_t k) { return slabs_[k].of_cell[static_cast<std::size_t>(place[k])]; };
    return (slab(2) * slabs_[1].count() + slab(1)) * slabs_[0].count() + slab(0);
}

Vec3 CellDomains::point_in(std::size_t domain, const std::array<double, 3>& parts) const {
    Vec3 point;
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        const Slabs& slabs = slabs_[direction];
        const std::size_t slab = domain % slabs.count();
        domain /= slabs.count();
        const auto first = static_cast<double>(slabs.first[slab]), last = static_cast<double>(slabs.first[slab + 1]);
        const auto cells = static_cast<double>(slabs.of_cell.size());
        const double cell = first + parts[direction] * (last - first);
        point[k] = (cell < cells ? cell : cell - cells) / cells * box_.edges()[k];
    }
    return point;
}

}  // namespace jostle
