#pragma once

#include <span>
#include <vector>

#include "jostle/contact/previous_force.hpp"

namespace jostle {

// Where the solver begins, with a warm start: at the contact forces of the step before. Crowds that are pushed
// steadily, as by growth, carry nearly the same forces from step to step; sweeps from zero have to carry them through
// the whole crowd every time. The result is the same within the tolerance.

/// The forces of a step, of contacts that have one. `gamma`: (contacts); `ids`: (N) of the rows.
std::vector<PreviousForce> previous_forces(const Contacts& contacts, std::span<const double> gamma,
                                           std::span<const std::uint64_t> ids);

/// A force for each contact: that of the same feature of the same two rods in the step before, or 0; of a pair that
/// touched in several images, the largest. Empty if there were none.
std::vector<double> starting_forces(const Contacts& contacts, std::span<const std::uint64_t> ids,
                                    std::span<const PreviousForce> previous);

/// Whether so many forces push that it pays to find contacts early, and to sweep with momentum (decision 0053).
constexpr bool is_crowd(std::size_t forces) {
    return forces >= 25000;
}
}  // namespace jostle
