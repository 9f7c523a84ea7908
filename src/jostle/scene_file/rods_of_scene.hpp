#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/setup/anneal.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// A scene before any step.
struct Beginning {
    State state;
    Annealing annealing = {};  ///< of a random start
};

/// Rods that a scene does not make itself.
struct GivenRods {
    Rods rods;
    std::vector<Spring> springs;  ///< between them, with the images that they hold, where another run tells them
};

/// The rods of a scene with start = "file" or "run", if it is one; relative paths count from the scene's folder.
/// Errors: InputError where they do not fit the scene; DiskError.
std::optional<GivenRods> given_rods(const Scene& scene, const std::filesystem::path& scene_path);

/// The same without springs.
std::optional<Rods> rods_from_file(const Scene& scene, const std::filesystem::path& scene_path);

/// The box of a scene, for these rods or, if there are none, for those that the scene describes.
Box box_of(const Scene& scene, const std::optional<Rods>& rods);

/// The rods of rods.fixed, which do not move; null where the scene names no file. Errors: InputError, DiskError.
std::shared_ptr<const Rods> fixed_rods(const Scene& scene, const std::filesystem::path& scene_path);

/// The springs file of a scene, relative to the scene's folder; empty if it names none. Errors: InputError if the file
/// is not there.
std::string springs_path(const Scene& scene, const std::filesystem::path& scene_path);

/// The springs of a scene between `count` rods, empty where it names none; images are 0. `rods`: all of these, or one
/// that stands for all. Errors: InputError, DiskError.
std::vector<Spring> springs_from_file(const Scene& scene, const std::filesystem::path& scene_path, const Rods& rods,
                                      std::uint64_t count);

/// What `call()` returns; an InputError of it without a place gets that of its key in the scene.
template <class Call>
auto in_scene_file(const std::filesystem::path& scene_path, Call&& call) {
    try {
        return call();
    } catch (const InputError& error) {
        if (!error.parts().place.file.empty()) throw;
        throw in_scene_file(scene_path, error);
    }
}

/// Makes the rods of the scene's start, as `make_start` does.
using StartMaker = std::function<Rods(const Box&, const std::optional<Rods>& from_file, const AnnealingWatch&)>;

/// Makes the start of a scene; `watch` sees how it is annealed. Without `make` this process makes it alone. Errors:
/// InputError where the rods do not fit, or move too fast for the time step.
Beginning beginning_of(const Scene& scene, const std::filesystem::path& scene_path, const AnnealingWatch& watch = {},
                       const StartMaker& make = {});

/// The same with rods that the caller has, of ids 0, 1, 2, ..., in the place of those that the scene would make; the
/// scene has start = "run". Errors: InputError where they do not fit the scene.
Beginning beginning_of(const Scene& scene, Rods rods);

}  // namespace jostle
