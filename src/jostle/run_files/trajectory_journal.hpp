#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jostle/disk/byte_buffer.hpp"
#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/domain/rods_in_order.hpp"
#include "jostle/math/mat3.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

inline constexpr const char* trajectory_journal_name = "trajectory.journal";  ///< in the folder of a run

/// The frames of a trajectory while the run lasts: an append-only file, from which trajectory.h5 is made.
///
/// Why not HDF5 at once: a kill within a flush, or a full disk, leaves an HDF5 file that no longer opens. Here the
/// worst is one incomplete frame at the end, which readers leave out. Format, little endian: 8 bytes "\x89JTRAJ\r\n",
/// version (u32), content (u32; 0, or 1: with stress); then frames: "FRAME\0\0\0", step (u64), time (f64), box edges (3
/// f64), periodic (u64, bit k for direction k; upper half: offset of copies above along y, f32), N (u64), XXH3 of these
/// (u64); id (N u64), centre (3N f32), image (3N i32), axis (3N f32), length (N f32), diameter (N f32), with stress
/// that of every rod (9N f64); XXH3 of the whole frame before it (u64). N may change from frame to frame; steps
/// increase.
class TrajectoryJournal {
public:
    enum class Content : std::uint32_t { rods = 0, rods_and_stress = 1 };

    /// A new journal without frames; what `path` held is gone. Errors: DiskError.
    static TrajectoryJournal create(const std::string& path, Content content = Content::rods);

    /// Goes on after the first `bytes` bytes, which must be whole, sound frames and have the checksum `hash`; what
    /// follows them is cut off.
    ///
    /// All checks come before the cut. Errors: InputError if the file is missing, foreign, shorter, damaged or of
    /// another run; DiskError.
    static TrajectoryJournal resume(const std::string& path, std::uint64_t bytes, std::uint64_t hash);

    /// The checks of `resume` alone, for looking at several files before one of them is cut. Errors: as there. Result:
    /// what the frames hold.
    static Content require_frames(const std::string& path, std::uint64_t bytes, std::uint64_t hash);

    /// One frame. `stress` (N): of every rod in the order of ids, in a journal with stress; else empty. Where ranks
    /// share the rods the first one calls it, and the others `send_rods`. Errors: InputError if the size of `stress` is
    /// another; DiskError, after which the journal ends with the frame before.
    void append(std::uint64_t step, double time, const Box& box, const RodsInOrder& rods,
                const std::vector<Mat3>& stress = {});
    static void send_rods(const RodsInOrder& rods);

    /// Returns when all frames are on the disk. Errors: DiskError.
    void sync() { file_.sync(); }

    std::uint64_t bytes() const { return file_.size(); }
    std::uint64_t hash() const { return checksum_.value(); }  ///< checksum of these bytes

private:
    TrajectoryJournal(AppendFile file, Content content) : file_(std::move(file)), content_(content) {}
    void write(std::string_view bytes);

    AppendFile file_;
    Content content_;
    RunningChecksum checksum_;
};

/// One frame as the journal holds it: rods in single precision, for looking at and analysing, never for going on.
struct TrajectoryFrame {
    std::uint64_t step = 0;
    double time = 0.0;
    Box box;
    std::vector<std::uint64_t> id;             ///< (N)
    std::vector<std::array<float, 3>> centre;  ///< (N) inside the box along periodic directions
    std::vector<Image> image;                  ///< (N)
    std::vector<std::array<float, 3>> axis;    ///< (N) unit vectors
    std::vector<float> length;                 ///< (N)
    std::vector<float> diameter;               ///< (N)
    std::vector<Mat3> stress;                  ///< (N) double precision; (0) in a journal without

    std::size_t size() const { return id.size(); }
};

/// Reads the frames of a journal one by one.
class TrajectoryReader {
public:
    /// Errors: InputError if the file is missing, foreign or of another version; DiskError.
    explicit TrajectoryReader(const std::string& path);

    /// Reads the next frame; false at the end, and at a last frame that a kill left incomplete.
    /// Errors: InputError, with the byte where the damage begins; DiskError.
    bool next(TrajectoryFrame& frame);

    /// Where the last frame that was read ends, in bytes from the beginning of the file.
    std::uint64_t offset() const { return offset_; }
    /// Of the bytes up to there. Taking it ends the reading.
    RunningChecksum take_checksum() { return std::move(checksum_); }

    TrajectoryJournal::Content content() const { return content_; }

private:
    ReadFile file_;
    TrajectoryJournal::Content content_ = TrajectoryJournal::Content::rods;
    RunningChecksum checksum_;
    std::uint64_t offset_ = 0;
    std::uint64_t frames_ = 0;
    std::uint64_t last_step_ = 0;
    std::string buffer_;
};

}  // namespace jostle
