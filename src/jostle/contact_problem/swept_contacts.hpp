#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/contact_problem/pair_problem.hpp"

namespace jostle {

/// Centre and turning of a rod's velocity, or force and lever on it, side by side: a vector register of the compiler's,
/// which finds no vectors by itself in loops of eight.
template <class Real>
struct alignas(8 * sizeof(Real)) Wide {
    using Lanes [[gnu::vector_size(8 * sizeof(Real))]] = Real;
    Lanes lanes{};  // 0-2 centre, 3-5 turning, the rest 0

    Wide() = default;
    explicit Wide(const ContactForce& force) : Wide(force.force, force.lever) {}
    explicit Wide(const ContactVelocity& velocity) : Wide(velocity.centre, velocity.turning) {}
    ContactVelocity velocity() const { return {{lanes[0], lanes[1], lanes[2]}, {lanes[3], lanes[4], lanes[5]}}; }

private:
    Wide(const Vec3& a, const Vec3& b)
        : lanes{static_cast<Real>(a.x), static_cast<Real>(a.y), static_cast<Real>(a.z),
                static_cast<Real>(b.x), static_cast<Real>(b.y), static_cast<Real>(b.z)} {}
};

/// a.b + c.d, in the same order for vector registers of any size.
template <class Real>
Real sum_of_products(const Wide<Real>& a, const Wide<Real>& b, const Wide<Real>& c, const Wide<Real>& d) {
    const typename Wide<Real>::Lanes t = a.lanes * b.lanes + c.lanes * d.lanes;
    const auto u = __builtin_shufflevector(t, t, 0, 1, 2, 3) + __builtin_shufflevector(t, t, 4, 5, 6, 7);
    return (u[0] + u[2]) + (u[1] + u[3]);
}

/// One contact as a sweep needs it: its column of D, and of M D, for each of its two rods.
template <class Real>
struct SweptContact {
    Wide<Real> column_i, column_j, answer_i, answer_j;
    Real b = 0, gamma = 0;
    Real compliance = 0;         ///< by which a force gives way, a part of A_ll
    Real diagonal = 0;           ///< A_ll
    Real inverse_diagonal = 0;   ///< 0 where no force can open the gap
    std::uint32_t i = 0, j = 0;  ///< places
    std::uint32_t number = 0;    ///< of the contact

    Real gap_velocity(const Wide<Real>* velocities) const {
        return b + compliance * gamma + sum_of_products(column_i, velocities[i], column_j, velocities[j]);
    }
    void push(Real change, Wide<Real>* velocities) {
        gamma += change;
        velocities[i].lanes += change * answer_i.lanes;
        velocities[j].lanes += change * answer_j.lanes;
    }
};

/// A pair that touches at two or three points, and their part of A. In few bytes: what depends on its rods is worked
/// out anew, as sweeps over many such pairs take as long as it takes to read them.
struct SweptPair : PairMatrix {
    struct Point {
        Vec3 normal;
        double arm_i, arm_j;
        double b, gamma, compliance;  // as those of a SweptContact

        double gap_velocity(const ContactVelocity& rod_i, const ContactVelocity& rod_j) const {
            return b + compliance * gamma + gap_rate(*this, rod_i, rod_j);
        }
    };
    std::uint32_t i, j;   ///< places
    std::uint32_t first;  ///< number of the first contact; those of the others follow
    std::array<Point, most_points> points;

    std::span<const Point> touching() const { return std::span(points).first(count); }
};

/// Whether the contacts push, or a gap opens by less than `limit`.
template <class Real>
bool may_push(const SweptContact<Real>& contact, const Wide<Real>* velocities, double limit) {
    return contact.gamma > 0 || contact.gap_velocity(velocities) < limit;
}
template <class Real>
bool may_push(const SweptPair& pair, const Wide<Real>* velocities, double limit) {
    const ContactVelocity i = velocities[pair.i].velocity(), j = velocities[pair.j].velocity();
    return std::ranges::any_of(pair.touching(), [&](const SweptPair::Point& point) {
        return point.gamma > 0.0 || point.gap_velocity(i, j) < limit;
    });
}

/// Calls body(number of the contact, its force) for each.
template <class Real, class Body>
void for_forces(const SweptContact<Real>& contact, Body&& body) {
    body(contact.number, contact.gamma);
}
template <class Body>
void for_forces(const SweptPair& pair, Body&& body) {
    for (std::uint32_t a = 0; a < pair.count; ++a) body(pair.first + a, pair.points[a].gamma);
}

/// What sweeps know of the rods with contacts (places).
template <class Real>
struct Places {
    const MobileRod* rods;
    Wide<Real>* velocities;
    float* stirred;  ///< the largest change of a gap velocity by a contact of each, or null
};

/// Solves the contact problem of each in turn, over-relaxed, with all other forces as they are, and keeps the
/// velocities up to date. Returns the largest change of a gap velocity by the contact's own force; raises `stirred` to
/// it. No two may share a rod if their order is not to matter.
double sweep_over(std::span<SweptContact<float>> contacts, double omega, const Places<float>& places);
double sweep_over(std::span<SweptContact<double>> contacts, double omega, const Places<double>& places);
double sweep_over(std::span<SweptPair> pairs, double omega, const Places<float>& places);
double sweep_over(std::span<SweptPair> pairs, double omega, const Places<double>& places);

}  // namespace jostle
