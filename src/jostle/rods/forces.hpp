#pragma once

#include <vector>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// Force and torque on every rod; torques are about the rods' centres.
struct Forces {
    std::vector<Vec3> force;   ///< (N)
    std::vector<Vec3> torque;  ///< (N)

    explicit Forces(std::size_t count = 0) : force(count), torque(count) {}
    std::size_t size() const { return force.size(); }
};

}  // namespace jostle
