#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "jostle/math/vec3.hpp"
#include "jostle/simulation/pair_problem.hpp"

namespace jostle {

/// Centre and turning of a rod's velocity, or force and lever on it, side by side: as wide as a vector register.
template <class Real>
struct alignas(8 * sizeof(Real)) Wide {
    std::array<Real, 8> value{};  // 0-2 centre, 3-5 turning, the rest 0

    Wide() = default;
    Wide(const Vec3& a, const Vec3& b)
        : value{static_cast<Real>(a.x), static_cast<Real>(a.y), static_cast<Real>(a.z),
                static_cast<Real>(b.x), static_cast<Real>(b.y), static_cast<Real>(b.z)} {}
    Vec3 first() const { return {value[0], value[1], value[2]}; }
    Vec3 second() const { return {value[3], value[4], value[5]}; }

    template <class Other>
    void add(Other factor, const Wide<Other>& other) {
        for (std::size_t k = 0; k < 8; ++k) value[k] += static_cast<Real>(factor * other.value[k]);
    }
};

template <class Real, class Other>
Real sum_of_products(const Wide<Real>& a, const Wide<Other>& b, const Wide<Real>& c, const Wide<Other>& d) {
    std::array<Real, 8> t;
    for (std::size_t k = 0; k < 8; ++k)
        t[k] = a.value[k] * static_cast<Real>(b.value[k]) + c.value[k] * static_cast<Real>(d.value[k]);
    return ((t[0] + t[4]) + (t[2] + t[6])) + ((t[1] + t[5]) + (t[3] + t[7]));
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

    template <class Velocity>
    Real gap_velocity(const Wide<Velocity>* velocities) const {
        return b + compliance * gamma + sum_of_products(column_i, velocities[i], column_j, velocities[j]);
    }
    template <class Velocity>
    void push(Real change, Wide<Velocity>* velocities) {
        gamma += change;
        velocities[i].add(change, answer_i);
        velocities[j].add(change, answer_j);
    }
};

/// A pair that touches at two or three points, and their part of A.
struct SweptPair : PairMatrix {
    std::array<SweptContact<double>, most_points> contact;
};

/// The contacts of an item: of a pair that touches at one point, as most do, or at more.
template <class Real>
std::span<SweptContact<Real>> contacts_of(SweptContact<Real>& single) {
    return {&single, 1};
}
inline std::span<SweptContact<double>> contacts_of(SweptPair& pair) {
    return {pair.contact.data(), pair.count};
}

/// Solves the contact problem of each in turn, over-relaxed, with all other forces as they are, and keeps the
/// velocities up to date. Returns the largest change of a gap velocity by the contact's own force; unless `stirred` is
/// null, raises that of each rod (places) to the largest such change of its contacts. No two may share a rod if their
/// order is not to matter.
double sweep_over(std::span<SweptContact<float>> contacts, double omega, Wide<float>* velocities, float* stirred);
double sweep_over(std::span<SweptContact<double>> contacts, double omega, Wide<double>* velocities, float* stirred);
double sweep_over(std::span<SweptPair> pairs, double omega, Wide<float>* velocities, float* stirred);
double sweep_over(std::span<SweptPair> pairs, double omega, Wide<double>* velocities, float* stirred);

}  // namespace jostle
