#pragma once

#include <cstddef>
#include <span>

namespace jostle {

/// A square matrix known only by what it does to a vector.
class LinearOperator {
public:
    virtual ~LinearOperator() = default;
    virtual std::size_t size() const = 0;

    /// result = A x. Both have `size()` elements and do not overlap.
    virtual void apply(std::span<const double> x, std::span<double> result) const = 0;

    /// The diagonal A_ll, `size()` elements: positive, or 0 where a force moves nothing (a sphere and its own image).
    virtual std::span<const double> diagonal() const = 0;
};

}  // namespace jostle
