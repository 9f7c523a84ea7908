#include "jostle/simulation/simulation.hpp"

#include <algorithm>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/simulation/time_step_correction.hpp"

namespace jostle {

namespace {

/// How far rods go before the neighbour list is built again: longer lists against more building (docs/performance.md).
double neighbour_travel(const Rods& rods) {
    if (rods.size() == 0) return 1.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) sum += 0.5 * rods.diameter[i] + 0.1 * rods.length[i];
    return sum / static_cast<double>(rods.size());
}

}  // namespace

Simulation::Simulation(Box box, Rods rods, Clock clock, std::unique_ptr<Mobility> mobility,
                       std::vector<std::unique_ptr<Motion>> motions, const SimulationSettings& settings)
    : box_(box),
      rods_(std::move(rods)),
      clock_(clock),
      mobility_(std::move(mobility)),
      motions_(std::move(motions)),
      settings_(settings),
      shift_reach_(rods_.size(), 0.0),
      neighbours_(neighbour_travel(rods_)),
      reach_(rods_.size(), 0.0),
      known_(rods_.size()) {
    if (!(settings_.time_step > 0.0))
        throw InputError({.key = "time.step",
                          .value = std::to_string(settings_.time_step),
                          .problem = "the time step must be positive"});
    mobility_->update(rods_);
    solution_.forces.resize(rods_.size());
    solution_.velocities.resize(rods_.size());
    if (!settings_.brownian_correction) return;
    for (std::size_t i = 0; i < rods_.size(); ++i) {
        // sqrt(a + b) <= sqrt(a) + sqrt(b): each rod's part of A_ll bounds its part of the shift.
        const RodMobility rod = mobility_->of_rod(i);
        const double half = 0.5 * rods_.length[i];
        const double largest = std::max(rod.parallel, rod.perpendicular) + half * half * rod.rotational;
        shift_reach_[i] = brownian_shift(settings_.kT, settings_.time_step, largest);
    }
}

}  // namespace jostle
