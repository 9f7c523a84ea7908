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
/// A column is taken in slices, so that a rank needs the memory of one slice, and not of all rods: by the first rank,
/// or by all ranks in turns. All ranks make it, and call what it has, together.
class RodsInOrder {
public:
    enum class TakenBy { first_rank, all_ranks };
    /// `rods` must outlive it. `slice`: about how many rods a rank takes at a time.
    // NOLINTNEXTLINE(google-explicit-constructor): rods of one process are written as they are
    RodsInOrder(const Rods& rods, const Domain& domain = Domain::whole(), TakenBy taken_by = TakenBy::first_rank,
                std::size_t slice = std::size_t{1} << 20);

    /// How many all ranks have together.
    std::size_t size() const { return size_; }
    /// Whether rods have a cycle, or a speed of their own.
    bool have_cycle() const { return have_cycle_; }
    bool have_speed() const { return have_speed_; }
    int founder_bits() const { return rods_.founder_bits; }
    const Ranks& ranks() const { return ranks_; }
    /// Whether several ranks take slices.
    bool all_take() const { return at_once_ > 1; }

    /// Calls take(how many rods come before, span of values) for slice after slice at the rank that takes it. of(rods,
    /// row): the value of a rod.
    template <class Of, class Take>
    void column(Of&& of, Take&& take) const {
        using Value = std::decay_t<decltype(of(rods_, std::uint32_t{0}))>;
        deal(of, [&](std::size_t k, const std::vector<std::vector<Value>>& arrived) {
            take(slices_[k].before, std::span<const Value>(merged(arrived, slices_[k])));
        });
    }

    /// All ids, or all that there is of the rods, for the first rank, which has to be the one that takes them; none for
    /// the others.
    std::vector<std::uint64_t> ids() const;
    Rods whole() const;

private:
    struct Slice {
        std::size_t own;                  ///< rods of this rank in it
        std::vector<std::uint32_t> from;  ///< the rank of each, for who takes it; none where there is one rank
        std::size_t before = 0;           ///< rods of all ranks in the slices before it
    };

    /// Calls take(slice, what has come from each rank) for the slices that this rank takes.
    template <class Of, class Take>
    void deal(Of&& of, Take&& take) const {
        using Value = std::decay_t<decltype(of(rods_, std::uint32_t{0}))>;
        std::size_t sent = 0;
        for (std::size_t begin = 0; begin < slices_.size(); begin += at_once_) {
            std::vector<std::vector<Value>> to(static_cast<std::size_t>(ranks_.count()));
            const std::size_t end = std::min(begin + at_once_, slices_.size());
            for (std::size_t k = begin; k < end; ++k) {
                std::vector<Value>& values = to[k - begin];
                values.reserve(slices_[k].own);
                for (std::size_t left = slices_[k].own; left > 0; --left) values.push_back(of(rods_, own_[sent++]));
            }
            const auto arrived = ranks_.deal(to);
            if (const std::size_t k = begin + static_cast<std::size_t>(ranks_.rank()); k < end) take(k, arrived);
        }
    }

    template <class Value>
    static std::vector<Value> merged(const std::vector<std::vector<Value>>& arrived, const Slice& slice) {
        if (arrived.size() == 1) return arrived.front();
        std::vector<Value> values;
        values.reserve(slice.from.size());
        std::vector<std::size_t> next(arrived.size(), 0);
        for (const std::uint32_t rank : slice.from) values.push_back(arrived[rank][next[rank]++]);
        return values;
    }
    void divide_into_slices(std::size_t part);
    static std::vector<std::uint32_t> ranks_in_order(const std::vector<std::vector<std::uint64_t>>& ids_of_ranks);

    const Rods& rods_;
    Ranks ranks_;
    std::vector<std::uint32_t> own_;  ///< rows of this rank's rods, in the order of ids
    std::vector<Slice> slices_;
    std::size_t size_ = 0;
    std::size_t at_once_;  ///< slices, which as many ranks take
    bool have_cycle_, have_speed_;
};

}  // namespace jostle
