#include "jostle/rods/rods.hpp"

#include <numbers>

namespace jostle {

double rod_volume(double length, double diameter) {
    return std::numbers::pi * diameter * diameter * (length / 4.0 + diameter / 6.0);
}

double total_volume(const Rods& rods) {
    double volume = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) volume += rod_volume(rods.length[i], rods.diameter[i]);
    return volume;
}

}  // namespace jostle
