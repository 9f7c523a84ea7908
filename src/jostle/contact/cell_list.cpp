#include "jostle/contact/cell_list.hpp"

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

CellList::CellList(const Rods& rods, const Box& box, double range) : grid_(rods, box, range) {
    begin_.assign(grid_.size() + 1, 0);
    rods_.resize(rods.size());
    std::vector<std::uint32_t> cell_of_rod(rods.size());
    parallel_for(rods.size(),
                 [&](std::size_t i) { cell_of_rod[i] = static_cast<std::uint32_t>(grid_.cell_of(rods.centre[i])); });
    for (const std::uint32_t cell : cell_of_rod) ++begin_[cell + 1];
    for (std::size_t cell = 0; cell < size(); ++cell) begin_[cell + 1] += begin_[cell];
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t i = 0; i < rods.size(); ++i) rods_[next[cell_of_rod[i]]++] = static_cast<std::uint32_t>(i);
}

}  // namespace jostle
