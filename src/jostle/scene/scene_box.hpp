#pragma once

#include <array>
#include <optional>

#include "jostle/rods/box.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

// In two dimensions volumes are areas, and volume fractions area fractions.

/// The key that gives the fraction, "box.volume_fraction" or "box.area_fraction", what it gives in words, and the
/// value, if the scene has it.
const char* fraction_key(const Scene& scene);
const char* fraction_words(const Scene& scene);
const std::optional<double>& given_fraction(const Scene& scene);

/// Directions along which the box is periodic: never z, where it is flat.
std::array<bool, 3> box_periodic(const Scene& scene);

/// Volume of all rods as they start, the sum of pi (L D^2/4 + D^3/6); for scenes that name the count.
double rods_volume(const Scene& scene);

/// Edges of the box for rods of `rods_volume` in all: as given, or from volume fraction and shape. Flat boxes have an
/// edge of 0 along z.
Vec3 box_edges(const Scene& scene, double rods_volume);

/// Volume fraction of rods of `rods_volume` in all: as given, or from the edges.
double volume_fraction(const Scene& scene, double rods_volume);

/// The same two for scenes that name the count.
Vec3 box_edges(const Scene& scene);
double volume_fraction(const Scene& scene);

/// Volume fraction beyond which cells that grow have no room left.
constexpr double crowded(int dimensions) {
    return dimensions == 2 ? 0.8 : 0.6;
}

/// Largest volume fraction of parallel spherocylinders of this L/D, v0 rho_cp = v0 2/(sqrt 2 + (L/D) sqrt 3) / D^3.
///
/// Bolhuis & Frenkel, J. Chem. Phys. 106, 666 (1997); pi/sqrt 18 = 0.7405 for spheres, towards pi/sqrt 12 = 0.9069 for
/// long rods. In two dimensions of discorectangles, rows side by side whose round ends lie in each other's gaps: (L +
/// pi D/4)/(L + sqrt(3) D/2), pi/sqrt 12 for discs, towards 1.
double close_packing(double aspect_ratio, int dimensions);

/// Largest volume fraction that a random start is asked for, min(0.60/(1 + (L/D)/15), 4.5/(L/D)).
///
/// Chosen to lie safely below where random packings jam (spheres about 0.64, long rods about 5.4 D/L: Philipse,
/// Langmuir 12, 1127 (1996)), so that rods can be pushed apart: 0.60 for spheres, 0.45 for L/D = 5, 0.36 for L/D = 10.
/// In two dimensions 0.70/(1 + (L/D)/40).
double random_start_limit(double aspect_ratio, int dimensions);

/// Volume fraction beyond which rods of this L/D order, about: infinity below L/D = 3.5, for no nematic is known there.
///
/// Onsager's c = (pi/4) n L^2 D = 3.29 with Lee's factor (1 - 3 phi/4)/(1 - phi)^2 (J. Chem. Phys. 87, 4972 (1987)) for
/// n, and 5 % more, as simulations have it: 0.41 for L/D = 5, 0.26 for 10, 0.15 for 20. In two dimensions order is
/// never of long range; from n L^2 = 7 on, as needles do (Frenkel and Eppenga, Phys. Rev. A 31, 1776 (1985)), rods of
/// L/D above 7 turn very slowly.
double isotropic_limit(double aspect_ratio, int dimensions);

}  // namespace jostle
