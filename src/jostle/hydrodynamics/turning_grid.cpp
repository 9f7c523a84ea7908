#include "jostle/hydrodynamics/turning_grid.hpp"

#include <cmath>
#include <numbers>

#include "jostle/parallel/parallel_for.hpp"

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
            const double number = static_cast<double>(n) - (2 * n > points ? static_cast<double>(points) : 0.0);
            const double k = 2.0 * pi * number / edges[d];
            waves.number.push_back(k);
            waves.ratio.push_back(std::exp(0.5 * k * k * (spread - couple_spread)));
        }
    }
}

/// of_wave(number, k/2 with its factor)
template <class OfWave>
void TurningGrid::for_each_wave(OfWave&& of_wave) {
    const auto [nx, ny, nz] = grid_.points();
    const std::size_t wx = grid_.waves_along_x(), rows = ny;
    parallel_for_parts(nz, [&](std::size_t z) {
        for (std::size_t y = 0; y < rows; ++y)
            for (std::size_t x = 0; x < wx; ++x) of_wave((z * rows + y) * wx + x, factors_.half_wave(x, y, z));
    });
}

void TurningGrid::add_couples(std::vector<WaveVector>& force_waves) {
    grid_.forward();
    for_each_wave([&](std::size_t wave, const Vec3& half) { force_waves[wave] += curl(half, grid_.waves[wave]); });
}

void TurningGrid::find_turning(const std::vector<WaveVector>& flow_waves) {
    for_each_wave([&](std::size_t wave, const Vec3& half) { grid_.waves[wave] = curl(half, flow_waves[wave]); });
    grid_.backward();
}

}  // namespace jostle
