#include "jostle/run_files/trajectory_journal.hpp"

#include <bit>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>

#include "jostle/run_files/written_together.hpp"

namespace jostle {
namespace {

using Content = TrajectoryJournal::Content;

constexpr std::string_view journal_magic = "\x89JTRAJ\r\n";
constexpr std::uint32_t journal_version = 1;
constexpr std::uint64_t file_header_bytes = 16;
constexpr std::array<char, 8> frame_mark = {'F', 'R', 'A', 'M', 'E', 0, 0, 0};
constexpr std::uint64_t frame_header_bytes = 72;
constexpr std::uint64_t rod_bytes = 52, stress_bytes = 72;
constexpr std::uint64_t frame_checksum_bytes = 8;
constexpr const char* put_back = "Put the file back, or start again with --fresh";

std::uint64_t bytes_per_rod(Content content) {
    return content == Content::rods ? rod_bytes : rod_bytes + stress_bytes;
}

std::string file_header(Content content) {
    ByteWriter writer;
    writer.put(journal_version);
    writer.put(static_cast<std::uint32_t>(content));
    return std::string(journal_magic) + writer.bytes();
}

std::array<float, 3> single(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// What a frame has of rods, one column after the other.
void write_rods(const RodsInOrder& rods, WrittenTogether& together) {
    const auto column = [&](auto&& of) {
        constexpr std::size_t bytes = sizeof(of(std::declval<const Rods&>(), std::uint32_t{}));
        together.write_column(rods.size() * bytes, [&](const auto& sink) {
            rods.column(of, [&](std::size_t before, auto values) { sink(before * bytes, bytes_of(values)); });
        });
    };
    column([](const Rods& of, std::uint32_t row) { return of.id[row]; });
    column([](const Rods& of, std::uint32_t row) { return single(of.centre[row]); });
    column([](const Rods& of, std::uint32_t row) { return of.image[row]; });
    column([](const Rods& of, std::uint32_t row) { return single(of.axis[row]); });
    column([](const Rods& of, std::uint32_t row) { return static_cast<float>(of.length[row]); });
    column([](const Rods& of, std::uint32_t row) { return static_cast<float>(of.diameter[row]); });
}

/// The upper half is the offset of copies, in single precision as centres are.
std::uint64_t periodic_bits(const Box& box) {
    float single = static_cast<float>(box.offset());
    if (std::fabs(single) > 0.5 * box.edges().x) single = std::nextafter(single, 0.0F);  // would be the other way round
    const std::uint64_t offset = std::bit_cast<std::uint32_t>(single);
    return (box.periodic()[0] ? 1u : 0u) | (box.periodic()[1] ? 2u : 0u) | (box.periodic()[2] ? 4u : 0u) | offset << 32;
}

/// Fills the frame's header and returns N. The frame mark has been read before.
std::uint64_t take_header(ByteReader& reader, TrajectoryFrame& frame) {
    frame.step = reader.take<std::uint64_t>();
    frame.time = reader.take<double>();
    const Vec3 edges = reader.take<Vec3>();
    const auto periodic = reader.take<std::uint64_t>();
    frame.box = Box(edges, {(periodic & 1u) != 0, (periodic & 2u) != 0, (periodic & 4u) != 0})
                    .sheared(std::bit_cast<float>(static_cast<std::uint32_t>(periodic >> 32)));
    return reader.take<std::uint64_t>();
}

void take_rods(ByteReader& reader, std::uint64_t count, Content content, TrajectoryFrame& frame) {
    reader.take_elements(count, frame.id);
    reader.take_elements(count, frame.centre);
    reader.take_elements(count, frame.image);
    reader.take_elements(count, frame.axis);
    reader.take_elements(count, frame.length);
    reader.take_elements(count, frame.diameter);
    reader.take_elements(content == Content::rods_and_stress ? count : 0, frame.stress);
}

/// Whether the last 8 of `bytes` are the checksum of those before.
bool sound(std::string_view bytes) {
    const std::size_t size = bytes.size() - frame_checksum_bytes;
    return ByteReader(bytes.substr(size)).take<std::uint64_t>() == checksum(bytes.substr(0, size));
}

/// What the frames up to `bytes`, once found to be those of the checkpoint, go on with.
struct CheckedFrames {
    Content content;
    RunningChecksum checksum;
};

CheckedFrames checked_frames(const std::string& path, std::uint64_t bytes, std::uint64_t hash) {
    TrajectoryReader reader(path);
    TrajectoryFrame frame;
    while (reader.offset() < bytes && reader.next(frame)) {
    }
    if (reader.offset() != bytes)
        throw refused_file(path,
                           "the trajectory does not fit the checkpoint: its whole frames end at byte " +
                               std::to_string(reader.offset()) + ", the checkpoint needs " + std::to_string(bytes),
                           put_back);
    CheckedFrames frames{reader.content(), reader.take_checksum()};
    if (frames.checksum.value() != hash)
        throw refused_file(path,
                           "the trajectory is of another run: its first " + std::to_string(bytes) +
                               " bytes are sound, and not those that the checkpoint stands for",
                           put_back);
    return frames;
}

}  // namespace

TrajectoryJournal TrajectoryJournal::create(const std::string& path, Content content) {
    TrajectoryJournal journal{AppendFile(path), content};
    journal.file_.truncate_to(0);
    journal.write(file_header(content));
    return journal;
}

TrajectoryJournal TrajectoryJournal::resume(const std::string& path, std::uint64_t bytes, std::uint64_t hash) {
    CheckedFrames frames = checked_frames(path, bytes, hash);
    TrajectoryJournal journal{AppendFile(path), frames.content};
    journal.checksum_ = std::move(frames.checksum);
    journal.file_.truncate_to(bytes);
    return journal;
}

TrajectoryJournal::Content TrajectoryJournal::require_frames(const std::string& path, std::uint64_t bytes,
                                                             std::uint64_t hash) {
    return checked_frames(path, bytes, hash).content;
}

void TrajectoryJournal::append(std::uint64_t step, double time, const Box& box, const RodsInOrder& rods,
                               const std::vector<Mat3>& stress) {
    const std::size_t needed = content_ == Content::rods ? 0 : rods.size();
    if (stress.size() != needed)
        throw InputError({.key = "stress",
                          .value = std::to_string(stress.size()) + " rows",
                          .problem = "does not fit the journal",
                          .allowed = std::to_string(needed) + " rows"});
    ByteWriter header, footer;
    header.put(frame_mark);
    header.put(step);
    header.put(time);
    header.put(box.edges());
    header.put(periodic_bits(box));
    header.put(static_cast<std::uint64_t>(rods.size()));
    header.put(checksum(header.bytes()));
    const std::uint64_t begin = file_.size();
    RunningChecksum frame;
    try {
        WrittenTogether together(rods, &file_, [&](std::string_view bytes) {
            frame.add(bytes);
            checksum_.add(bytes);
        });
        together.write(header.bytes());
        write_rods(rods, together);
        together.write(bytes_of(std::span(stress)));
        together.finish();
        footer.put(frame.value());
        write(footer.bytes());
    } catch (const DiskError&) {
        file_.truncate_to(begin);
        throw;
    }
}

void TrajectoryJournal::send_rods(const RodsInOrder& rods) {
    WrittenTogether together(rods, nullptr, {});
    write_rods(rods, together);
    together.finish();
}

void TrajectoryJournal::write(std::string_view bytes) {
    file_.write_all(bytes);
    checksum_.add(bytes);
}

TrajectoryReader::TrajectoryReader(const std::string& path) : file_(path), offset_(file_header_bytes) {
    file_.read_up_to(file_header_bytes, buffer_);
    for (const Content content : {Content::rods, Content::rods_and_stress}) {
        content_ = content;
        if (buffer_ != file_header(content)) continue;
        checksum_.add(buffer_);
        return;
    }
    if (file_header(Content::rods).starts_with(buffer_))
        throw refused_file(path,
                           "the trajectory is truncated: it has " + std::to_string(buffer_.size()) +
                               " bytes, its header alone has " + std::to_string(file_header_bytes),
                           put_back);
    if (!buffer_.starts_with(journal_magic))
        throw refused_file(path, "is not a trajectory journal of jostle: it does not begin with the right 8 bytes",
                           put_back);
    throw refused_file(
        path, "the trajectory journal is damaged or has another format version than " + std::to_string(journal_version),
        "Go on with the jostle that wrote it, or start again with --fresh");
}

bool TrajectoryReader::next(TrajectoryFrame& frame) {
    const auto damaged = [this](const std::string& what) {
        return refused_file(file_.path(),
                            "the trajectory is damaged: frame " + std::to_string(frames_ + 1) + ", at byte " +
                                std::to_string(offset_) + ", " + what,
                            put_back);
    };
    file_.read_up_to(frame_header_bytes, buffer_);
    if (buffer_.size() < frame_header_bytes) return false;
    // The header has a checksum of its own because N decides where the frame ends.
    if (!sound(buffer_)) throw damaged("has a header that does not match its checksum");
    std::string whole = buffer_;
    ByteReader header(whole);
    if (header.take<std::array<char, 8>>() != frame_mark) throw damaged("does not begin with the frame mark");
    const std::uint64_t count = take_header(header, frame);
    if (frames_ > 0 && frame.step <= last_step_) throw damaged("is not later than the frame before it");

    if (count > (file_.size() - offset_) / bytes_per_rod(content_)) return false;
    const std::uint64_t rest_bytes = count * bytes_per_rod(content_) + frame_checksum_bytes;
    file_.read_up_to(rest_bytes, buffer_);
    if (buffer_.size() < rest_bytes) return false;
    whole += buffer_;
    if (!sound(whole)) throw damaged("does not match its checksum");
    ByteReader rods(buffer_);
    take_rods(rods, count, content_, frame);
    offset_ += frame_header_bytes + rest_bytes;
    checksum_.add(whole);
    ++frames_;
    last_step_ = frame.step;
    return true;
}

}  // namespace jostle
