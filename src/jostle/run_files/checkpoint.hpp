#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "jostle/domain/rods_in_order.hpp"
#include "jostle/math/named_numbers.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// How far a file had come.
struct FilePosition {
    std::uint64_t bytes = 0;
    std::uint64_t hash = 0;  ///< checksum of these bytes
    bool operator==(const FilePosition&) const = default;
};

using FilePositions = std::map<std::string, FilePosition>;  ///< by the names of the files, as "series.csv"

/// Everything that a run needs to go on as if it had never stopped: the state, and how far its files had come.
struct Checkpoint {
    std::string scene;  ///< resolved scene; a scene of the same physics is needed to go on
    State state;
    NamedNumbers sums;    ///< of the run so far, `StepSums::to_named`
    FilePositions files;  ///< of the run's growing files
};

/// Writes FOLDER/checkpoint, its rods in the order of ids, and keeps the one before as FOLDER/checkpoint.previous.
///
/// A kill or a power cut at any moment leaves at least one of the two whole: the new one is complete on the disk
/// (checkpoint.tmp, fsync) before anything is renamed. Series and trajectory must have been synced before.
/// Errors: DiskError; the last sound checkpoint is then still there.
void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint);
/// The same with these rods in the place of the checkpoint's own. Where ranks share them the first one calls it, and
/// the others `send_rods_of_checkpoint`.
void write_checkpoint(const std::string& folder, const Checkpoint& checkpoint, const RodsInOrder& rods);
void send_rods_of_checkpoint(const RodsInOrder& rods);

/// Reads and verifies one checkpoint file, and changes nothing.
///
/// Format: 8 bytes "\x89JOSTLE\n", version (u32), 0 (u32), payload length (u64), payload, XXH3 checksum (u64) of all
/// before. The payload is named fields (disk/named_fields.hpp); numbers are little endian, doubles as they are.
/// Errors: InputError that tells apart a missing, foreign, truncated or damaged file, another format version, and
/// contents that no run can have written (`impossible_content`).
Checkpoint read_checkpoint(const std::string& path);

/// A checkpoint as bytes, with these rods in the place of its own, for another process of the same program; where ranks
/// share the rods the first one gets it, and all call it together. And back. Errors: std::out_of_range if the bytes are
/// not whole.
std::string packed(const Checkpoint& checkpoint, const RodsInOrder& rods);
Checkpoint unpacked(std::string_view bytes);

/// What no run can have left in a checkpoint, in words: a number that is not finite or out of its range, a rod outside
/// the box, an id that stands twice; empty if all of it is possible. A file can have a right checksum and yet be made
/// by hand.
std::string impossible_content(const Checkpoint& checkpoint);

/// The checkpoint to go on from: FOLDER/checkpoint, or FOLDER/checkpoint.previous if a kill left only that, or none.
///
/// A damaged FOLDER/checkpoint is an error, not silently passed over: the message says whether the one before is sound
/// and how to go on from it. Errors: InputError, DiskError.
std::optional<Checkpoint> latest_checkpoint(const std::string& folder);

/// Throws InputError unless the run of this checkpoint began with these fixed rods, of the file `name`.
void require_same_fixed_rods(const Checkpoint& checkpoint, const std::shared_ptr<const Rods>& fixed,
                             const std::string& name);

/// Refuses a checkpoint of other springs than the file at `path` holds now: the scene only names it. Where rods turn
/// round, all points of a rod may be on its other side. Errors: InputError.
void require_same_springs(const Checkpoint& checkpoint, std::vector<Spring> springs, bool rods_turn_round,
                          const std::string& path);

}  // namespace jostle
