#pragma once

#include <memory>

#include "jostle/mobility/mobility.hpp"
#include "jostle/scene/scene.hpp"

namespace jostle {

/// The mobility that a scene asks for.
std::unique_ptr<Mobility> make_mobility(const Scene& scene);

}  // namespace jostle
