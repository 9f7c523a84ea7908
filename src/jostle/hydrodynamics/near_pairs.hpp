#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/contacts.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/rods/box.hpp"

namespace jostle {

/// The pairs of rods of a near field, those whose blobs may be nearer than a cutoff, and how each rod finds its own, in
/// the order of the other rods' ids.
class NearPairs {
public:
    /// Of rods where they are now.
    void find(const Rods& rods, const Box& box, const RodBlobs& blobs, double cutoff);

    std::span<const PairKey> pairs() const { return pairs_; }  ///< the smaller id first
    /// (N + 1) Where the sides of each row begin.
    std::span<const std::size_t> begin() const { return begin_; }
    /// (2 pairs) Of each row: 2 p where it is the first of pair p, 2 p + 1 where it is the second.
    std::span<const std::uint32_t> sides() const { return sides_; }
    /// (2 pairs) The row of the other rod.
    std::span<const std::uint32_t> others() const { return others_; }

private:
    void find_in_periodic_box(const Rods& rods, const Box& box, const RodBlobs& blobs, double cutoff);
    void list_sides(const Rods& rods);

    std::vector<PairKey> pairs_;
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> sides_, others_;
};

}  // namespace jostle
