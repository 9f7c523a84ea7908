#pragma once

#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/rods/axial_stresslets.hpp"

namespace jostle {

/// A blob's part of a stresslet along the axis n of its rod: the force `force` n and the dipole `dipole` n n.
struct AxialBlob {
    double force = 0.0, dipole = 0.0;
};

/// Of a swimmer's dipole p the forces p moment_weight n at the blobs; of thermal turning -2 kT moment_weight n and
/// dipoles -kT moment_weight place n n there (theory, eqs. 7.8 and 7.11). The one blob of a sphere has the dipole p
/// itself.
inline AxialBlob axial_blob(const AxialStresslets& stresslets, std::size_t row, const BlobLine& line,
                            std::size_t blob) {
    const double dipole = stresslets.of_swimmers() ? stresslets.dipole[row] : 0.0;
    if (line.place.size() == 1) return {0.0, dipole};
    const double weight = line.moment_weight[blob];
    return {(dipole - 2.0 * stresslets.kT) * weight, -stresslets.kT * weight * line.place[blob]};
}

}  // namespace jostle
