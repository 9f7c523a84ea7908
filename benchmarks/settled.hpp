#pragma once

#include <vector>

#include "jostle/simulation/simulation.hpp"

/// A state to measure: bodies of one length (in D) in a cubic periodic box.
struct Crowd {
    double length = 0.0;
    double volume_fraction = 0.0;
};

inline constexpr std::uint64_t crowd_count = 2000;  ///< bodies
inline constexpr double crowd_rms_step = 0.03;      ///< of a diameter
inline constexpr int settling_steps = 1000;         ///< after a random start, before anything is measured

/// The crowds of the benchmarks: rods L/D = 5 and spheres, at the volume fractions 0.05, 0.2 and 0.4.
std::vector<Crowd> all_crowds();

/// "rods/0.20" or "spheres/0.20".
std::string name_of(const Crowd& crowd);

/// A simulation of the crowd that has made its settling steps, with one thread. Made once, and the same one is returned
/// at every later call: it goes on from where it was left.
jostle::Simulation& settled(const Crowd& crowd);
