#include "jostle/hydrodynamics/turning_grid.hpp"

#include <cmath>
#include <numbers>

namespace jostle {

namespace {

using std::numbers::pi;

/// i k x v
WaveVector curl(const Vec3& k, const WaveVector& v) {
    return {GridVector(cross(v.imag().vector(), k)), GridVector(cross(k, v.real().vector()))};
}

}  // namespace

CoupleFactors::CoupleFactors(const Vec3& edges, const EwaldSplit& split, double spread, double couple_spread) {
    for (int d = 0; d < 3; ++d) {
        Waves& waves = along_[static_cast<std::size_t>(d)];
        const std::size_t points = split.grid[static_cast<std::size_t>(d)];
        for (std::size_t n = 0; n < points; ++n) {
            const double k = 2.0 * pi * wave_number(n, points) / edges[d];
            waves.number.push_back(k);
            waves.ratio.push_back(std::exp(0.5 * k * k * (spread - couple_spread)));
        }
    }
}

void TurningGrid::add_couples(std::vector<WaveVector>& force_waves) {
    grid_.forward();
    grid_.for_each_wave([&](std::size_t wave, std::size_t x, std::size_t y, std::size_t z) {
        force_waves[wave] += curl(factors_.half_wave(x, y, z), grid_.waves[wave]);
    });
}

void TurningGrid::find_turning(const std::vector<WaveVector>& flow_waves) {
    grid_.for_each_wave([&](std::size_t wave, std::size_t x, std::size_t y, std::size_t z) {
        grid_.waves[wave] = curl(factors_.half_wave(x, y, z), flow_waves[wave]);
    });
    grid_.backward();
}

}  // namespace jostle
