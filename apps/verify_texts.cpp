#include "verify_texts.hpp"

#include <cstdio>

#include "jostle/disk/durable_file.hpp"
#include "jostle/scene/key_values.hpp"
#include "jostle/scene_file/same_scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_writer.hpp"
#include "parsed_json.hpp"
#include "run_files.hpp"
#include "sealed_json.hpp"

using namespace jostle;
using Json = nlohmann::ordered_json;

namespace {

constexpr const char* written_anew = "Run the same command again: it writes this file anew";

void print_sound(const std::string& name) {
    std::printf("%s: sound\n", name.c_str());
}

/// Returns the resolved form of scene.toml, which may have another end than the checkpoint: a run goes on with it.
std::string verify_scene(const std::string& folder, const Checkpoint& checkpoint) {
    const std::string path = folder + "/scene.toml";
    const Scene scene = parse_scene(read_scene_text(path), path);
    if (const std::string difference = physics_difference(scene_of(checkpoint, folder), scene); !difference.empty())
        throw refused_file(path, "is not the scene of the checkpoint: " + difference,
                           "Run the same command again, or put resolved.toml in its place");
    print_sound("scene.toml");
    return to_toml(scene);
}

void verify_resolved(const std::string& folder, const Checkpoint& checkpoint, const std::string& resolved_now) {
    const std::string path = folder + "/resolved.toml";
    const std::string text = read_file(path);
    if (text != resolved_now && text != checkpoint.scene)
        throw refused_file(path, "is the resolved form neither of scene.toml nor of the scene in the checkpoint",
                           written_anew);
    print_sound("resolved.toml");
}

void verify_descriptions(const std::string& folder, const Checkpoint& checkpoint) {
    for (const DescribedTable& table : described_tables(scene_of(checkpoint, folder))) {
        const std::string name = table.name + ".json", path = folder + "/" + name;
        if (read_file(path) != series_description(table.name, table.columns))
            throw refused_file(path, "does not describe the columns as this version of jostle does", written_anew);
        print_sound(name);
    }
}

/// A JSON object with its checksum.
Json verify_json(const std::string& folder, const std::string& name) {
    const std::string path = folder + "/" + name;
    const std::string text = read_file(path);
    if (!is_sealed_json(text)) throw refused_file(path, "is damaged: it does not fit its checksum", written_anew);
    print_sound(name);
    return parsed_json(text);
}

}  // namespace

void verify_texts(const std::string& folder, const Checkpoint& checkpoint) {
    const auto is_there = [&](const char* name) { return file_exists(folder + "/" + name); };
    verify_resolved(folder, checkpoint, verify_scene(folder, checkpoint));
    verify_descriptions(folder, checkpoint);
    // The first record is written after the first checkpoint, and before the first step.
    const bool has_record = checkpoint.state.clock.step > 0 || is_there("run.json");
    const bool is_done = has_record && verify_json(folder, "run.json")["exit_reason"] == "done";
    if (is_done || is_there("summary.json")) verify_json(folder, "summary.json");
    if (is_there("post_mortem.json")) verify_json(folder, "post_mortem.json");
}
