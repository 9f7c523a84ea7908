#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/stress/rigid_body_stress.hpp"

// The stress of many contacts between bodies of any shape: what another program's list of contacts amounts to.

namespace jostle {

/// A force between a point of one body and a point of another. Bodies are rows of a list.
struct BodyContact {
    std::uint32_t body_1 = 0;
    std::uint32_t body_2 = 0;  ///< may be body_1, where a body meets its own periodic image
    Vec3 separation;           ///< r_2 - r_1 of the two images that meet, length
    Vec3 point_1;              ///< x_1, where the force acts on body 1, from its centre of mass; length
    Vec3 point_2;              ///< x_2, the same of body 2
    Vec3 force;                ///< on body 2; body 1 feels the opposite
};

/// Stress times volume; the first index is that of the position, the second of the force; positive in compression.
struct ContactStress {
    Mat3 virial;     ///< sum over contacts of (r_2 - r_1) F; of `centre_line`: (r_2 + x_2 - r_1 - x_1) F
    Mat3 geometric;  ///< sum over bodies of s^G of the net torque; 0 in the other conventions
    std::vector<Mat3>
        per_body;  ///< (bodies): half of each virial it takes part in, and its own s^G; they add up to total()

    Mat3 total() const { return virial + geometric; }
};

/// The stress of all contacts, V Sigma = sum_l (r_2 - r_1) F + sum_k s^G(N_k; sum of x F on body k) (theory, eq. 1.14),
/// with work proportional to the number of contacts and bodies.
///
/// `second_moments` (bodies): N about the centres of mass, each in any unit of mass. For `centre_line` the points must
/// lie on the centre lines. Throws InputError if a contact names a body that is not there or holds a number that is not
/// finite, and where `geometric_stress` does for a body that is touched.
ContactStress contact_stress(std::span<const Mat3> second_moments, std::span<const BodyContact> contacts,
                             StressConvention convention = StressConvention::rigid_body);

}  // namespace jostle
