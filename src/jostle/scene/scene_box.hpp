#pragma once

#include "jostle/scene/scene.hpp"

namespace jostle {

/// Volume of all rods as they start, the sum of pi (L D^2/4 + D^3/6); for scenes that name the count.
double rods_volume(const Scene& scene);

/// Edges of the box for rods of `rods_volume` in all: as given, or from volume fraction and shape.
Vec3 box_edges(const Scene& scene, double rods_volume);

/// Volume fraction of rods of `rods_volume` in all: as given, or from the edges.
double volume_fraction(const Scene& scene, double rods_volume);

/// The same two for scenes that name the count.
Vec3 box_edges(const Scene& scene);
double volume_fraction(const Scene& scene);

/// Volume fraction beyond which cells that grow have no room left.
inline constexpr double crowded = 0.6;

/// Largest volume fraction of parallel spherocylinders of this L/D, v0 rho_cp = v0 2/(sqrt 2 + (L/D) sqrt 3) / D^3.
///
/// Bolhuis & Frenkel, J. Chem. Phys. 106, 666 (1997); pi/sqrt 18 = 0.7405 for spheres, towards pi/sqrt 12 = 0.9069 for
/// long rods.
double close_packing(double aspect_ratio);

/// Largest volume fraction that a random start is asked for, min(0.60/(1 + (L/D)/15), 4.5/(L/D)).
///
/// Chosen to lie safely below where random packings jam (spheres about 0.64, long rods about 5.4 D/L: Philipse,
/// Langmuir 12, 1127 (1996)), so that rods can be pushed apart: 0.60 for spheres, 0.45 for L/D = 5, 0.36 for L/D = 10.
double random_start_limit(double aspect_ratio);

/// Volume fraction beyond which rods of this L/D order, about: infinity below L/D = 3.5, for no nematic is known there.
///
/// Onsager's c = (pi/4) n L^2 D = 3.29 with Lee's factor (1 - 3 phi/4)/(1 - phi)^2 (J. Chem. Phys. 87, 4972 (1987)) for
/// n, and 5 % more, as simulations have it: 0.41 for L/D = 5, 0.26 for 10, 0.15 for 20.
double isotropic_limit(double aspect_ratio);

}  // namespace jostle
