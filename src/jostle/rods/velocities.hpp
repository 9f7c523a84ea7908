#pragma once

#include <vector>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// Velocity of every rod's centre, and angular velocity of every rod.
struct Velocities {
    std::vector<Vec3> linear;   ///< (N)
    std::vector<Vec3> angular;  ///< (N)

    explicit Velocities(std::size_t count = 0) : linear(count), angular(count) {}
    std::size_t size() const { return linear.size(); }
    void resize(std::size_t count) {
        linear.resize(count);
        angular.resize(count);
    }
};

}  // namespace jostle
