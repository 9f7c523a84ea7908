#pragma once

#include <string>

#include "jostle/scene/scene.hpp"

/// The scene of a run, in the three forms in which its files hold it.
struct RunScene {
    std::string path;      ///< of the file, as given
    std::string text;      ///< of the file, byte for byte
    jostle::Scene scene;   ///< as read
    std::string resolved;  ///< with every default spelled out
};
