#include "jostle/domain/rods_in_order.hpp"

#include <cmath>
#include <numeric>

namespace jostle {

RodsInOrder::RodsInOrder(const Rods& rods, const Domain& domain, std::size_t slice)
    : rods_(rods),
      ranks_(domain.ranks()),
      own_(domain.owned_of(rods.size())),
      have_cycle_(ranks_.any(!rods.cycle.empty())),
      have_speed_(ranks_.any(!rods.speed.empty())) {
    std::iota(own_.begin(), own_.end(), 0U);
    std::sort(own_.begin(), own_.end(), [&](std::uint32_t a, std::uint32_t b) { return rods.id[a] < rods.id[b]; });
    size_ = static_cast<std::size_t>(ranks_.sum(static_cast<std::int64_t>(own_.size())));
    const std::size_t part = std::max<std::size_t>(1, slice / static_cast<std::size_t>(ranks_.count()));
    std::size_t sent = 0;
    for (bool is_last = false; !is_last;) slices_.push_back(next_slice(sent, part, is_last));
}

/// Ids may lie far apart: a slice ends where a rank would send more than its part of it. They are below 2^53, and so
/// exact as doubles.
RodsInOrder::Slice RodsInOrder::next_slice(std::size_t& sent, std::size_t part, bool& is_last) const {
    const double beyond = sent + part < own_.size() ? static_cast<double>(rods_.id[own_[sent + part]]) : INFINITY;
    const double end = -ranks_.largest(-beyond);
    is_last = end == INFINITY;
    std::vector<std::vector<std::uint64_t>> to(static_cast<std::size_t>(ranks_.count()));
    std::vector<std::uint64_t>& ids = to[0];
    for (; sent < own_.size() && static_cast<double>(rods_.id[own_[sent]]) < end; ++sent)
        ids.push_back(rods_.id[own_[sent]]);
    Slice slice{ids.size(), {}};
    if (ranks_.alone()) return slice;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> all;
    const auto arrived = ranks_.deal(to);
    for (std::uint32_t rank = 0; rank < arrived.size(); ++rank)
        for (const std::uint64_t id : arrived[rank]) all.emplace_back(id, rank);
    std::sort(all.begin(), all.end());
    for (const auto& [id, rank] : all) slice.from.push_back(rank);
    return slice;
}

std::vector<std::uint64_t> RodsInOrder::ids() const {
    std::vector<std::uint64_t> all;
    column([](const Rods& rods, std::uint32_t row) { return rods.id[row]; },
           [&](auto slice) { all.insert(all.end(), slice.begin(), slice.end()); });
    return all;
}

Rods RodsInOrder::whole() const {
    Rods all;
    all.founder_bits = rods_.founder_bits;
    const auto fill = [&](auto& values, auto&& of) {
        if (ranks_.rank() == 0) values.reserve(size_);
        column(of, [&](auto slice) { values.insert(values.end(), slice.begin(), slice.end()); });
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
