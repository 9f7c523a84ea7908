#pragma once

#include <vector>

namespace jostle {

/// What rods do to the fluid along their axes n beside forces and torques (theory, eqs. 7.8 and 7.11).
struct AxialStresslets {
    double kT = 0.0;             ///< of rods that turn thermally: their stresslets -3 kT n n are the drift kT div M
    std::vector<double> dipole;  ///< (N) force dipoles p n n of swimmers, energies; empty: none

    bool of_swimmers() const { return !dipole.empty(); }
    bool any() const { return kT != 0.0 || of_swimmers(); }
};

}  // namespace jostle
