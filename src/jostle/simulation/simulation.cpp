#include "jostle/simulation/simulation.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/contact/time_step_correction.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle {

namespace {

// Lengths in mean diameters, chosen by the time of a step: they change speed, and results within the tolerance.

/// A pair whose gap after the known motion is wider than touching by this much is inactive.
constexpr double activation_margin_per_diameter = 0.02;
/// How far rods go before the neighbour list is built again: this at the default step, less at shorter ones (the
/// shorter the step, the less often lists are built).
constexpr double skin_per_diameter = 0.5, skin_per_length = 0.13, displacement_at_default_step = 0.07;
/// Up to so many times as far at longer steps, where fewer than a crowd fill a volume of (L + D)^3: it is rods more
/// than pairs that a list costs time for then.
constexpr double crowd = 3.0, max_skin_when_dilute = 2.0;
/// How far forces may displace rods before all their neighbours are looked at: at most so far, and so many mean
/// Brownian displacements, for these bring rods together. Without noise displacements add up through crowds.
constexpr double max_displacement_limit = 0.2, limit_per_displacement = 3.0;

double mean_of(const std::vector<double>& values) {
    if (values.empty()) return 1.0;
    return parallel_sum<double>(values.size(), [&](std::size_t i) { return values[i]; }) /
           static_cast<double>(values.size());
}

}  // namespace

Simulation::Simulation(Box box, Rods rods, Clock clock, std::unique_ptr<Mobility> mobility,
                       std::vector<std::unique_ptr<Motion>> motions, const SimulationSettings& settings,
                       std::vector<Spring> springs, std::vector<LastForce> last_forces)
    : box_(box),
      rods_(std::move(rods)),
      clock_(clock),
      mobility_(std::move(mobility)),
      motions_(std::move(motions)),
      settings_(settings),
      warm_start_(std::move(last_forces)) {
    if (!(settings_.time_step > 0.0))
        throw InputError({.key = "time.step",
                          .value = std::to_string(settings_.time_step),
                          .problem = "the time step must be positive"});
    if (!springs.empty()) add_springs(std::move(springs));
    if (settings_.growth) {
        growth_.emplace(*settings_.growth, settings_.seed);
        if (rods_.cycle.empty()) growth_->found(rods_);
    }
    take_over_rods();
}

void Simulation::add_springs(std::vector<Spring> springs) {
    if (settings_.growth)
        throw InputError({.key = "springs.file",
                          .problem = "springs hold rods that stay, and cells divide and die",
                          .suggestion = "Remove [springs] or [growth]"});
    springs_.emplace(std::move(springs));
}

/// Makes everything that belongs to rows anew.
void Simulation::take_over_rods() {
    search_.invalidate();
    known_.velocity.resize(rods_.size());
    known_.end.resize(rods_.size());
    known_.displacement.resize(rods_.size());
    find_sizes();
}

void Simulation::find_search_ranges() {
    auto& [displacement_limit, skin, activation_margin, range] = ranges_;
    activation_margin = activation_margin_per_diameter * mean_diameter_;
    displacement_limit = max_displacement_limit * mean_diameter_;
    skin = skin_per_diameter * mean_diameter_ + skin_per_length * mean_length_;
    if (settings_.kT == 0.0) return;
    const double displacement = mean_of(known_.displacement);
    // Not below half the margin: the neighbour list must hold every pair that may come within it.
    displacement_limit = std::clamp(limit_per_displacement * displacement, 0.5 * activation_margin, displacement_limit);
    double max_skin = 1.0;
    if (box_.is_periodic()) {  // in an open one the volume does not tell how near rods are to each other
        const double near =
            static_cast<double>(rods_.size()) * std::pow(mean_length_ + mean_diameter_, 3.0) / box_.volume();
        max_skin = std::clamp(std::sqrt(crowd / near), 1.0, max_skin_when_dilute);
    }
    skin *= std::min(max_skin, std::pow(displacement / (displacement_at_default_step * mean_diameter_), 2.0 / 3.0));
}

/// What follows from the sizes of the rods alone: these change where cells grow.
void Simulation::find_sizes() {
    sizes_changed_ = true;
    mean_diameter_ = mean_of(rods_.diameter);
    mean_length_ = mean_of(rods_.length);
    ranges_.range = settings_.range;
    if (settings_.wca_energy > 0.0)
        ranges_.range =
            (wca_range - 1.0) * parallel_max(rods_.size(), 0.0, [this](std::size_t i) { return rods_.diameter[i]; });
}

/// M as the step begins, and each rod's part in the shift of a gap, which depends on sizes alone.
void Simulation::find_mobility() {
    mobility_at_start_ = mobility_->at(rods_, box_);
    if (!sizes_changed_) return;
    sizes_changed_ = false;
    largest_shift_.assign(rods_.size(), 0.0);
    if (!settings_.brownian_correction) return;
    own_mobility_.resize(rods_.size());
    parallel_for(rods_.size(), [&](std::size_t i) {
        const RodMobility rod = own_mobility_[i] = mobility_at_start_->of_rod(i);
        const double half = 0.5 * rods_.length[i];
        const double largest = std::max(rod.parallel, rod.perpendicular) + half * half * rod.rotational;
        largest_shift_[i] = brownian_shift(settings_.kT, settings_.time_step, largest);
    });
}

/// Now and then: rods near each other in space come near each other in memory.
void Simulation::renumber() {
    constexpr std::uint64_t every = 512;
    if (reordered_ && clock_.step % every != 0) return;
    reorder(space_filling_order(rods_, box_));
    reordered_ = true;
}

void Simulation::reorder(std::span<const std::uint32_t> order) {
    if (ids_before_.empty()) ids_before_ = rods_.id;  // of the last step's contacts
    rods_ = reordered(rods_, order);
    take_over_rods();
}

}  // namespace jostle
