#include "jostle/domain/rods_in_order.hpp"

#include <cmath>
#include <numeric>
#include <stdexcept>

namespace jostle {

RodsInOrder::RodsInOrder(const Rods& rods, const Domain& domain, TakenBy taken_by, std::size_t slice)
    : rods_(rods),
      ranks_(domain.ranks()),
      own_(domain.owned_of(rods.size())),
      at_once_(taken_by == TakenBy::all_ranks ? static_cast<std::size_t>(ranks_.count()) : 1),
      have_cycle_(ranks_.any(!rods.cycle.empty())),
      have_speed_(ranks_.any(!rods.speed.empty())) {
    std::iota(own_.begin(), own_.end(), 0U);
    std::sort(own_.begin(), own_.end(), [&](std::uint32_t a, std::uint32_t b) { return rods.id[a] < rods.id[b]; });
    size_ = static_cast<std::size_t>(ranks_.sum(static_cast<std::int64_t>(own_.size())));
    divide_into_slices(std::max<std::size_t>(1, slice / static_cast<std::size_t>(ranks_.count())));
    if (ranks_.alone()) return;
    deal([](const Rods& of, std::uint32_t row) { return of.id[row]; },
         [&](std::size_t k, const auto& arrived) { slices_[k].from = ranks_in_order(arrived); });
}

/// Ids may lie far apart: a slice ends where a rank would send more than its part of it. They are below 2^53, and so
/// exact as doubles.
void RodsInOrder::divide_into_slices(std::size_t part) {
    std::vector<std::int64_t> sizes;
    std::size_t sent = 0;
    for (double end = 0.0; end < INFINITY;) {
        const double beyond = sent + part < own_.size() ? static_cast<double>(rods_.id[own_[sent + part]]) : INFINITY;
        end = -ranks_.largest(-beyond);
        const std::size_t begin = sent;
        while (sent < own_.size() && static_cast<double>(rods_.id[own_[sent]]) < end) ++sent;
        slices_.push_back({.own = sent - begin, .from = {}});
        sizes.push_back(static_cast<std::int64_t>(sent - begin));
    }
    ranks_.add_up(sizes);
    for (std::size_t k = 1; k < slices_.size(); ++k)
        slices_[k].before = slices_[k - 1].before + static_cast<std::size_t>(sizes[k - 1]);
}

/// Which rank each rod comes from, in the order of ids.
std::vector<std::uint32_t> RodsInOrder::ranks_in_order(const std::vector<std::vector<std::uint64_t>>& ids_of_ranks) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> all;
    for (std::uint32_t rank = 0; rank < ids_of_ranks.size(); ++rank)
        for (const std::uint64_t id : ids_of_ranks[rank]) all.emplace_back(id, rank);
    std::sort(all.begin(), all.end());
    std::vector<std::uint32_t> from;
    from.reserve(all.size());
    for (const auto& [id, rank] : all) from.push_back(rank);
    return from;
}

std::vector<std::uint64_t> RodsInOrder::ids() const {
    if (all_take()) throw std::logic_error("the first rank does not take all rods");
    std::vector<std::uint64_t> all;
    column([](const Rods& rods, std::uint32_t row) { return rods.id[row]; },
           [&](std::size_t, auto slice) { all.insert(all.end(), slice.begin(), slice.end()); });
    return all;
}

Rods RodsInOrder::whole() const {
    if (all_take()) throw std::logic_error("the first rank does not take all rods");
    Rods all;
    all.founder_bits = rods_.founder_bits;
    const auto fill = [&](auto& values, auto&& of) {
        if (ranks_.rank() == 0) values.reserve(size_);
        column(of, [&](std::size_t, auto slice) { values.insert(values.end(), slice.begin(), slice.end()); });
    };
    fill(all.centre, [](const Rods& rods, std::uint32_t row) { return rods.centre[row]; });
    fill(all.axis, [](const Rods& rods, std::uint32_t row) { return rods.axis[row]; });
    fill(all.length, [](const Rods& rods, std::uint32_t row) { return rods.length[row]; });
    fill(all.diameter, [](const Rods& rods, std::uint32_t row) { return rods.diameter[row]; });
    all.id = ids();
    fill(all.image, [](const Rods& rods, std::uint32_t row) { return rods.image[row]; });
    if (have_cycle_) fill(all.cycle, [](const Rods& rods, std::uint32_t row) { return rods.cycle[row]; });
    if (have_speed_) fill(all.speed, [](const Rods& rods, std::uint32_t row) { return rods.speed[row]; });
    return all;
}

}  // namespace jostle
