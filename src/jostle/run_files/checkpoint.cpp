#include "jostle/run_files/checkpoint.hpp"

#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "jostle/disk/byte_buffer.hpp"
#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/run_files/checkpoint_fields.hpp"
#include "jostle/run_files/written_together.hpp"

namespace jostle {
namespace {

// The first byte is no text and the last is a newline, so that a file mangled as text no longer matches.
constexpr std::string_view magic = "\x89JOSTLE\n";
constexpr std::uint32_t format_version = 9;
constexpr std::size_t header_bytes = 24;
constexpr std::size_t checksum_bytes = 8;
constexpr const char* start_again = "Start the run again with --fresh";

/// The payload of a file whose frame (magic, length, checksum, version) is sound.
std::string_view verified_payload(const std::string& path, std::string_view file) {
    if (file.size() < magic.size() ? !magic.starts_with(file) : !file.starts_with(magic))
        throw refused_file(path, "is not a checkpoint of jostle: it does not begin with the right 8 bytes",
                           start_again);
    const std::string size = std::to_string(file.size()) + " bytes";
    if (file.size() < header_bytes + checksum_bytes)
        throw refused_file(path, "the checkpoint is truncated: it has " + size + ", fewer than an empty one",
                           start_again);

    ByteReader header(file.substr(magic.size()));
    const auto version = header.take<std::uint32_t>();
    header.take<std::uint32_t>();
    const auto payload_bytes = header.take<std::uint64_t>();
    const auto stored = ByteReader(file.substr(file.size() - checksum_bytes)).take<std::uint64_t>();
    // The checksum comes before the version: a flipped bit in the version is damage, not another version.
    const bool sound = stored == checksum(file.substr(0, file.size() - checksum_bytes));
    if (sound && version != format_version)
        throw refused_file(path,
                           "the checkpoint has format version " + std::to_string(version) +
                               ", this jostle reads version " + std::to_string(format_version),
                           "Go on with the jostle that wrote it, or start the run again with --fresh");
    if (file.size() - header_bytes - checksum_bytes < payload_bytes)
        throw refused_file(path,
                           "the checkpoint is truncated: it has " + size + ", its header says " +
                               std::to_string(payload_bytes) + " and " + std::to_string(header_bytes + checksum_bytes),
                           start_again);
    if (!sound || file.size() - header_bytes - checksum_bytes != payload_bytes)
        throw refused_file(path, "the checkpoint is damaged: its checksum does not match its " + size, start_again);
    return file.substr(header_bytes, payload_bytes);
}

void write(const FieldWriter& fields, WrittenTogether& together) {
    fields.write([&](std::string_view bytes) { together.write(bytes); },
                 [&](std::uint64_t bytes, const auto& pieces) { together.write_column(bytes, pieces); });
    together.finish();
}

/// What to do about a damaged FOLDER/checkpoint, which depends on the one before.
std::string way_out(const std::string& path, const std::string& previous) {
    if (!file_exists(previous)) return start_again;
    try {
        const std::uint64_t step = read_checkpoint(previous).state.clock.step;
        return "The one before it, " + previous + " (step " + std::to_string(step) + "), is sound: remove " + path +
               " to go on from there, or start again with --fresh";
    } catch (const InputError&) {
        return "The one before it, " + previous + ", is no better: start the run again with --fresh";
    }
}

}  // namespace

void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint) {
    write_checkpoint(folder, checkpoint, checkpoint.state.rods);
}

void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint, const RodsInOrder& rods) {
    const FieldWriter fields = fields_of(checkpoint, rods);
    ByteWriter header, footer;
    header.put_bytes(magic);
    header.put(format_version);
    header.put(std::uint32_t{0});
    header.put(fields.bytes());
    const std::string path = folder + "/checkpoint";
    const std::string temporary = path + ".tmp";
    try {
        write_synced_file(temporary, [&](AppendFile& file) {
            RunningChecksum sum;
            WrittenTogether together(rods, &file, [&](std::string_view bytes) { sum.add(bytes); });
            together.write(header.bytes());
            write(fields, together);
            footer.put(sum.value());
            file.write_all(footer.bytes());
        });
        if (file_exists(path)) rename_file(path, path + ".previous");
        rename_file(temporary, path);
    } catch (...) {
        remove_file_if_present(temporary);
        throw;
    }
    sync_folder(folder);
}

void send_rods_of_checkpoint(const RodsInOrder& rods) {
    WrittenTogether together(rods, nullptr, {});
    write(fields_of({}, rods), together);
}

std::string packed(const Checkpoint& checkpoint, const RodsInOrder& rods) {
    return fields_of(checkpoint, rods).text();
}

Checkpoint unpacked(std::string_view bytes) {
    return checkpoint_of_fields(bytes);
}

Checkpoint read_checkpoint(const std::string& path) {
    const std::string file = read_file(path);
    const std::string_view payload = verified_payload(path, file);
    Checkpoint checkpoint;
    try {
        checkpoint = checkpoint_of_fields(payload);
    } catch (const std::out_of_range& problem) {
        throw refused_file(path, std::string("the checkpoint is damaged: ") + problem.what(), start_again);
    }
    if (const std::string problem = impossible_content(checkpoint); !problem.empty())
        throw refused_file(path, "the checkpoint holds what no run has written: " + problem, start_again);
    return checkpoint;
}

std::optional<Checkpoint> latest_checkpoint(const std::string& folder) {
    const std::string path = folder + "/checkpoint";
    const std::string previous = path + ".previous";
    if (!file_exists(path)) {
        if (!file_exists(previous)) return std::nullopt;
        return read_checkpoint(previous);
    }
    try {
        return read_checkpoint(path);
    } catch (const InputError& error) {
        throw refused_file(path, error.parts().problem, way_out(path, previous));
    }
}

void require_same_fixed_rods(const Checkpoint& checkpoint, const std::shared_ptr<const Rods>& fixed,
                             const std::string& name) {
    const std::shared_ptr<const Rods>& known = checkpoint.state.box.fixed_rods();
    const bool same = static_cast<bool>(fixed) == static_cast<bool>(known) &&
                      (!fixed || (fixed->centre == known->centre && fixed->axis == known->axis &&
                                  fixed->length == known->length && fixed->diameter == known->diameter));
    if (same) return;
    throw InputError({.key = "rods.fixed",
                      .value = "\"" + name + "\"",
                      .problem = "the run began with other fixed rods",
                      .suggestion = "Give it the file that it began with, or start anew with --fresh"});
}

void require_same_springs(const Checkpoint& checkpoint, std::vector<Spring> springs, bool rods_turn_round,
                          const std::string& path) {
    const auto refuse = [&](const std::string& problem) {
        throw refused_file(path, problem,
                           "Restore the file, give another folder with --out, or start again with --fresh");
    };
    if (springs.size() != checkpoint.state.springs.size())
        refuse("holds " + std::to_string(springs.size()) + " springs, and the run began with " +
               std::to_string(checkpoint.state.springs.size()));
    std::unordered_map<std::uint64_t, bool> turned;
    // A rod that has turned round has taken all its points along.
    const auto turn_as_now = [&](std::uint64_t rod, double& s, double now) {
        if (!rods_turn_round || s == 0.0) return;
        if (turned.try_emplace(rod, s == -now).first->second) s = -s;
    };
    for (std::size_t l = 0; l < springs.size(); ++l) {
        Spring& spring = springs[l];
        spring.image = checkpoint.state.springs[l].image;
        turn_as_now(spring.rod_1, spring.s_1, checkpoint.state.springs[l].s_1);
        turn_as_now(spring.rod_2, spring.s_2, checkpoint.state.springs[l].s_2);
        if (!(spring == checkpoint.state.springs[l]))
            refuse("spring " + std::to_string(l + 1) + " is not the one that the run began with");
    }
}

}  // namespace jostle
