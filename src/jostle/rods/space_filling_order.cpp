#include "jostle/rods/space_filling_order.hpp"

#include <algorithm>
#include <numeric>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr std::uint64_t cells_per_edge = 1U << 20;

/// Spreads the 20 bits of a number so that two zeros lie between each two.
std::uint64_t spread(std::uint64_t x) {
    x = (x | x << 32) & 0x1F00000000FFFFULL;
    x = (x | x << 16) & 0x1F0000FF0000FFULL;
    x = (x | x << 8) & 0x100F00F00F00F00FULL;
    x = (x | x << 4) & 0x10C30C30C30C30C3ULL;
    return (x | x << 2) & 0x1249249249249249ULL;
}

struct CellPlace {
    std::uint64_t along_curve, id;
    std::uint32_t row;
};

}  // namespace

std::vector<std::uint32_t> space_filling_order(const Rods& rods, const Box& box) {
    // Cells are cubes, the same in all directions; the curve repeats itself where an open box has been left.
    const double cell = box.longest_edge() / static_cast<double>(cells_per_edge);
    const auto coordinate = [&](double x) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(x / cell))) % cells_per_edge;
    };
    std::vector<CellPlace> places(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        const Vec3& centre = rods.centre[i];
        const std::uint64_t along =
            spread(coordinate(centre.x)) | spread(coordinate(centre.y)) << 1 | spread(coordinate(centre.z)) << 2;
        places[i] = {along, rods.id[i], static_cast<std::uint32_t>(i)};
    });
    std::sort(places.begin(), places.end(), [](const CellPlace& a, const CellPlace& b) {
        return a.along_curve != b.along_curve ? a.along_curve < b.along_curve : a.id < b.id;
    });
    std::vector<std::uint32_t> order(rods.size());
    parallel_for(rods.size(), [&](std::size_t k) { order[k] = places[k].row; });
    return order;
}

std::vector<std::uint32_t> id_order(const Rods& rods) {
    std::vector<std::uint32_t> order(rods.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return rods.id[a] < rods.id[b]; });
    return order;
}

std::vector<std::uint32_t> new_rows(std::span<const std::uint32_t> order) {
    std::vector<std::uint32_t> row(order.size());
    parallel_for(order.size(), [&](std::size_t k) { row[order[k]] = static_cast<std::uint32_t>(k); });
    return row;
}

Rods reordered(const Rods& rods, std::span<const std::uint32_t> order) {
    Rods result;
    const auto take = [&](auto& to, const auto& from) {
        to.resize(order.size());
        parallel_for(order.size(), [&](std::size_t k) { to[k] = from[order[k]]; });
    };
    take(result.centre, rods.centre);
    take(result.axis, rods.axis);
    take(result.length, rods.length);
    take(result.diameter, rods.diameter);
    take(result.id, rods.id);
    take(result.image, rods.image);
    if (!rods.cycle.empty()) take(result.cycle, rods.cycle);
    result.founder_bits = rods.founder_bits;
    if (!rods.speed.empty()) take(result.speed, rods.speed);
    return result;
}

Rods in_order_of_ids(const Rods& rods) {
    return reordered(rods, id_order(rods));
}

}  // namespace jostle
