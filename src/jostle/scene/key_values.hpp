#pragma once

#include <string>
#include <vector>

#include "jostle/scene/scene.hpp"

namespace jostle {

/// A key of a scene and its value in words, which are the same for equal values only.
struct KeyValue {
    std::string key;  ///< full key
    std::string text;
    bool may_change;  ///< where a run goes on (scene_keys.hpp)
};

/// All keys, in their order.
std::vector<KeyValue> key_values(const Scene& scene);

/// The first key that keeps a run of `before` from going on as one of `now`, in words: "rods.length was 5 and is 6";
/// how many others there are; empty if there is none. A key that one of the two does not use does not count.
std::string physics_difference(const Scene& before, const Scene& now);

}  // namespace jostle
