#pragma once

#include <filesystem>

#include "jostle/scene/scene.hpp"

namespace jostle::python {

/// A scene and the file that it came from, from whose folder `rods.file` counts; empty if it came from none.
struct SceneInPython {
    Scene scene;
    std::filesystem::path path;
};

}  // namespace jostle::python
