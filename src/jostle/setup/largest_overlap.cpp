#include "jostle/setup/largest_overlap.hpp"

#include "jostle/contact/find_contacts.hpp"

namespace jostle {

double largest_overlap(const Rods& rods, const Box& box) {
    const std::vector<double> no_range(rods.size(), 0.0);
    NeighbourList neighbours(0.0);
    neighbours.update(rods, box, no_range);
    Contacts contacts;
    return find_contacts(rods, box, neighbours, no_range, contacts);
}

}  // namespace jostle
