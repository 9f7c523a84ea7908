#pragma once

#include "bindings/arrays.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle::python {

/// The rods at one time, in the order of their ids; never changes.
///
/// Python sees rods through read-only arrays on the memory of such an object, which they keep alive. The simulation's
/// own arrays change places at every step, their rows now and then, and their number where cells divide: no array could
/// be a view on them (decision 0021).
class RodsInOrder {
public:
    explicit RodsInOrder(const Rods& rods);

    const Rods& rods() const { return rods_; }

    /// Row of the simulation that row k here was taken from.
    std::span<const std::uint32_t> order() const { return order_; }

private:
    std::vector<std::uint32_t> order_;
    Rods rods_;
};

}  // namespace jostle::python
