#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/contacts.hpp"

namespace jostle {

/// A contact force of the last step: part of the state where steps begin from them.
struct LastForce {
    std::uint64_t i = 0, j = 0;  ///< ids, i <= j
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
    explicit WarmStart(std::vector<LastForce> forces = {}) : forces_(std::move(forces)) {}

    /// Takes over the forces of a step, one a contact; `ids`: of the rows.
    void keep(const Contacts& contacts, std::span<const double> gamma, std::span<const std::uint64_t> ids);

    /// A force a contact: that of the same feature of the same two rods in the last step, or 0; of a pair that touched
    /// in several images, the largest. Empty if there were none.
    std::vector<double> guess(const Contacts& contacts, std::span<const std::uint64_t> ids) const;

    /// In the order of (i, j, feature, upper, gamma).
    std::vector<LastForce> forces() const;

private:
    std::vector<LastForce> forces_;
};

}  // namespace jostle
