#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// The flow of one blob of force at another: velocity = (isotropic I + radial r r) force, with r the vector between
/// their centres. Units: isotropic 1/(viscosity length), radial 1/(viscosity length^3).
struct BlobFlow {
    double isotropic = 0.0, radial = 0.0;

    Vec3 of(const Vec3& r, const Vec3& force) const { return isotropic * force + (radial * dot(r, force)) * r; }
};

/// The same with its derivatives by r^2.
struct BlobFlowSlope {
    BlobFlow flow, slope;

    /// (direction . gradient by r) of flow.of(r, direction).
    Vec3 along(const Vec3& r, const Vec3& direction) const {
        const double along = dot(r, direction);
        const double on_direction = 2.0 * slope.isotropic * along + flow.radial * along;
        const double on_r = 2.0 * slope.radial * along * along + flow.radial * squared_norm(direction);
        return on_direction * direction + on_r * r;
    }
};

/// Two Gaussian blobs of variance `spread` each in an unbounded fluid (theory, eq. 7.3): the flow of spectrum
/// (I - kk/k^2) exp(-k^2 spread)/(viscosity k^2). `spread` > 0 (length^2), `squared_distance` >= 0 (length^2).
BlobFlow stokes_flow(double spread, double viscosity, double squared_distance);

/// The same of spectrum (I - kk/k^2) exp(-k^2 spread)/viscosity: minus the Laplacian of `stokes_flow`.
BlobFlow solenoidal_gaussian(double spread, double viscosity, double squared_distance);

/// What a periodic sum leaves for real space (theory, eq. 7.5): spectrum (I - kk/k^2) exp(-k^2 spread) (1 -
/// H)/(viscosity k^2) with H = (1 + q) exp(-q), q = k^2/(4 splitting^2); `splitting` > 0 (1/length).
BlobFlow near_flow(double spread, double splitting, double viscosity, double squared_distance);

/// The rotlet of two Gaussians of mean variance `spread`: the flow of a couple T at one is rotlet T x R at the other, R
/// the vector to there from the couple; and the force F there turns the couple's sphere by rotlet R x F, with the same
/// number. Spectrum exp(-k^2 spread)/(2 viscosity k^2) under a gradient; 1/(8 pi viscosity r^3) far away. Unit:
/// 1/(viscosity length^3).
double rotlet(double spread, double viscosity, double squared_distance);

/// How fast a couple turns another one, angular velocity = flow.of(r, couple): a quarter of `solenoidal_gaussian`.
/// Units: isotropic 1/(viscosity length^3), radial 1/(viscosity length^5).
BlobFlow turning(double spread, double viscosity, double squared_distance);

/// Both times (1 - H) in their spectra, as `near_flow`.
double near_rotlet(double spread, double splitting, double viscosity, double squared_distance);
BlobFlow near_turning(double spread, double splitting, double viscosity, double squared_distance);

/// A flow tabulated in r^2: cubics through four points each, so that an error of the fourth order in their width is
/// left.
class FlowTable {
public:
    /// flow(r^2) for r < range; beyond it `at` must not be asked.
    template <class Flow>
    FlowTable(double range, std::size_t intervals, Flow&& flow)
        : per_square_(static_cast<double>(intervals) / (range * range)), pieces_(intervals) {
        for (std::size_t k = 0; k < intervals; ++k) pieces_[k] = piece(k, flow);
    }

    double per_square() const { return per_square_; }  ///< intervals per length^2

    using Both [[gnu::vector_size(16)]] = double;  ///< of isotropic and of radial, in one register
    using Piece = std::array<Both, 4>;             ///< coefficients of t^0 ... t^3, t from 0 to 1 in an interval of r^2
    const std::vector<Piece>& pieces() const { return pieces_; }

    BlobFlow at(double squared_distance) const {
        const double place = squared_distance * per_square_;
        const auto k = static_cast<std::size_t>(place);
        const double t = place - static_cast<double>(k);
        const Piece& p = pieces_[k];
        return flow_of(((p[3] * t + p[2]) * t + p[1]) * t + p[0]);
    }

    BlobFlowSlope with_slope(double squared_distance) const {
        const double place = squared_distance * per_square_;
        const auto k = static_cast<std::size_t>(place);
        const double t = place - static_cast<double>(k);
        const Piece& p = pieces_[k];
        return {flow_of(((p[3] * t + p[2]) * t + p[1]) * t + p[0]),
                flow_of(((3.0 * p[3] * t + 2.0 * p[2]) * t + p[1]) * per_square_)};
    }

private:
    static BlobFlow flow_of(const Both& values) { return {values[0], values[1]}; }

    /// Through the values at t = 0, 1/3, 2/3, 1.
    template <class Flow>
    Piece piece(std::size_t k, Flow&& flow) const {
        std::array<Both, 4> v;
        for (std::size_t n = 0; n < 4; ++n) {
            const BlobFlow value = flow((static_cast<double>(k) + static_cast<double>(n) / 3.0) / per_square_);
            v[n] = Both{value.isotropic, value.radial};
        }
        return {v[0], 0.5 * (-11.0 * v[0] + 18.0 * v[1] - 9.0 * v[2] + 2.0 * v[3]),
                4.5 * (2.0 * v[0] - 5.0 * v[1] + 4.0 * v[2] - v[3]), 4.5 * (-v[0] + 3.0 * v[1] - 3.0 * v[2] + v[3])};
    }

    double per_square_;
    std::vector<Piece> pieces_;
};

}  // namespace jostle
