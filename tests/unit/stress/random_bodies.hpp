#pragma once

#include <random>

#include "jostle/math/mat3.hpp"
#include "jostle/stress/rigid_body_stress.hpp"

// Random rigid bodies and vectors for the tests of the pair stress.

namespace jostle::test {

inline Vec3 random_vector(std::mt19937_64& generator) {
    std::normal_distribution<double> normal;
    const double x = normal(generator), y = normal(generator), z = normal(generator);
    return {x, y, z};
}

inline Vec3 random_direction(std::mt19937_64& generator) {
    return normalised(random_vector(generator));
}

/// The second moment of eight masses at random places, one of them as far off as to make the body slender now and then.
inline Mat3 random_second_moment(std::mt19937_64& generator) {
    std::uniform_real_distribution<double> mass(0.1, 1.0);
    Mat3 moment;
    for (int k = 0; k < 8; ++k) {
        const Vec3 x = (k == 0 ? 3.0 : 1.0) * random_vector(generator);
        moment += mass(generator) * outer(x, x);
    }
    return moment;
}

inline RigidBody random_body(std::mt19937_64& generator) {
    const Vec3 centre = 3.0 * random_vector(generator);
    return {centre, random_second_moment(generator)};
}

/// eps_kij a_ij: the axial vector of the antisymmetric part.
inline Vec3 axial(const Mat3& a) {
    return {a(1, 2) - a(2, 1), a(2, 0) - a(0, 2), a(0, 1) - a(1, 0)};
}

}  // namespace jostle::test
