#pragma once

#include <memory>
#include <optional>
#include <span>

#include "jostle/hydrodynamics/grid_blobs.hpp"
#include "jostle/hydrodynamics/turning_grid.hpp"
#include "jostle/math/random.hpp"

namespace jostle {

/// What the waves of a grid multiply forces by.
class WaveFactors {
public:
    WaveFactors(const Vec3& edges, const EwaldSplit& split, double spread, double viscosity);

    /// 2 pi (x/edge, y/edge, z/edge), with numbers beyond half the grid standing for negative ones.
    Vec3 wave(std::size_t x, std::size_t y, std::size_t z) const {
        return {along_[0].number[x], along_[1].number[y], along_[2].number[z]};
    }
    /// exp(-k^2 spread) H(k)/(viscosity V k^2) over the square of the kernel's transform; 0 of k = 0, and of the
    /// shortest waves, which have no mirror image.
    double factor(std::size_t x, std::size_t y, std::size_t z) const {
        const double k_squared = squared_norm(wave(x, y, z));
        if (k_squared == 0.0) return 0.0;
        return along_[0].factor[x] * along_[1].factor[y] * along_[2].factor[z] * (1.0 / k_squared + width_);
    }

private:
    struct Waves {
        std::vector<double> number, factor;
    };
    double width_;  ///< 1/(4 splitting^2)
    std::array<Waves, 3> along_;
};

/// The grids that a far field works on.
struct FluidGrids {
    FourierGrid flow;
    std::optional<FourierGrid> turning;  ///< where spheres turn with the fluid

    FluidGrids(const std::array<std::size_t, 3>& points, bool with_turning) : flow(points) {
        if (with_turning) turning.emplace(points);
    }
    bool fit(const std::array<std::size_t, 3>& points, bool with_turning) const {
        return flow.points() == points && turning.has_value() == with_turning;
    }
};

/// The part of M that is summed over waves of a periodic box, on a grid (theory, eq. 7.6): for every wave k != 0
/// (I - kk/k^2) exp(-k^2 spread) H(k)/(viscosity V k^2), H = (1 + q) exp(-q), q = k^2/(4 splitting^2).
class FarField {
public:
    /// `grids`: of the split's points; what stands on them is overwritten by every call. `couples`: of spheres that
    /// turn with the fluid, or none. Holds references to rods, blobs and factors.
    FarField(const Rods& rods, const Box& box, const RodBlobs& blobs, const EwaldSplit& split,
             const WaveFactors& factors, const CoupleFactors* couples, std::shared_ptr<FluidGrids> grids);

    /// velocities += M_far forces, (N) each.
    void add_flow(std::span<const LineVector> forces, std::span<LineVector> velocities) const;
    /// velocities += those of the rods in the flow of stresslets on all rods.
    void add_axial_flow(const AxialStresslets& stresslets, std::span<LineVector> velocities) const;
    /// velocities += scale B xi, B B^T = M_far as it is applied; xi are numbers of the waves.
    void add_square_root(const RandomKey& key, double scale, std::span<LineVector> velocities) const;

private:
    void solve() const;
    void draw(const RandomKey& key, double scale) const;
    void gather_flow(std::span<LineVector> velocities) const;

    GridBlobs blobs_;
    std::shared_ptr<FluidGrids> grids_;
    FourierGrid* grid_;  ///< of forces and velocities
    const WaveFactors& factors_;
    mutable std::optional<TurningGrid> turning_;  ///< of couples and angular velocities
};

}  // namespace jostle
