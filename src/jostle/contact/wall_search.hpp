#pragma once

#include <cstdint>
#include <vector>

#include "jostle/contact/collision_search.hpp"
#include "jostle/contact/found_contacts.hpp"
#include "jostle/rods/wall.hpp"

namespace jostle {

/// Finds the contacts of rods with the walls of their box: one for each end that comes near (theory, section 6).
///
/// A wall is cheaper to look at than to list who is near: every step looks at all rods, and every stop of the solver at
/// those that forces displace. The result depends on the rods alone.
class WallSearch {
public:
    /// Appends the contacts of the step. Returns the largest overlap with a wall before the known motion, max(0, -gap).
    double find(const StepGeometry& step, Contacts& contacts);

    /// The ends that are no contacts but touch a wall at the end of the step, as contacts, which the caller adds to
    /// those of the step.
    Contacts violated(const StepGeometry& step, const EndConfiguration& end);

private:
    void search(std::uint32_t row, const StepGeometry& step, FoundContacts& found);
    void search_again(std::uint32_t row, double farthest, const StepGeometry& step, const EndConfiguration& end,
                      Contacts& found);
    bool is_contact(std::uint32_t row, const Wall& wall, double arm) const {
        return (known_[row] >> bit_of(wall, arm) & 1U) != 0;
    }
    static unsigned bit_of(const Wall& wall, double arm) { return 2 * wall.number + (arm > 0.0 ? 1 : 0); }

    std::vector<Wall> walls_;
    std::vector<std::uint16_t> known_;  ///< (own rods) a bit for each end and wall that are a contact
    std::vector<double> gap_at_least_;  ///< (own rods) below that of either end from any wall, after the known motion
    std::vector<FoundContacts> blocks_;
};

}  // namespace jostle
