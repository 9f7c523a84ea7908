#include "jostle/hydrodynamics/fourier_grid.hpp"

#include <algorithm>
#include <kissfft/kissfft.hh>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

using Transform = kissfft<GridVector>;

constexpr std::size_t columns_at_a_time = 4;

WaveVector times_i(const WaveVector& c) {
    return {-c.imag(), c.real()};
}

}  // namespace

/// Transforms the columns of `length` waves, `stride` apart, in all planes: along y in planes of equal z, along z in
/// planes of equal y. Columns are copied a few at a time, neighbours in memory, so that lines of the cache are read
/// whole.
void FourierGrid::transform_columns(bool inverse, std::size_t planes, std::size_t length, std::size_t plane_stride,
                                    std::size_t stride) {
    const Transform transform(length, inverse);
    parallel_for_parts(planes, [&](std::size_t plane) {
        std::vector<WaveVector> before(columns_at_a_time * length), after(columns_at_a_time * length);
        for (std::size_t column = 0; column < waves_along_x(); column += columns_at_a_time) {
            WaveVector* const first = &waves[plane * plane_stride + column];
            const std::size_t columns = std::min(columns_at_a_time, waves_along_x() - column);
            for (std::size_t k = 0; k < length; ++k)
                for (std::size_t c = 0; c < columns; ++c) before[c * length + k] = first[k * stride + c];
            for (std::size_t c = 0; c < columns; ++c) transform.transform(&before[c * length], &after[c * length]);
            for (std::size_t k = 0; k < length; ++k)
                for (std::size_t c = 0; c < columns; ++c) first[k * stride + c] = after[c * length + k];
        }
    });
}

// Two real lines along x make one complex line: a + i b.
void FourierGrid::forward() {
    const auto [nx, ny, nz] = points_;
    const std::size_t wx = waves_along_x(), length = nx;
    const Transform transform(nx, false);
    parallel_for_parts(ny * nz / 2, [&](std::size_t pair) {
        std::vector<WaveVector> before(length), after(length);
        const GridVector* const a = &field[2 * pair * length];
        const GridVector* const b = a + length;
        WaveVector* const wave_a = &waves[2 * pair * wx];
        WaveVector* const wave_b = wave_a + wx;
        for (std::size_t x = 0; x < length; ++x) before[x] = {a[x], b[x]};
        transform.transform(before.data(), after.data());
        for (std::size_t k = 0; k < wx; ++k) {
            const WaveVector f = after[k], mirror = after[k == 0 ? 0 : length - k];
            wave_a[k] = {0.5 * (f.real() + mirror.real()), 0.5 * (f.imag() - mirror.imag())};
            wave_b[k] = {0.5 * (f.imag() + mirror.imag()), 0.5 * (mirror.real() - f.real())};
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
        std::vector<WaveVector> before(length), after(length);
        GridVector* const a = &field[2 * pair * length];
        GridVector* const b = a + length;
        const WaveVector* const wave_a = &waves[2 * pair * wx];
        const WaveVector* const wave_b = wave_a + wx;
        for (std::size_t k = 0; k < wx; ++k) before[k] = wave_a[k] + times_i(wave_b[k]);
        for (std::size_t k = wx; k < length; ++k)
            before[k] = std::conj(wave_a[length - k]) + times_i(std::conj(wave_b[length - k]));
        transform.transform(before.data(), after.data());
        for (std::size_t x = 0; x < length; ++x) {
            a[x] = after[x].real();
            b[x] = after[x].imag();
        }
    });
}

}  // namespace jostle
