#include "jostle/hydrodynamics/fourier_grid.hpp"

#include <algorithm>
#include <kissfft/kissfft.hh>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

using Complex = std::complex<double>;
using Transform = kissfft<double>;

/// So many columns are copied together: neighbours in memory.
constexpr std::size_t columns_together = 4;

}  // namespace

/// Transforms the columns of `length` waves, `stride` apart, in all planes: along y in planes of equal z, along z in
/// planes of equal y.
void FourierGrid::transform_columns(bool inverse, std::size_t planes, std::size_t length, std::size_t plane_stride,
                                    std::size_t stride) {
    const Transform transform(length, inverse);
    parallel_for_parts(planes, [&](std::size_t plane) {
        std::vector<Complex> before(3 * columns_together * length), after(before.size());
        for (std::size_t first = 0; first < waves_along_x(); first += columns_together) {
            const std::size_t lines = 3 * std::min(columns_together, waves_along_x() - first);
            Complex* const corner = waves[plane * plane_stride + first].data();
            for (std::size_t k = 0; k < length; ++k)
                for (std::size_t line = 0; line < lines; ++line)
                    before[line * length + k] = corner[3 * k * stride + line];
            for (std::size_t line = 0; line < lines; ++line)
                transform.transform(&before[line * length], &after[line * length]);
            for (std::size_t k = 0; k < length; ++k)
                for (std::size_t line = 0; line < lines; ++line)
                    corner[3 * k * stride + line] = after[line * length + k];
        }
    });
}

// Two real lines along x make one complex line: a + i b.
void FourierGrid::forward() {
    const auto [nx, ny, nz] = points_;
    const std::size_t wx = waves_along_x(), length = nx;
    const Transform transform(nx, false);
    parallel_for_parts(ny * nz / 2, [&](std::size_t pair) {
        std::vector<Complex> before(length), after(length);
        const GridVector* const a = &field[2 * pair * length];
        const GridVector* const b = a + length;
        WaveVector* const wave_a = &waves[2 * pair * wx];
        WaveVector* const wave_b = wave_a + wx;
        for (std::size_t n = 0; n < 3; ++n) {
            for (std::size_t x = 0; x < length; ++x) before[x] = {a[x].lanes[n], b[x].lanes[n]};
            transform.transform(before.data(), after.data());
            for (std::size_t k = 0; k < wx; ++k) {
                const Complex f = after[k], mirror = std::conj(after[k == 0 ? 0 : length - k]);
                const Complex sum = f + mirror, difference = f - mirror;
                wave_a[k][n] = 0.5 * sum;
                wave_b[k][n] = {0.5 * difference.imag(), -0.5 * difference.real()};
            }
        }
    });
    transform_columns(false, nz, ny, ny * wx, wx);
    transform_columns(false, ny, nz, wx, ny * wx);
}

void FourierGrid::backward() {
    const auto [nx, ny, nz] = points_;
    const std::size_t wx = waves_along_x(), length = nx;
    transform_columns(true, ny, nz, wx, ny * wx);
    transform_columns(true, nz, ny, ny * wx, wx);
    const Transform transform(nx, true);
    parallel_for_parts(ny * nz / 2, [&](std::size_t pair) {
        std::vector<Complex> before(length), after(length);
        GridVector* const a = &field[2 * pair * length];
        GridVector* const b = a + length;
        const WaveVector* const wave_a = &waves[2 * pair * wx];
        const WaveVector* const wave_b = wave_a + wx;
        const auto times_i = [](const Complex& c) { return Complex(-c.imag(), c.real()); };
        for (std::size_t n = 0; n < 3; ++n) {
            for (std::size_t k = 0; k < wx; ++k) before[k] = wave_a[k][n] + times_i(wave_b[k][n]);
            for (std::size_t k = wx; k < length; ++k)
                before[k] = std::conj(wave_a[length - k][n]) + times_i(std::conj(wave_b[length - k][n]));
            transform.transform(before.data(), after.data());
            for (std::size_t x = 0; x < length; ++x) {
                a[x].lanes[n] = after[x].real();
                b[x].lanes[n] = after[x].imag();
            }
        }
    });
}

}  // namespace jostle
