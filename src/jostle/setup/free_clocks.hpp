#pragma once

#include <span>

#include "jostle/mobility/mobility.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/rods/spring.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/simulation/simulation.hpp"
#include "jostle/statistics/equilibrium_check.hpp"

namespace jostle {

/// The clocks of the slowest rod, were it alone; 0 without Brownian motion (and tumbles, which turn a rod, too), that
/// of rotation also where all are spheres that do not swim. Swimmers are asked for the longer of how long they keep
/// their direction and how long an axis is remembered; of those that nothing turns it is infinite where they are
/// spheres, and 0, so that the series is asked, where they are rods. The slowdown is that of `crowding_slowdown` at the
/// mean L/D; of cells that grow 1. Between walls, under pressure, and from rods of a file or a run a density evens out
/// faster the harder rods are to compress: by `stiffness_of_spheres`, which no isotropic rods fall short of, if all are
/// alike. All starts but lattices, whose places last, have `diffusion_arrest`. `rods`: all, or one that stands for all.
/// `springs`: those between them.
FreeClocks free_clocks(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, const Box& box,
                       double volume_fraction, std::span<const Spring> springs = {});
/// Those of a simulation as its rods and box are now, after all that the schedule changes in the scene.
FreeClocks free_clocks(const Scene& scene, const Simulation& simulation);

/// d(Pi/kT)/dn of hard spheres (Carnahan and Starling, J. Chem. Phys. 51, 635 (1969)), in the plane of discs
/// (scaled-particle theory): by so much faster than alone a density evens out, for contact forces do not change the
/// mobility.
double stiffness_of_spheres(double volume_fraction, int dimensions);

/// By how much longer the diffusion time of a window has to be taken in a crowd, so that two hold twelve structural
/// relaxation times 1/(q^2 D_L), q = 7/D. The long-time diffusion D_L of hard spheres is taken for D_0 (1 -
/// phi/0.58)^1.2, 0.6, 0.25 and 0.1 of it at 0.2, 0.4 and 0.49, where they freeze; in the plane with 0.80 for 0.58. 1
/// below a volume fraction of 0.48.
double diffusion_arrest(double volume_fraction, int dimensions);

/// By how much slower than one alone rods turn in a crowd, roughly: before a run.
///
/// The order of an isotropic state relaxes more slowly by 1/|1 - c/4|, with c = (pi/4) n L^2 D times Lee's factor (1 -
/// 3 phi/4)/(1 - phi)^2: it diverges where Onsager's isotropic state ends; beyond, it is that of a nematic, whose rods
/// rock only. In the isotropic state neighbours in the way make it exp(8 phi^2) times slower still, fitted to measured
/// decays of the order tensor: 2.3 and 18 times at L/D = 3, phi = 0.3 and 0.5, 1.9 and 15 times at L/D = 5, phi = 0.2
/// and 0.35, 4.5 times at L/D = 10, phi = 0.2, where this gives 2.9, 32, 1.9, 8.2 and 3.7. At most 100. `aspect_ratio`
/// = L/D.
///
/// In two dimensions, from the order of hard rods of L/D = 5 in Monte Carlo, 1/|1 - c/c*| with c = n L^2/(1 - phi)^0.8
/// and Onsager's c* = 3 pi/2 of needles in a plane; how much neighbours in the way slow it down is not in it.
double crowding_slowdown(double volume_fraction, double aspect_ratio, int dimensions);

}  // namespace jostle
