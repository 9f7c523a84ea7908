#pragma once

#include <cstdint>
#include <vector>

#include "jostle/contact/collision_search.hpp"
#include "jostle/contact/fixed_rod_grid.hpp"
#include "jostle/contact/found_contacts.hpp"

namespace jostle {

/// Finds the contacts of rods with the fixed rods of their box (theory, section 6), as `CollisionSearch` finds those of
/// rods with each other. The result depends on the rods alone.
class FixedRodSearch {
public:
    /// Appends the contacts of the step. Returns the largest overlap with a fixed rod before the known motion,
    /// max(0, -gap).
    double find(const StepGeometry& step, Contacts& contacts);

    /// The pairs that are no contacts but touch at the end of the step, as contacts, which the caller adds to those of
    /// the step.
    Contacts violated(const StepGeometry& step, const EndConfiguration& end);

private:
    struct Known {
        std::uint32_t row, number;
        Image image;
        auto operator<=>(const Known&) const = default;
    };

    void search(std::uint32_t row, const StepGeometry& step, FoundContacts& found) const;
    void search_again(std::uint32_t row, double farthest, const StepGeometry& step, const EndConfiguration& end,
                      Contacts& found) const;
    void append(const FixedCopy& copy, std::uint32_t row, const PairGeometry& before, const NearestPoints& nearest,
                const PairGeometry& after, const StepGeometry& step, Contacts& contacts) const;
    void remember(const Contacts& contacts, std::size_t first);

    FixedRodGrid grid_;
    std::vector<double> interaction_range_;  ///< (N)
    std::vector<Known> known_;               ///< pairs that are contacts of this step, ascending
    std::vector<FoundContacts> blocks_;
};

/// Appends the contacts of rods with the fixed rods of their box whose gap is below the rod's range. `range`: (N).
/// Returns the largest overlap with a fixed rod, max(0, -gap).
double append_fixed_rod_contacts(const Rods& rods, const Box& box, std::span<const double> range, Contacts& contacts);

/// How far a rod of this length and diameter reaches into fixed rods, at most; negative: it touches none. -infinity
/// where none is near. `grid`: of a range that covers the rod.
double overlap_with_fixed_rods(const FixedRodGrid& grid, const Vec3& centre, const Vec3& axis, double length,
                               double diameter);

inline double overlap_with_fixed_rods(const FixedRodGrid& grid, const Rods& rods, std::size_t row) {
    return overlap_with_fixed_rods(grid, rods.centre[row], rods.axis[row], rods.length[row], rods.diameter[row]);
}

/// Those of `contacts` with fixed rods that overlap by more than `max_overlap` where contact forces take their rods, as
/// they are there (relinearised_contacts.hpp).
Contacts relinearised_fixed_rod_contacts(const Contacts& contacts, const Box& box, const EndConfiguration& end,
                                         double max_overlap);

}  // namespace jostle
