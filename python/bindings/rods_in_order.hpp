#pragma once

#include "bindings/arrays.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle::python {

/// The rods at one time, in the order of their ids; never changes.
///
/// Python sees rods through read-only arrays on the memory of such an object, which they keep alive. The simulation's
/// own arrays change places at every step, their rows now and then, and their number where cells divide: no array could
/// be a view on them (decision 0021).
class RodsInOrder {
public:
    explicit RodsInOrder(const Rods& rods) : rods_(in_order_of_ids(rods)) {}

    const Rods& rods() const { return rods_; }

private:
    Rods rods_;
};

}  // namespace jostle::python
