#pragma once

#include <vector>

#include "jostle/math/mat3.hpp"

namespace jostle {

/// The stress of an assembly, Sigma = n kT I + Sigma_ori + Sigma_col + Sigma_spr (theory, eq. 1.19); positive in
/// compression; energy per volume.
///
/// Departure from the paper: it prints the collision part as a mean over the rods (an energy); it is a sum over the
/// volume.
struct Stress {
    Mat3 kinetic;      ///< n kT I, of the rods' Brownian translation
    Mat3 orientation;  ///< of their Brownian rotation; traceless
    Mat3 collision;    ///< (1/V) sum of the pair stresses; all 9 entries kept
    Mat3 springs;      ///< the same of springs
    int dimensions = 3;

    Mat3 total() const { return kinetic + orientation + collision + springs; }
};

/// Stress times volume, summed over contacts, rods and springs.
struct StressSums {
    Mat3 collision{};    ///< `sum_of_pair_stresses`
    Mat3 orientation{};  ///< `sum_of_orientation_stresses`
    Mat3 springs{};      ///< `sum_of_spring_stresses`
};

/// Stress from the number density n = N/V, the temperature kT and the sums in the volume V.
///
/// In two dimensions the volume is an area, and the stress a force per length, without elements of z. Throws InputError
/// unless n >= 0, kT >= 0, V > 0, all finite.
Stress assembly_stress(double number_density, double kT, double volume, const StressSums& sums, int dimensions = 3);

/// The mean of the normal stresses, Tr Sigma/3; in two dimensions Tr Sigma/2.
double mean_normal_stress(const Mat3& stress, int dimensions);

/// Pi = Tr Sigma/3, with all parts that have a trace; in two dimensions, as the pressures below, Tr Sigma/2.
double pressure(const Stress& stress);

/// Pi_col = Tr Sigma_col/3, the part of the pressure from collisions.
double pressure_collision(const Stress& stress);

/// Z = Pi/(n kT): 1 + Pi_col/(n kT), and with springs + Pi_spr/(n kT). Throws InputError unless n kT > 0: without
/// thermal motion there is no Z.
double compressibility(const Stress& stress, double number_density, double kT);

/// Pi_spr = Tr Sigma_spr/3, the part of the pressure from springs; negative where they pull.
double pressure_springs(const Stress& stress);

/// Eigenvalues of the symmetric part of a stress, ascending, with their directions; in two dimensions the two of the
/// plane.
struct PrincipalStresses {
    std::vector<double> values;
    std::vector<Vec3> directions;
};
PrincipalStresses principal_stresses(const Mat3& stress, int dimensions = 3);

/// Largest over smallest principal stress; not a number unless the smallest is positive, for then the ratio means
/// nothing.
double anisotropy_ratio(const Mat3& stress, int dimensions = 3);

/// |Sigma - Sigma^T|/|Sigma| in the Frobenius norm; 0 for zero stress. At most 2.
double relative_asymmetry(const Mat3& stress);

}  // namespace jostle
