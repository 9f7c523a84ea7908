#include "jostle/run_files/checkpoint.hpp"

#include <array>
#include <functional>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "jostle/disk/byte_buffer.hpp"
#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"

namespace jostle {
namespace {

// The first byte is no text and the last is a newline, so that a file mangled as text no longer matches.
constexpr std::string_view magic = "\x89JOSTLE\n";
constexpr std::uint32_t format_version = 8;
constexpr std::size_t header_bytes = 24;
constexpr std::size_t checksum_bytes = 8;
constexpr const char* start_again = "Start the run again with --fresh";

/// The bytes of a checkpoint in pieces: small values are copied, arrays stay where they are, for there may be ten
/// million rods.
class Payload {
public:
    template <class Value>
    void put(const Value& value) {
        parts_.back().copied.put(value);
    }
    void put_text(std::string_view text) { parts_.back().copied.put_text(text); }
    template <class Value>
    void put_elements(const std::vector<Value>& values) {
        static_assert(std::is_trivially_copyable_v<Value>);
        parts_.back().array = {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)};
        parts_.emplace_back();
    }

    /// As long as arrays and this are there.
    std::vector<std::string_view> pieces() const {
        std::vector<std::string_view> pieces;
        for (const Part& part : parts_) pieces.insert(pieces.end(), {part.copied.bytes(), part.array});
        return pieces;
    }

private:
    struct Part {
        ByteWriter copied;
        std::string_view array;  ///< after it
    };
    std::vector<Part> parts_{1};
};

void put_rods(Payload& writer, const Rods& rods) {
    writer.put(static_cast<std::uint64_t>(rods.size()));
    writer.put_elements(rods.centre);
    writer.put_elements(rods.axis);
    writer.put_elements(rods.length);
    writer.put_elements(rods.diameter);
    writer.put_elements(rods.id);
    writer.put_elements(rods.image);
    writer.put(static_cast<std::uint64_t>(rods.cycle.size()));
    writer.put_elements(rods.cycle);
    writer.put(static_cast<std::int32_t>(rods.founder_bits));
    writer.put(static_cast<std::uint64_t>(rods.speed.size()));
    writer.put_elements(rods.speed);
}

Rods take_rods(ByteReader& reader) {
    Rods rods;
    const auto count = reader.take<std::uint64_t>();
    reader.take_elements(count, rods.centre);
    reader.take_elements(count, rods.axis);
    reader.take_elements(count, rods.length);
    reader.take_elements(count, rods.diameter);
    reader.take_elements(count, rods.id);
    reader.take_elements(count, rods.image);
    const auto cycles = reader.take<std::uint64_t>();
    if (cycles != 0 && cycles != count) throw std::out_of_range("cell cycles and rods differ in number");
    reader.take_elements(cycles, rods.cycle);
    rods.founder_bits = reader.take<std::int32_t>();
    if (rods.founder_bits < 0 || rods.founder_bits > 53) throw std::out_of_range("ids of cells out of range");
    const auto speeds = reader.take<std::uint64_t>();
    if (speeds != 0 && speeds != count) throw std::out_of_range("speeds and rods differ in number");
    reader.take_elements(speeds, rods.speed);
    return rods;
}

void put_springs(Payload& writer, const std::vector<Spring>& springs) {
    writer.put(static_cast<std::uint64_t>(springs.size()));
    for (const Spring& spring : springs) {  // one by one: what pads a Spring in memory is not defined
        writer.put(spring.rod_1);
        writer.put(spring.rod_2);
        writer.put(std::array{spring.s_1, spring.s_2, spring.rest_length, spring.stiffness});
        writer.put(spring.image);
    }
}

std::vector<Spring> take_springs(ByteReader& reader) {
    std::vector<Spring> springs;
    for (auto left = reader.take<std::uint64_t>(); left > 0; --left) {
        const auto rod_1 = reader.take<std::uint64_t>(), rod_2 = reader.take<std::uint64_t>();
        const auto [s_1, s_2, rest_length, stiffness] = reader.take<std::array<double, 4>>();
        springs.push_back({rod_1, rod_2, s_1, s_2, rest_length, stiffness, reader.take<Image>()});
    }
    return springs;
}

void put_forces(Payload& writer, const std::vector<LastForce>& forces) {
    writer.put(static_cast<std::uint64_t>(forces.size()));
    for (const LastForce& force : forces) {
        writer.put(force.i);
        writer.put(force.j);
        writer.put(static_cast<std::uint8_t>(force.feature));
        writer.put(static_cast<std::uint8_t>(force.upper));
        writer.put(force.gamma);
    }
}

std::vector<LastForce> take_forces(ByteReader& reader) {
    std::vector<LastForce> forces;
    for (auto left = reader.take<std::uint64_t>(); left > 0; --left) {
        LastForce force;
        force.i = reader.take<std::uint64_t>();
        force.j = reader.take<std::uint64_t>();
        const auto feature = reader.take<std::uint8_t>();
        force.upper = reader.take<std::uint8_t>() != 0;
        force.gamma = reader.take<double>();
        if (force.i > force.j || feature > static_cast<std::uint8_t>(ContactFeature::end_of_j))
            throw std::out_of_range("a contact force that is none");
        force.feature = static_cast<ContactFeature>(feature);
        forces.push_back(force);
    }
    return forces;
}

Payload payload_of(const Checkpoint& checkpoint) {
    Payload writer;
    writer.put_text(checkpoint.scene);
    writer.put(checkpoint.step);
    writer.put(checkpoint.time);
    writer.put(checkpoint.box.edges);
    for (const bool periodic : checkpoint.box.periodic) writer.put(static_cast<std::uint8_t>(periodic));
    put_rods(writer, checkpoint.rods);
    put_springs(writer, checkpoint.springs);
    put_forces(writer, checkpoint.last_forces);
    writer.put(static_cast<std::uint64_t>(checkpoint.accumulators.size()));
    writer.put_elements(checkpoint.accumulators);
    writer.put(checkpoint.series_bytes);
    writer.put(checkpoint.series_hash);
    writer.put(checkpoint.trajectory_bytes);
    writer.put(checkpoint.trajectory_hash);
    writer.put(checkpoint.contacts_bytes);
    writer.put(checkpoint.contacts_hash);
    writer.put(checkpoint.field_bytes);
    writer.put(checkpoint.field_hash);
    writer.put(checkpoint.lineage_bytes);
    writer.put(checkpoint.lineage_hash);
    return writer;
}

Checkpoint from_payload(std::string_view payload) {
    ByteReader reader(payload);
    Checkpoint checkpoint;
    checkpoint.scene = reader.take_text();
    checkpoint.step = reader.take<std::uint64_t>();
    checkpoint.time = reader.take<double>();
    checkpoint.box.edges = reader.take<Vec3>();
    for (bool& periodic : checkpoint.box.periodic) periodic = reader.take<std::uint8_t>() != 0;
    checkpoint.rods = take_rods(reader);
    checkpoint.springs = take_springs(reader);
    checkpoint.last_forces = take_forces(reader);
    const auto accumulator_count = reader.take<std::uint64_t>();
    reader.take_elements(accumulator_count, checkpoint.accumulators);
    checkpoint.series_bytes = reader.take<std::uint64_t>();
    checkpoint.series_hash = reader.take<std::uint64_t>();
    checkpoint.trajectory_bytes = reader.take<std::uint64_t>();
    checkpoint.trajectory_hash = reader.take<std::uint64_t>();
    checkpoint.contacts_bytes = reader.take<std::uint64_t>();
    checkpoint.contacts_hash = reader.take<std::uint64_t>();
    checkpoint.field_bytes = reader.take<std::uint64_t>();
    checkpoint.field_hash = reader.take<std::uint64_t>();
    checkpoint.lineage_bytes = reader.take<std::uint64_t>();
    checkpoint.lineage_hash = reader.take<std::uint64_t>();
    if (!reader.empty()) throw std::out_of_range("bytes are left over");
    return checkpoint;
}

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

/// What to do about a damaged FOLDER/checkpoint, which depends on the one before.
std::string way_out(const std::string& path, const std::string& previous) {
    if (!file_exists(previous)) return start_again;
    try {
        const std::uint64_t step = read_checkpoint(previous).step;
        return "The one before it, " + previous + " (step " + std::to_string(step) + "), is sound: remove " + path +
               " to go on from there, or start again with --fresh";
    } catch (const InputError&) {
        return "The one before it, " + previous + ", is no better: start the run again with --fresh";
    }
}

}  // namespace

void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint) {
    const Payload payload = payload_of(checkpoint);
    std::vector<std::string_view> pieces = payload.pieces();
    ByteWriter numbers;
    numbers.put(format_version);
    numbers.put(std::uint32_t{0});
    numbers.put(std::transform_reduce(pieces.begin(), pieces.end(), std::uint64_t{0}, std::plus<>(),
                                      [](std::string_view piece) { return std::uint64_t{piece.size()}; }));
    pieces.insert(pieces.begin(), {magic, numbers.bytes()});
    RunningChecksum sum;
    for (const std::string_view piece : pieces) sum.add(piece);
    ByteWriter footer;
    footer.put(sum.value());
    pieces.push_back(footer.bytes());

    const std::string path = folder + "/checkpoint";
    const std::string temporary = path + ".tmp";
    try {
        write_synced_file(temporary, pieces);
        if (file_exists(path)) rename_file(path, path + ".previous");
        rename_file(temporary, path);
    } catch (...) {
        remove_file_if_present(temporary);
        throw;
    }
    sync_folder(folder);
}

Checkpoint read_checkpoint(const std::string& path) {
    const std::string file = read_file(path);
    const std::string_view payload = verified_payload(path, file);
    Checkpoint checkpoint;
    try {
        checkpoint = from_payload(payload);
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

void require_same_springs(const Checkpoint& checkpoint, std::vector<Spring> springs, bool rods_turn_round,
                          const std::string& path) {
    const auto refuse = [&](const std::string& problem) {
        throw refused_file(path, problem,
                           "Restore the file, give another folder with --out, or start again with --fresh");
    };
    if (springs.size() != checkpoint.springs.size())
        refuse("holds " + std::to_string(springs.size()) + " springs, and the run began with " +
               std::to_string(checkpoint.springs.size()));
    std::unordered_map<std::uint64_t, bool> turned;
    // A rod that has turned round has taken all its points along.
    const auto turn_as_now = [&](std::uint64_t rod, double& s, double now) {
        if (!rods_turn_round || s == 0.0) return;
        if (turned.try_emplace(rod, s == -now).first->second) s = -s;
    };
    for (std::size_t l = 0; l < springs.size(); ++l) {
        Spring& spring = springs[l];
        spring.image = checkpoint.springs[l].image;
        turn_as_now(spring.rod_1, spring.s_1, checkpoint.springs[l].s_1);
        turn_as_now(spring.rod_2, spring.s_2, checkpoint.springs[l].s_2);
        if (!(spring == checkpoint.springs[l]))
            refuse("spring " + std::to_string(l + 1) + " is not the one that the run began with");
    }
}

std::string scene_difference(const std::string& scene_before, const std::string& scene_now) {
    const auto only_tells_the_end = [](std::string_view line) {
        return line.starts_with("production = ") || line.starts_with("equilibration = ");
    };
    std::istringstream before(scene_before), now(scene_now);
    std::string line_before, line_now;
    int line = 0;
    do {
        ++line;
        if (!std::getline(before, line_before)) line_before = "(nothing)";
        if (!std::getline(now, line_now)) line_now = "(nothing)";
        if (!before && !now) return "";
    } while (line_before == line_now || (only_tells_the_end(line_before) && only_tells_the_end(line_now)));
    return "line " + std::to_string(line) + " of the resolved scene was \"" + line_before + "\" and is \"" + line_now +
           "\"";
}

void require_same_scene(const Checkpoint& checkpoint, const std::string& scene, const std::string& folder) {
    const std::string difference = scene_difference(checkpoint.scene, scene);
    if (difference.empty()) return;
    throw refused_file(folder + "/checkpoint", "the checkpoint is of another scene: " + difference,
                       "Restore the scene, give another folder with --out, or start again with --fresh");
}

}  // namespace jostle
