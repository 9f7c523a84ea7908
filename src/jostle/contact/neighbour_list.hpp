#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/pair_contacts.hpp"
#include "jostle/math/marked_numbers.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// Verlet list with a skin over a cell list, for any box: periodic, open, or thinner than a rod is long.
///
/// After `update(rods, box, ranges)` the list holds every pair (i, j, image) whose gap is below range_i + range_j,
/// where a rod and its own image are a pair too. It is built anew only when some rod has moved so far since the last
/// time that this could fail: if no point of rod i has moved by more than d_i, pairs with gap < range of the list at
/// building time suffice as long as d_i + range_i <= half that range for all i.
class NeighbourList {
public:
    /// `skin`: how far a rod may go, beyond its range, before the list is built again (a length).
    explicit NeighbourList(double skin) : skin_(skin) {}
    void set_skin(double skin) { skin_ = skin; }

    /// Builds anew if need be; returns whether it did. `ranges`: (N), the share of each rod in the
    /// interaction range of a pair, lengths.
    bool update(const Rods& rods, const Box& box, std::span<const double> ranges) {
        is_widened_ = built_while_widened_ = false;
        lacking_range_ = 0.0;
        return refresh(rods, box, ranges);
    }

    /// A rod whose range grows.
    struct Widening {
        std::uint32_t row;
        double by;  ///< a length
    };

    /// After an `update`: lets some rods come farther. Returns whether the list reaches that far; if not, the next call
    /// has to be `widen_to`.
    bool widen(std::span<const Widening> farther);

    /// The same, to `ranges`, (N), and builds the list anew if need be.
    void widen_to(const Rods& rods, const Box& box, std::span<const double> ranges);

    /// By so much the range of a row may grow before the list does not reach that far, or 0.
    double spare_range(std::uint32_t row) const {
        return units_per_length_ > 0.0 ? std::max(farthest_extent() - extent_[row] - 2, 0) / units_per_length_ : 0.0;
    }

    // Where other ranks have rods, too, only those near by are known, and this only up to some gap. The list is then
    // built when it is told to be, by all ranks together, and holds the pairs of this rank's own rods.

    /// Builds the list, of gaps below `list_range`, of pairs with at least one of the first `own` rods. From now on
    /// `update` and `widen_to` do not build it; the caller has to ask whether it covers what they need.
    void build_of_own(const Rods& rods, const Box& box, double list_range, std::size_t own);

    /// Whether `update` would not have to build it.
    bool covers(const Rods& rods, const Box& box, std::span<const double> ranges) {
        extent_.resize(rods.size());
        crossed_.resize(rods.size());
        return reference_.centre.size() == rods.size() && find_extents(rods, box, ranges) <= 0.5 * list_range_;
    }

    /// The largest range that the last `widen_to` asked for and the list does not cover; 0 if there is none.
    double lacking_range() const { return lacking_range_; }

    /// The rows that have a pair, and all of the first `own`.
    std::vector<std::uint32_t> rows_with_pairs(std::size_t own) const;

    /// Leaves out all rows but these, ascending, which have all pairs.
    void keep(std::span<const std::uint32_t> rows);

    /// To be told where the box is stretched, and all centres with it: gaps of the pairs that count change little.
    void stretch(const Vec3& by);

    /// To be told where the box is sheared, and all centres with it: x by `strain` y. `copies`: by so many the copies
    /// above have other numbers along x than before, where another copy is now the nearest.
    void shear(double strain, std::int32_t copies);

    /// Forces building at the next update (rods were added, removed or renumbered).
    void invalidate() { reference_.centre.clear(); }

    /// Number of pairs, in the order of (i, j, image); i <= j. There are many, so each takes eight bytes, and the list
    /// holds no i: it is told with the number of a pair.
    std::size_t size() const { return j_.size(); }

    /// A pair of row i, in its image at the last update: rods that have crossed a periodic face since building are
    /// accounted for.
    PairKey key(std::uint32_t i, std::size_t pair) const {
        PairKey now{i, j_[pair], images_[image_[pair]]};
        for (std::size_t k = 0; k < 3; ++k) now.image[k] += crossed_[now.j][k] - crossed_[i][k];
        return now;
    }

    static constexpr std::size_t block_size = 512;
    std::size_t block_count() const { return (size() + block_size - 1) / block_size; }

    /// Calls found(i, pair) for the pairs of a block, in order, whose gap may be below the ranges given to the last
    /// update; once the list is widened, for those alone that were not named before. Most pairs of the list are passed
    /// over by what they were when the list was built.
    template <class Found>
    void for_close_pairs(std::size_t block, Found&& found) const {
        InBlock pairs;
        for (const std::uint16_t k : find_close_pairs(block, pairs)) found(pairs.i[k], block * block_size + k);
    }

    /// Calls found(i, pair) for those of one row, i or j. After `widen`, unless the list was built anew since.
    template <class Found>
    void for_close_pairs_of(std::uint32_t row, Found&& found) const {
        const auto look = [&](std::uint32_t i, std::size_t pair) {
            const std::uint32_t j = j_[pair];
            if (extent_[i] + extent_[j] >= gap_[pair] && former_extent_[i] + former_extent_[j] < gap_[pair])
                found(i, pair);
        };
        for (std::size_t pair = begin_[row]; pair < begin_[row + 1]; ++pair) look(row, pair);
        for (std::size_t k = partner_begin_[row]; k < partner_begin_[row + 1]; ++k)
            look(partner_of_[k].i, begin_[partner_of_[k].i] + partner_of_[k].in_row);
    }

    /// Whether widening has built the list anew, so that pairs have other numbers than after the last update.
    bool built_while_widened() const { return built_while_widened_; }

private:
    bool refresh(const Rods& rods, const Box& box, std::span<const double> ranges);
    double find_extents(const Rods& rods, const Box& box, std::span<const double> ranges);
    std::int32_t in_units(double extent) const;
    std::int32_t farthest_extent() const { return in_units(0.5 * list_range_); }  ///< rounded up, as all extents
    void build(const Rods& rods, const Box& box, double list_range, std::size_t own);
    void renumber_copies(std::int32_t copies);

    struct InBlock {
        std::array<std::uint32_t, block_size> i;
        MarkedNumbers<block_size> close;
    };
    std::span<const std::uint16_t> find_close_pairs(std::size_t block, InBlock& pairs) const;
    void list_partners();

    double skin_;
    double list_range_ = 0.0;
    double centre_range_ = 0.0;      ///< of centres, within which pairs were looked for
    double longest_ = 0.0;           ///< rod, without its caps
    double squeezed_ = 0.0;          ///< by so much gaps have changed since, at most, with the box alone
    double units_per_length_ = 0.0;  ///< gaps are kept in units of which 65535 are the range of the list
    struct Reference {
        std::vector<Vec3> centre, axis;
        std::vector<Image> image;
        std::vector<double> length;
    } reference_;                     ///< (N) the rods when the list was built
    std::vector<std::size_t> begin_;  ///< (N + 1) the first pair of each row
    std::vector<std::uint32_t> j_;
    std::vector<std::uint16_t> gap_;    ///< when the list was built, in units, rounded down; 0 if negative
    std::vector<std::uint16_t> image_;  ///< when the list was built: which of images_
    std::vector<Image> images_;
    std::vector<std::array<std::int16_t, 3>> crossed_;  ///< (N) box edges that a rod has crossed since
    std::vector<std::int32_t> extent_;                  ///< (N) d_i + range_i at the last update, in units, rounded up
    std::vector<std::int32_t> former_extent_;           ///< (N) before the list was widened last
    struct PairOfRow {
        std::uint32_t i, in_row;
    };
    std::vector<PairOfRow> partner_of_;       ///< (pairs) those in which a row is j, one row after the other
    std::vector<std::size_t> partner_begin_;  ///< (N + 1) the first of each row; none until needed
    bool is_widened_ = false;                 ///< since the last update, and not built since
    bool built_while_widened_ = false;
    bool is_of_own_rods_ = false;  ///< and not built but when told to
    double lacking_range_ = 0.0;
};

}  // namespace jostle
