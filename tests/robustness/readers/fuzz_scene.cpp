// Scenes: any text is a scene, which then can be written and read again, or is refused.
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_writer.hpp"
#include "reader_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    return fuzzing::read_or_refuse([&] {
        const jostle::Scene scene = jostle::parse_scene(fuzzing::text(bytes, size), "scene.toml");
        if (!(jostle::parse_scene(jostle::to_toml(scene), "resolved.toml") == scene)) std::abort();
    });
}
