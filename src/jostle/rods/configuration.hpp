#pragma once

#include <cstddef>
#include <vector>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// Where rods are at one moment of a step.
struct Configuration {
    std::vector<Vec3> centre;  ///< (N) not wrapped into the box
    std::vector<Vec3> axis;    ///< (N) unit vectors

    std::size_t size() const { return centre.size(); }
    void resize(std::size_t count) {
        centre.resize(count);
        axis.resize(count);
    }
};

}  // namespace jostle
