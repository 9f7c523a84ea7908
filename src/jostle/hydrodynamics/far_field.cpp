#include "jostle/hydrodynamics/far_field.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

using std::numbers::pi;

/// size (I - kk/k^2) v
WaveVector solenoidal(double size, const Vec3& k, const WaveVector& v) {
    const GridVector wave(k);
    const double inverse = 1.0 / squared_norm(k);
    const auto part = [&](const GridVector& of) { return size * (of - ((wave * of).sum() * inverse) * wave); };
    return {part(v.real()), part(v.imag())};
}

}  // namespace

WaveFactors::WaveFactors(const Vec3& edges, const EwaldSplit& split, double spread, double viscosity)
    : width_(0.25 / (split.splitting * split.splitting)) {
    const SpreadingKernel kernel(split.spread_points);
    for (int d = 0; d < 3; ++d) {
        Waves& waves = along_[static_cast<std::size_t>(d)];
        const std::size_t points = split.grid[static_cast<std::size_t>(d)];
        for (std::size_t n = 0; n < points; ++n) {
            const double number = wave_number(n, points);
            const double k = 2.0 * pi * number / edges[d];
            const double transform = kernel.transform(2.0 * pi * number / static_cast<double>(points));
            waves.number.push_back(k);
            waves.factor.push_back(2 * n == points ? 0.0
                                                   : std::exp(-k * k * (spread + width_)) / (transform * transform));
        }
    }
    for (double& factor : along_[2].factor) factor /= viscosity * edges.x * edges.y * edges.z;
}

FarField::FarField(const Rods& rods, const Box& box, const RodBlobs& blobs, const EwaldSplit& split,
                   const WaveFactors& factors, const CoupleFactors* couples, std::shared_ptr<FluidGrids> grids)
    : blobs_(rods, box, blobs, split), grids_(std::move(grids)), grid_(&grids_->flow), factors_(factors) {
    if (couples != nullptr) turning_.emplace(*couples, *grids_->turning);
}

/// From waves of forces to those of the flow.
void FarField::solve() const {
    grid_->for_each_wave([&](std::size_t wave, std::size_t x, std::size_t y, std::size_t z) {
        WaveVector& v = grid_->waves[wave];
        const double multiplier = factors_.factor(x, y, z);
        v = multiplier == 0.0 ? WaveVector{} : solenoidal(multiplier, factors_.wave(x, y, z), v);
    });
}

/// From waves of the flow to the velocities of rods.
void FarField::gather_flow(std::span<LineVector> velocities) const {
    if (turning_) {
        turning_->find_turning(grid_->waves);
        blobs_.gather_turning(turning_->field(), velocities);
    }
    grid_->backward();
    blobs_.gather(grid_->field, velocities);
}

void FarField::add_flow(std::span<const LineVector> forces, std::span<LineVector> velocities) const {
    blobs_.spread(forces, grid_->field);
    grid_->forward();
    if (turning_) {
        blobs_.spread_couples(forces, turning_->field());
        turning_->add_couples(grid_->waves);
    }
    solve();
    gather_flow(velocities);
}

void FarField::add_axial_flow(const AxialStresslets& stresslets, std::span<LineVector> velocities) const {
    blobs_.spread(stresslets, grid_->field);
    grid_->forward();
    solve();
    gather_flow(velocities);
}

/// A wave and its mirror image share their six normal numbers: those of the place of the first of the two.
void FarField::draw(const RandomKey& key, double scale) const {
    const auto [nx, ny, nz] = grid_->points();
    const std::size_t wx = grid_->waves_along_x(), rows = ny, planes = nz;
    parallel_for_parts(planes, [&](std::size_t z) {
        std::vector<std::uint64_t> ids(wx);
        std::vector<Normals> normals(wx);
        for (std::size_t y = 0; y < rows; ++y) {
            const std::size_t first = (z * rows + y) * wx;
            for (std::size_t x = 0; x < wx; ++x) ids[x] = first + x;
            // Waves with k_x = 0 have their images among those that are kept.
            const std::size_t image = ((planes - z) % planes * rows + (rows - y) % rows) * wx;
            const bool is_image = image < first;
            if (is_image) ids[0] = image;
            fill_normals(key, ids, normals);
            for (std::size_t x = 0; x < wx; ++x) {
                WaveVector& v = grid_->waves[first + x];
                const double multiplier = factors_.factor(x, y, z);
                if (multiplier == 0.0) {
                    v = WaveVector{};
                    continue;
                }
                const double sign = x == 0 && is_image ? -1.0 : 1.0;
                const Normals& xi = normals[x];
                v = solenoidal(scale * std::sqrt(0.5 * multiplier), factors_.wave(x, y, z),
                               {GridVector(Vec3{xi[0], xi[2], xi[4]}), sign * GridVector(Vec3{xi[1], xi[3], xi[5]})});
            }
        }
    });
}

void FarField::add_square_root(const RandomKey& key, double scale, std::span<LineVector> velocities) const {
    draw(key, scale);
    gather_flow(velocities);
}

}  // namespace jostle
