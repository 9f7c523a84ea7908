#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>

#include "jostle/contact_problem/block_problem.hpp"
#include "jostle/contact_problem/delassus_operator.hpp"

namespace jostle {

/// Centre and axis_rate of a rod's velocity, or force and moment on it, side by side: a vector register of the
/// compiler's, which finds no vectors by itself in loops of eight.
template <class Real>
struct alignas(8 * sizeof(Real)) SpatialVector {
    using Lanes [[gnu::vector_size(8 * sizeof(Real))]] = Real;
    /// 0-2 centre, 3-5 axis_rate, 6 always 0; 7 of a rod's velocity the sweep that stirred it last, else 0.
    Lanes lanes{};

    SpatialVector() = default;
    explicit SpatialVector(const ContactForce& force) : SpatialVector(force.force, force.moment) {}
    explicit SpatialVector(const ContactVelocity& velocity) : SpatialVector(velocity.centre, velocity.axis_rate) {}
    ContactVelocity velocity() const { return {{lanes[0], lanes[1], lanes[2]}, {lanes[3], lanes[4], lanes[5]}}; }
    Real stirred() const { return lanes[7]; }
    void stir(Real sweep) { lanes[7] = sweep; }

private:
    SpatialVector(const Vec3& a, const Vec3& b)
        : lanes{static_cast<Real>(a.x), static_cast<Real>(a.y), static_cast<Real>(a.z),
                static_cast<Real>(b.x), static_cast<Real>(b.y), static_cast<Real>(b.z)} {}
};

/// a.b + c.d, in the same order for vector registers of any size.
template <class Real>
Real sum_of_products(const SpatialVector<Real>& a, const SpatialVector<Real>& b, const SpatialVector<Real>& c,
                     const SpatialVector<Real>& d) {
    const typename SpatialVector<Real>::Lanes t = a.lanes * b.lanes + c.lanes * d.lanes;
    const auto u = __builtin_shufflevector(t, t, 0, 1, 2, 3) + __builtin_shufflevector(t, t, 4, 5, 6, 7);
    return (u[0] + u[2]) + (u[1] + u[3]);
}

/// One contact as a sweep needs it: its column of D, and of M D, for each of its two rods. Of a contact with a fixed
/// body that side is the rod itself, with columns of 0: nothing is read or written that other contacts of it share.
template <class Real>
struct ScalarBlock {
    SpatialVector<Real> jacobian_i, jacobian_j, response_i, response_j;
    Real b = 0, gamma = 0;
    Real compliance = 0;         ///< by which a force gives way, a part of A_ll
    Real diagonal = 0;           ///< A_ll
    Real inverse_diagonal = 0;   ///< 0 where no force can open the gap
    std::uint32_t i = 0, j = 0;  ///< local indices
    std::uint32_t number = 0;    ///< of the contact

    using Forces = Real;  ///< one, or one a point

    Real gap_velocity(const SpatialVector<Real>* velocities) const {
        return b + compliance * gamma + sum_of_products(jacobian_i, velocities[i], jacobian_j, velocities[j]);
    }
    void apply_impulse(Real change, SpatialVector<Real>* velocities) {
        gamma += change;
        velocities[i].lanes += change * response_i.lanes;
        velocities[j].lanes += change * response_j.lanes;
    }
};

/// A pair that touches at two or three points, and their part of A. In few bytes: what depends on its rods is worked
/// out anew, as sweeps over many such pairs take as long as it takes to read them.
struct CoupledBlock : BlockMatrix {
    struct Point {
        Vec3 normal;
        double arm_i, arm_j;
        double b, gamma, compliance;  // as those of a ScalarBlock

        double gap_velocity(const ContactVelocity& rod_i, const ContactVelocity& rod_j) const {
            return b + compliance * gamma + gap_rate(*this, rod_i, rod_j);
        }
    };
    using Forces = Points;

    std::uint32_t i, j;   ///< local indices; i of a fixed body: no_local_index
    std::uint32_t first;  ///< number of the first contact; those of the others follow
    std::array<Point, max_points> points;

    std::span<const Point> touching() const { return std::span(points).first(count); }
};

/// Fixed bodies stay.
template <class Real>
ContactVelocity velocity_of_body(std::uint32_t local, const SpatialVector<Real>* velocities) {
    return local == no_local_index ? ContactVelocity{} : velocities[local].velocity();
}

/// Whether the contacts push, or a gap opens by less than `limit`.
template <class Real>
bool may_push(const ScalarBlock<Real>& contact, const SpatialVector<Real>* velocities, double limit) {
    return contact.gamma > 0 || contact.gap_velocity(velocities) < limit;
}
template <class Real>
bool may_push(const CoupledBlock& pair, const SpatialVector<Real>* velocities, double limit) {
    const ContactVelocity i = velocity_of_body(pair.i, velocities), j = velocity_of_body(pair.j, velocities);
    return std::ranges::any_of(pair.touching(), [&](const CoupledBlock::Point& point) {
        return point.gamma > 0.0 || point.gap_velocity(i, j) < limit;
    });
}

/// max |min(A_ll gamma_l, gap velocity)| over the contacts: 0 where each either pushes with its gap staying closed, or
/// lets it open.
template <class Real>
double violation(const ScalarBlock<Real>& contact, const SpatialVector<Real>* velocities) {
    return std::abs(std::min(contact.diagonal * contact.gamma, contact.gap_velocity(velocities)));
}
template <class Real>
double violation(const CoupledBlock& pair, const SpatialVector<Real>* velocities) {
    const ContactVelocity i = velocity_of_body(pair.i, velocities), j = velocity_of_body(pair.j, velocities);
    double largest = 0.0;
    for (std::uint32_t a = 0; a < pair.count; ++a) {
        const CoupledBlock::Point& point = pair.points[a];
        largest = std::max(largest, std::abs(std::min(pair.matrix[a][a] * point.gamma, point.gap_velocity(i, j))));
    }
    return largest;
}

/// Calls body(number of the contact, its force) for each.
template <class Real, class Body>
void for_forces(const ScalarBlock<Real>& contact, Body&& body) {
    body(contact.number, contact.gamma);
}
template <class Body>
void for_forces(const CoupledBlock& pair, Body&& body) {
    for (std::uint32_t a = 0; a < pair.count; ++a) body(pair.first + a, pair.points[a].gamma);
}

/// What sweeps know of the rods with contacts.
template <class Real>
struct LocalRods {
    const MobileRod* rods;
    SpatialVector<Real>* velocities;
};

/// What tells whether a sweep has to solve a contact: its rods, and the sweep that solved it last. A fixed body is told
/// as the rod itself.
struct Visit {
    std::uint32_t i = 0, j = 0;  ///< local indices
    float solved = 0.0F;         ///< 0: never
};

/// A sweep that is over-relaxed by omega.
struct Relaxation {
    double omega = 1.0;
    float sweep = 1.0F;  ///< its number, from 1 on, as long as numbers are whole in float: 2^24
    double still = 0.0;  ///< a gap velocity that changes by no more leaves the rods of the contact as they are
};

/// Solves the contact problem of each in turn, over-relaxed, with all other forces as they are, and keeps the
/// velocities up to date. Passes over contacts if no other one has stirred their rods since they were solved last, and
/// their own last change was as small. Returns the largest change of a gap velocity by the contact's own force. No two
/// may share a rod if their order is not to matter. `visits`: one a contact.
double sweep_over(std::span<ScalarBlock<float>> contacts, std::span<Visit> visits, const Relaxation& by,
                  const LocalRods<float>& local_rods);
double sweep_over(std::span<ScalarBlock<double>> contacts, std::span<Visit> visits, const Relaxation& by,
                  const LocalRods<double>& local_rods);
double sweep_over(std::span<CoupledBlock> pairs, std::span<Visit> visits, const Relaxation& by,
                  const LocalRods<float>& local_rods);
double sweep_over(std::span<CoupledBlock> pairs, std::span<Visit> visits, const Relaxation& by,
                  const LocalRods<double>& local_rods);

/// The same sweep, not over-relaxed, from forces gamma + beta `last`, to which the velocities have been carried on
/// already. `last`: one a contact, by what its forces changed in the last sweep, and then in this.
double sweep_on(std::span<ScalarBlock<float>> contacts, std::span<float> last, double beta,
                const LocalRods<float>& local_rods);
double sweep_on(std::span<ScalarBlock<double>> contacts, std::span<double> last, double beta,
                const LocalRods<double>& local_rods);
double sweep_on(std::span<CoupledBlock> pairs, std::span<Points> last, double beta, const LocalRods<float>& local_rods);
double sweep_on(std::span<CoupledBlock> pairs, std::span<Points> last, double beta,
                const LocalRods<double>& local_rods);

}  // namespace jostle
