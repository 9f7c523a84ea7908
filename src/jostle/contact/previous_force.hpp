#pragma once

#include <tuple>

#include "jostle/contact/contacts.hpp"

namespace jostle {

/// A contact force of the step before, by ids: part of the state where steps begin from them.
struct PreviousForce {
    std::uint64_t i = 0, j = 0;  ///< ids (`id_of_body`), of two rods i <= j
    ContactFeature feature = ContactFeature::nearest;
    bool upper = false;  ///< of an end: that to which the axis points
    double gamma = 0.0;  ///< > 0

    bool operator==(const PreviousForce&) const = default;
};

/// What tells one from another.
inline auto key_of(const PreviousForce& force) {
    return std::tuple(force.i, force.j, force.feature, force.upper);
}

}  // namespace jostle
