#pragma once

#include <functional>
#include <stdexcept>

#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/setup/remove_overlaps.hpp"

namespace jostle {

/// How a random start has been brought near to equilibrium, so far.
struct Annealing {
    int sweeps = 0;        ///< of Monte Carlo with rods that may overlap at a price
    int steps = 0;         ///< large Brownian ones
    bool settled = false;  ///< neither Z nor S drifted over the last half of the steps of 0.1 D
    double Z = 0.0;        ///< means over the last steps of 0.05 D ...
    double order = 0.0;    ///< ... of Z and S: what the run starts with

    bool was_needed() const { return steps > 0; }
};

/// At most so many Brownian steps of 0.1 D; then it is over, settled or not.
inline constexpr int max_annealing_steps = 1600;

/// Is called between sweeps and steps, with what has been done. May throw, to stop.
using AnnealingWatch = std::function<void(const Annealing&)>;

/// What is thrown on the other ranks where the watch of one has stopped.
struct StoppedElsewhere : std::runtime_error {
    StoppedElsewhere() : std::runtime_error("another rank has stopped") {}
};

/// Brings rods at random places, overlapping or not, near to equilibrium as hard rods, at whatever places and
/// directions they come out.
///
/// 1. Long rods: Monte Carlo in which they may overlap, at a price that rises from 0 to 8 kT a pair. So they find
///    neighbours and directions as in equilibrium, for which hard ones in a crowd have to wait until they have turned.
/// 2. What overlaps then is pushed apart by contact forces.
/// 3. Brownian steps of 0.15 D without the time-step correction, of 0.1 D with it, 400 or more, until neither Z nor S
///    drifts, and of 0.05 D, as contacts of a run are.
/// Lengths of steps are in diameters of the thinnest rod. If rods stay overlapping, the result says so. Ids and sizes
/// are kept, rows are not. The same bits for any number of threads, and of ranks: these begin with the same rods, share
/// the work of Monte Carlo and of the Brownian steps, and have all rods in the end.
OverlapRemovalResult anneal(Rods& rods, const Box& box, std::uint64_t seed, const AnnealingWatch& watch,
                            const Ranks& ranks = {});

}  // namespace jostle
