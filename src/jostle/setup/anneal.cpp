#include "jostle/setup/anneal.hpp"

#include <algorithm>
#include <exception>
#include <span>
#include <vector>

#include "jostle/mobility/drag_mobility.hpp"
#include "jostle/motion/brownian_motion.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/setup/monte_carlo.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/statistics/drift.hpp"
#include "jostle/statistics/order_parameter.hpp"

namespace jostle {

namespace {

// Monte Carlo (docs/decisions/0029-annealed-starts.md).

/// Tries to put a rod down elsewhere in a sweep: they cost less than one shift.
constexpr int placings_a_sweep = 4;
/// The price in kT at which it is over: few pairs overlap any more, and hardly any rod can be put down elsewhere.
constexpr double last_price = 8.0;
/// The price rises as fast as rods forget where they were: by so much when all have been put down elsewhere once, and
/// by no less in a sweep.
constexpr double rise_as_all_are_placed = 0.5, least_rise = 0.02;
/// It is over earlier, too, once fewer rods than this overlap.
constexpr double few_overlaps = 0.01;

// Brownian steps, in diameters of the thinnest rod. The first are uncorrected: rods
// just pushed apart have nowhere to be thrown to.

struct Stretch {
    int steps;
    double rms;
    bool corrected;
};
constexpr Stretch loosening = {100, 0.15, false}, settling = {400, 0.1, true}, tightening = {100, 0.05, true};
/// Of the contact problems, in D.
constexpr double contact_tolerance = 1e-3;

/// Rods shorter than thick get past each other as spheres do.
bool hinder_each_other(const Rods& rods) {
    for (std::size_t i = 0; i < rods.size(); ++i)
        if (rods.length[i] >= rods.diameter[i]) return true;
    return false;
}

class Annealer {
public:
    Annealer(Rods& rods, const Box& box, std::uint64_t seed, const AnnealingWatch& watch, const Ranks& ranks)
        : rods_(rods), box_(box), seed_(seed), watch_(watch), ranks_(ranks) {}

    OverlapRemovalResult anneal() {
        put_in_order();
        if (hinder_each_other(rods_)) let_overlap();
        OverlapRemovalResult result = remove_overlaps(rods_, box_, mobility_);
        if (!result.apart) return result;
        shake(loosening);
        settle();
        shake(tightening);
        done_.Z = mean(Z_);
        done_.order = mean(order_);
        tell();
        return remove_overlaps(rods_, box_, mobility_);
    }

private:
    void put_in_order() { rods_ = reordered(rods_, space_filling_order(rods_, box_)); }

    void let_overlap() {
        MonteCarlo rods(rods_, box_, seed_, ranks_);
        const double enough = few_overlaps * static_cast<double>(rods_.size());
        double share_placed = 1.0;
        for (double price = 0.0; price < last_price;) {
            price += std::max(rise_as_all_are_placed * share_placed, least_rise);
            const MonteCarlo::Moves moves = rods.sweep(price, placings_a_sweep);
            share_placed = static_cast<double>(moves.placed) / static_cast<double>(moves.placings);
            ++done_.sweeps;
            tell();
            if (static_cast<double>(rods.overlapping_rods()) <= enough) return;
        }
    }

    /// Twice as many steps as so far, again and again, until the last half of them shows no drift.
    void settle() {
        shake(settling);
        if (Z_.size() < static_cast<std::size_t>(settling.steps)) return;
        std::vector<double> Z = Z_, order = order_;
        const auto drifts = [](std::span<const double> series) {
            return drift(series.last(series.size() / 2)).is_significant();
        };
        while (!(done_.settled = !drifts(Z) && !drifts(order)) && static_cast<int>(Z.size()) < max_annealing_steps) {
            shake({static_cast<int>(Z.size()), settling.rms, settling.corrected});
            if (Z_.empty()) return;
            Z.insert(Z.end(), Z_.begin(), Z_.end());
            order.insert(order.end(), order_.begin(), order_.end());
        }
    }

    /// Brownian steps, or fewer if one cannot be solved, and Z and S of each.
    void shake(const Stretch& stretch) {
        Z_.clear();
        order_.clear();
        Simulation simulation = brownian(stretch);
        simulation.share(ranks_);
        for (int k = 0; k < stretch.steps; ++k) {
            const StepReport report = simulation.step();
            if (report.status != LcpStatus::converged) break;
            Z_.push_back(1.0 +
                         trace(report.collision_virial) / (box_.dimensions() * static_cast<double>(rods_.size())));
            order_.push_back(order_of(simulation));
            ++done_.steps;
            tell();
        }
        rods_ = ranks_.alone() ? simulation.rods() : simulation.rods_of_all_ranks();
        if (!ranks_.alone()) put_in_order();
        if (!Z_.empty()) remove_overlaps(rods_, box_, mobility_);
    }

    Simulation brownian(const Stretch& stretch) const {
        const double thinnest = *std::min_element(rods_.diameter.begin(), rods_.diameter.end());
        const double rms = stretch.rms * thinnest;
        SimulationSettings settings;
        settings.seed = seed_;
        settings.kT = 1.0;
        settings.time_step = 0.5 * rms * rms;  // unit mobility and kT: rms step sqrt(2 dt)
        settings.brownian_correction = stretch.corrected;
        settings.lcp.tolerance = contact_tolerance * thinnest;
        settings.lcp.max_iterations = 1000;
        std::vector<std::unique_ptr<Motion>> motions;
        motions.push_back(std::make_unique<BrownianMotion>(settings.kT, box_.dimensions()));
        // Random numbers of its own, far from those of the run.
        const Clock clock{(std::uint64_t{1} << 39) + static_cast<std::uint64_t>(done_.steps), 0.0};
        return Simulation({box_, rods_, clock}, std::make_unique<DragMobility>(overlap_removal_drag(true)),
                          std::move(motions), settings);
    }

    double order_of(const Simulation& simulation) const {
        const std::vector<Vec3>& axes = simulation.rods().axis;
        const Mat3 sum = sum_over_ranks<Mat3>(ranks_, simulation.domain().owned_of(axes.size()),
                                              [&](std::size_t i) { return outer(axes[i], axes[i]); });
        return nematic_order(sum, rods_.size(), box_.dimensions()).order;
    }

    static double mean(std::span<const double> values) {
        double sum = 0.0;
        for (const double value : values) sum += value;
        return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
    }

    /// All ranks stop where the watch of one does.
    void tell() const {
        std::exception_ptr stop;
        try {
            if (watch_) watch_(done_);
        } catch (...) {
            stop = std::current_exception();
        }
        if (!ranks_.any(stop != nullptr)) return;
        if (stop) std::rethrow_exception(stop);
        throw StoppedElsewhere();
    }

    Rods& rods_;
    const Box& box_;
    std::uint64_t seed_;
    const AnnealingWatch& watch_;
    Ranks ranks_;
    DragMobility mobility_{overlap_removal_drag(true)};
    Annealing done_;
    std::vector<double> Z_, order_;  ///< of the last stretch, step by step
};

}  // namespace

OverlapRemovalResult anneal(Rods& rods, const Box& box, std::uint64_t seed, const AnnealingWatch& watch,
                            const Ranks& ranks) {
    return Annealer(rods, box, seed, watch, ranks).anneal();
}

}  // namespace jostle
