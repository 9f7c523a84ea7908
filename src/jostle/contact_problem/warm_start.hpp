#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "jostle/contact/contacts.hpp"

namespace jostle {

/// A contact force of the last step: part of the state where steps begin from them.
struct LastForce {
    std::uint32_t i = 0, j = 0;  ///< rows, i <= j
    ContactFeature feature = ContactFeature::nearest;
    bool upper = false;  ///< of an end: that to which the axis points
    double gamma = 0.0;  ///< > 0

    bool operator==(const LastForce&) const = default;
};

/// Where the solver begins: at the contact forces of the last step.
///
/// Crowds that are pushed steadily, as by growth, carry nearly the same forces from step to step; sweeps from zero
/// have to carry them through the whole crowd every time. The result is the same within the tolerance.
class WarmStart {
public:
    explicit WarmStart(std::vector<LastForce> forces = {});

    /// Takes over the forces of a step, one a contact.
    void keep(const Contacts& contacts, std::span<const double> gamma);

    /// Row k of the rods has become new_row[k], or `no_row`: it is gone.
    void renumber(std::span<const std::uint32_t> new_row);
    static constexpr std::uint32_t no_row = std::numeric_limits<std::uint32_t>::max();

    /// A force a contact: that of the same feature of the same two rods in the last step, or 0. Empty if there were
    /// none.
    std::vector<double> guess(const Contacts& contacts) const;

    /// In the order of (i, j, feature, upper).
    const std::vector<LastForce>& forces() const { return forces_; }

private:
    std::vector<LastForce> forces_;
};

}  // namespace jostle
