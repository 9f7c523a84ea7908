#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/cell_grid.hpp"
#include "jostle/contact/fixed_rod_search.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/wall.hpp"
#include "jostle/setup/cell_domains.hpp"
#include "jostle/setup/movable_cells.hpp"

namespace jostle {

/// Metropolis Monte Carlo of rods that may overlap, at a price in kT for every pair that does.
///
/// At a price of a few kT rods are nearly as hard ones are, yet get past each other, which long hard ones in a crowd do
/// not (docs/decisions/0029-annealed-starts.md). They are moved by small steps, and put down anywhere near by. An open
/// box holds their centres like walls, and walls hold the rods. The same bits for any number of threads, and of ranks:
/// each moves the rods of some domains, and tells the others, so that all have all rods.
class MonteCarlo {
public:
    /// `rods` (all that moves; the same on all ranks) and `box` must outlive this.
    MonteCarlo(Rods& rods, const Box& box, std::uint64_t seed, const Ranks& ranks = {});

    /// How many moves were tried, and how many were made.
    struct Moves {
        std::uint64_t placings = 0, placed = 0;  ///< anywhere in the domain, in any direction
        std::uint64_t shifts = 0, shifted = 0;   ///< by a small step
        Moves& operator+=(const Moves& other);
    };

    /// Tries to put every rod down elsewhere, `placings` times, and to shift it, once. `price`: > 0.
    Moves sweep(double price, int placings);

    /// Rods that overlap another, or their own image.
    std::size_t overlapping_rods() const;

private:
    struct Trial {
        Vec3 centre, axis;
    };
    /// A rod that was moved, and a change of the number of overlaps of one, as other ranks are told.
    struct Moved {
        std::uint32_t row;
        Vec3 centre, axis;
    };
    struct Counted {
        std::uint32_t row;
        std::int32_t change;
    };
    /// What has happened in a domain.
    struct Changes {
        Moves moves;
        std::vector<Moved> moved;      ///< in this order; none where there are no other ranks
        std::vector<Counted> counted;  ///< likewise
    };
    /// What one thread works on.
    struct Site {
        const CellDomains& domains;
        std::size_t domain;
        double price;
        std::vector<std::uint32_t> partners;  ///< that the rod at hand would overlap
        Changes changes;
    };

    void count_overlaps();
    Changes move_rods_of(Site site, std::span<const std::uint32_t> rows, int placings);
    void tell_others(std::span<const Changes> changes);
    void put(std::uint32_t row, const Vec3& centre, const Vec3& axis);
    void add_overlaps(std::uint32_t row, std::int32_t change, Site& site);
    Trial placing(std::uint32_t row, std::uint32_t draw, const Site& site) const;
    Trial shift(std::uint32_t row, std::uint32_t draw) const;
    bool leads_out(std::uint32_t row, const Trial& trial, const Site& site) const;
    bool try_out(std::uint32_t row, Trial trial, double uniform, Site& site);
    bool find_partners(std::uint32_t row, const Trial& trial, std::size_t most,
                       std::vector<std::uint32_t>& partners) const;
    bool touches(std::uint32_t row, std::uint32_t other, const Trial& trial, const Vec3& displacement) const;
    std::size_t own_images(std::uint32_t row, const Vec3& axis) const;

    Rods& rods_;
    const Box& box_;
    std::uint64_t seed_, sweeps_ = 0;
    Ranks ranks_;
    std::vector<Wall> walls_;
    FixedRodGrid fixed_;
    CellGrid grid_;
    MovableCells cells_;
    std::vector<std::uint32_t> overlaps_;  ///< (N) pairs that a rod overlaps in
};

}  // namespace jostle
