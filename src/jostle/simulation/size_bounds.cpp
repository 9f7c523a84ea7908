#include "jostle/simulation/size_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/contact/reflection.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/contact_problem/previous_forces.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"

namespace jostle {

namespace {

// Lengths in mean diameters, chosen by the instructions of a step (decision 0081): they change speed, and results
// within the tolerance.

/// A pair whose gap after the known motion is wider than touching by this much is inactive; crowds push
/// rods farther than noise would.
constexpr double activation_margin_per_diameter = 0.006, activation_margin_in_a_crowd = 0.04;
/// How far rods go before the neighbour list is built again: this where noise displaces them so far in a step, in the
/// mean, less at shorter steps (the shorter the step, the less often lists are built).
constexpr double skin_per_diameter = 0.5, skin_per_length = 0.13, displacement_with_that_skin = 0.12;
/// Up to so many times as far at longer steps, where fewer than a crowd fill a volume of (L + D)^3: it is rods more
/// than pairs that a list costs time for then.
constexpr double crowd = 3.0, max_skin_when_dilute = 2.0;
/// How far forces may displace rods before all their neighbours are looked at: at most so far, and so many mean
/// Brownian displacements, for these bring rods together. Without noise, and in crowds, displacements add up.
constexpr double max_displacement_limit = 0.2, limit_per_displacement = 2.0;

/// Over the rods of all ranks, so many.
double mean_of(const std::vector<double>& values, const Domain& domain, std::size_t rods) {
    if (rods == 0) return 1.0;
    return sum_over_ranks<double>(domain.ranks(), domain.owned_of(values.size()),
                                  [&](std::size_t i) { return values[i]; }) /
           static_cast<double>(rods);
}

/// How far the search for contacts looks in a step. `displacement`: by the known motion, in the mean.
SearchRanges search_ranges(const State& state, double displacement, const SizeBounds& sizes,
                           const SimulationSettings& settings, bool crowded) {
    const double mean_diameter = sizes.mean_diameter, mean_length = sizes.mean_length;
    SearchRanges ranges = {.displacement_limit = max_displacement_limit * mean_diameter,
                           .skin = skin_per_diameter * mean_diameter + skin_per_length * mean_length,
                           .activation_margin = activation_margin_per_diameter * mean_diameter,
                           .range = settings.rods_are_soft() ? (wca_range - 1.0) * sizes.max_diameter : settings.range};
    if (crowded) ranges.activation_margin = activation_margin_in_a_crowd * mean_diameter;
    if (settings.kT == 0.0 || crowded) return ranges;
    // Not below half the margin: the neighbour list must hold every pair that may come within it.
    ranges.displacement_limit =
        std::clamp(limit_per_displacement * displacement, 0.5 * ranges.activation_margin, ranges.displacement_limit);
    double max_skin = 1.0;
    if (state.box.is_periodic()) {  // in an open one the volume does not tell how near rods are to each other
        const double near = static_cast<double>(sizes.rods) *
                            std::pow(mean_length + mean_diameter, state.box.dimensions()) / state.box.volume();
        max_skin = std::clamp(std::sqrt(crowd / near), 1.0, max_skin_when_dilute);
    }
    ranges.skin *=
        std::min(max_skin, std::pow(displacement / (displacement_with_that_skin * mean_diameter), 2.0 / 3.0));
    return ranges;
}

}  // namespace

void find_size_bounds(const Rods& rods, const Domain& domain, const MobilityOperator& mobility,
                      const SimulationSettings& settings, SizeBounds& sizes) {
    const Ranks& ranks = domain.ranks();
    sizes.rods = static_cast<std::size_t>(ranks.sum(static_cast<std::int64_t>(domain.owned_of(rods.size()))));
    sizes.mean_diameter = mean_of(rods.diameter, domain, sizes.rods);
    sizes.mean_length = mean_of(rods.length, domain, sizes.rods);
    sizes.max_diameter = ranks.largest(parallel_max(rods.size(), 0.0, [&](std::size_t i) { return rods.diameter[i]; }));
    sizes.own_mobility.clear();
    if (!settings.corrects_brownian_motion()) return;
    sizes.own_mobility.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) { sizes.own_mobility[i] = mobility.of_rod(i); });
}

StepGeometry step_geometry(const State& state, const KnownMotion& known, const SizeBounds& sizes,
                           const SimulationSettings& settings, const Domain& domain, std::size_t previous_forces) {
    const double displacement = settings.kT > 0.0 ? mean_of(known.displacement, domain, sizes.rods) : 0.0;
    return {state.rods,
            state.box,
            known.end,
            known.displacement,
            search_ranges(state, displacement, sizes, settings, is_crowd(previous_forces)),
            settings.corrects_brownian_motion() ? normals_half_way : 0.0,
            settings.rods_are_soft(),
            domain.owned_of(state.rods.size()),
            displacement};
}

}  // namespace jostle
