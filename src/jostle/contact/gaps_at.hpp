#pragma once

#include <vector>

#include "jostle/contact/end_configuration.hpp"

namespace jostle {

/// The gaps of contacts with their rods in another configuration: those of the points that each contact follows.
/// (contacts) lengths.
std::vector<double> gaps_at(const Contacts& contacts, const Box& box, const EndConfiguration& there);

}  // namespace jostle
