#include "jostle/state/state.hpp"

#include <algorithm>
#include <tuple>

#include "jostle/rods/space_filling_order.hpp"

namespace jostle {

void sort_by_ids(std::vector<PreviousForce>& forces) {
    std::sort(forces.begin(), forces.end(), [](const PreviousForce& a, const PreviousForce& b) {
        return std::tuple(key_of(a), a.gamma) < std::tuple(key_of(b), b.gamma);
    });
}

State in_order_of_ids(const State& state) {
    State ordered = {state.box,     in_order_of_ids(state.rods), state.clock,
                     state.springs, state.previous_forces,       state.box_force};
    sort_by_ids(ordered.previous_forces);
    return ordered;
}

}  // namespace jostle
