#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "jostle/domain/domain.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// The rods of all ranks in the order of ids, as files hold them: one column after the other.
///
/// A column comes to the first rank in slices, so that it needs the memory of one slice, and not of all rods. All ranks
/// make it, and call what it has, together.
class RodsInOrder {
public:
    /// `rods` must outlive it. `slice`: about how many rods the first rank takes at a time.
    // NOLINTNEXTLINE(google-explicit-constructor): rods of one process are written as they are
    RodsInOrder(const Rods& rods, const Domain& domain = Domain::whole(), std::size_t slice = std::size_t{1} << 20);

    /// How many all ranks have together.
    std::size_t size() const { return size_; }
    /// Whether rods have a cycle, or a speed of their own.
    bool have_cycle() const { return have_cycle_; }
    bool have_speed() const { return have_speed_; }
    int founder_bits() const { return rods_.founder_bits; }

    /// Calls take(span of values) for slice after slice, at the first rank alone. of(rods, row): the value of a rod.
    template <class Of, class Take>
    void column(Of&& of, Take&& take) const {
        using Value = std::decay_t<decltype(of(rods_, std::uint32_t{0}))>;
        std::size_t sent = 0;
        for (const Slice& slice : slices_) {
            std::vector<std::vector<Value>> to(static_cast<std::size_t>(ranks_.count()));
            to[0].reserve(slice.own);
            for (const std::size_t end = sent + slice.own; sent < end; ++sent) to[0].push_back(of(rods_, own_[sent]));
            const auto arrived = ranks_.deal(to);
            if (ranks_.rank() == 0) take(std::span<const Value>(merged(arrived, slice)));
        }
    }

    /// All ids, or all that there is of the rods, for the first rank; none for the others.
    std::vector<std::uint64_t> ids() const;
    Rods whole() const;

private:
    struct Slice {
        std::size_t own;                  ///< rods of this rank in it
        std::vector<std::uint32_t> from;  ///< the rank of each; none for the others, or where there is one rank
    };

    template <class Value>
    static std::vector<Value> merged(const std::vector<std::vector<Value>>& arrived, const Slice& slice) {
        if (arrived.size() == 1) return arrived.front();
        std::vector<Value> values;
        values.reserve(slice.from.size());
        std::vector<std::size_t> next(arrived.size(), 0);
        for (const std::uint32_t rank : slice.from) values.push_back(arrived[rank][next[rank]++]);
        return values;
    }
    Slice next_slice(std::size_t& sent, std::size_t part, bool& is_last) const;

    const Rods& rods_;
    Ranks ranks_;
    std::vector<std::uint32_t> own_;  ///< rows of this rank's rods, in the order of ids
    std::vector<Slice> slices_;
    std::size_t size_ = 0;
    bool have_cycle_, have_speed_;
};

}  // namespace jostle
