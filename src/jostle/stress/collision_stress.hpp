#pragma once

#include <cstdint>
#include <span>

#include "jostle/contact/contacts.hpp"
#include "jostle/math/mat3.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/rods.hpp"

// The collision stress of rods, with work proportional to the number of contacts and rods:
//     V Sigma_col = sum over contacts of (r_j - r_i) F  +  sum over rods of s^G(net collision torque).
// The geometric stress is linear in the torque on its body, so the sum over contacts of eq. (1.1) becomes a sum over
// rods. All sums have the same bits for any number of threads. `axis` are the rods' directions, one a row: those of
// `rods`, or those at another time of the step (theory, section 3).

namespace jostle {

/// At which distance of the two surfaces the moment of a contact force is taken.
enum class ContactDistance {
    touching,  ///< 0: where forces act; belongs to the corrected time step (theory, section 3)
    at_start   ///< the gap that the step began with, as in the paper
};

/// Net collision torques, about their centres, on some of the rods; the others feel none.
struct RodTorques {
    std::span<const std::uint32_t> rods;  ///< rows, one a torque
    std::span<const Vec3> torque;
};

/// Sum over contacts of the pair stress, V Sigma_col = centre_of_mass_virial + geometric_stress (theory, eq. 1.1).
///
/// `gamma`: one force a contact, >= 0. `torques`: those of D gamma. Throws InputError if a size is wrong.
Mat3 sum_of_pair_stresses(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                          std::span<const Vec3> axis, const RodTorques& torques, ContactDistance distance);

// Sums are of all ranks, where these share the rods: each gives forces and torques of 0 to what others add up.

/// r_j - r_i of a contact: arm_i n_i + distance normal - arm_j n_j; of a fixed body r_i is the point that it touches
/// at, where momentum enters (theory, eq. 6.3). Sizes are not checked.
Vec3 centre_separation(const Contact& contact, const Rods& rods, std::span<const Vec3> axis, ContactDistance distance);

/// Throws InputError unless there is one force a contact, one axis a rod, and one torque a row.
void require_moment_rows(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                         std::span<const Vec3> axis, const RodTorques& torques);

/// Sum over contacts of (r_j - r_i) F, with r_j - r_i = `centre_separation` and F = gamma normal on rod j.
///
/// `gamma`: one force a contact. Throws InputError if their number is wrong.
Mat3 centre_of_mass_virial(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                           std::span<const Vec3> axis, ContactDistance distance, const Ranks& ranks = {});

/// Sum over contacts of (r_j + a_j - r_i - a_i) F = distance normal F, from centre line to centre line: the "centre
/// line" stress (Snook et al. 2014), for comparison.
Mat3 centre_line_virial(const Contacts& contacts, std::span<const double> gamma, const Rods& rods,
                        ContactDistance distance, const Ranks& ranks = {});

/// Sum over rods of the geometric stress. Throws InputError if there is not one torque a row.
Mat3 geometric_stress(const Rods& rods, std::span<const Vec3> axis, const RodTorques& torques, const Ranks& ranks = {});

/// Geometric stress of a rod with axis n under a torque T: (1/G_perp)[N_par n (T x n) - N_perp (T x n) n] for T across
/// n.
///
/// Written with B = (N_par - N_perp)/G_perp and u = T x n as s^G_ij = (1/2) eps_ijk T_k + (B/2)(n u + u n)_ij: the
/// same, and true also for T along n, and spheres. Traceless. `axis` (3) unit; `length` >= 0 and `diameter` > 0 are not
/// checked.
Mat3 geometric_stress_of_rod(const Vec3& axis, double length, double diameter, const Vec3& torque);

}  // namespace jostle
