#pragma once

#include <array>
#include <vector>

#include "jostle/hydrodynamics/ewald_split.hpp"
#include "jostle/hydrodynamics/fourier_grid.hpp"
#include "jostle/math/vec3.hpp"

namespace jostle {

/// What turns couples' waves into those of forces (theory, section 7.8): half a curl, and the Gaussian of a couple in
/// place of that of a force.
class CoupleFactors {
public:
    CoupleFactors(const Vec3& edges, const EwaldSplit& split, double spread, double couple_spread);

    /// exp(k^2 (spread - couple_spread)/2) k/2
    Vec3 half_wave(std::size_t x, std::size_t y, std::size_t z) const {
        const double size = 0.5 * along_[0].ratio[x] * along_[1].ratio[y] * along_[2].ratio[z];
        return size * Vec3{along_[0].number[x], along_[1].number[y], along_[2].number[z]};
    }

private:
    struct Waves {
        std::vector<double> number, ratio;
    };
    std::array<Waves, 3> along_;
};

/// A second grid beside that of a far field: on it couples are spread, or the turning of the fluid is found. Both are
/// found from the same waves by transposed maps, so that M stays symmetric to rounding.
class TurningGrid {
public:
    /// Holds a reference to the factors.
    TurningGrid(const CoupleFactors& factors, FourierGrid& grid) : factors_(factors), grid_(grid) {}

    std::vector<GridVector>& field() { return grid_.field; }

    /// force_waves += 1/2 i k x those of the couples in `field`.
    void add_couples(std::vector<WaveVector>& force_waves);
    /// field = 1/2 curl of the flow with these waves.
    void find_turning(const std::vector<WaveVector>& flow_waves);

private:
    const CoupleFactors& factors_;
    FourierGrid& grid_;
};

}  // namespace jostle
