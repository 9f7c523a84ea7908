#pragma once

#include <string>
#include <vector>

#include "jostle/scene/scene.hpp"

namespace jostle {

/// A key that means nothing beside the others of a scene, such as rods.axis of a random start.
struct UnusedKey {
    std::string key;  ///< full key
    std::string reason;
    std::string suggestion;
};

/// The keys that mean nothing in this scene: to give one is an error, and a written scene leaves them out.
std::vector<UnusedKey> unused_keys(const Scene& scene);

/// Throws InputError where such a key has another value than its default; the reader of scenes also sees those that
/// are given and equal it.
void refuse_unused_keys(const Scene& scene);

}  // namespace jostle
