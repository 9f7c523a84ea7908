#include "jostle/run_files/written_together.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "jostle/disk/checksum.hpp"

namespace jostle {
namespace {

constexpr std::size_t longest_piece = std::size_t{1} << 26;  ///< is read back at once

/// Of ranks of one process.
class LocalFile final : public FileOfRanks {
public:
    explicit LocalFile(const std::string& path) : descriptor_(::open(path.c_str(), O_WRONLY | O_CLOEXEC)) {
        if (descriptor_ < 0) throw_error();
    }
    ~LocalFile() override { ::close(descriptor_); }
    LocalFile(const LocalFile&) = delete;
    LocalFile& operator=(const LocalFile&) = delete;

    void write_at(std::uint64_t place, std::string_view bytes) override {
        while (!bytes.empty()) {
            const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) throw_error();
            place += static_cast<std::uint64_t>(written);
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }
    void finish() override {
        if (::fsync(descriptor_) < 0) throw_error();
    }

private:
    [[noreturn]] static void throw_error() { throw std::system_error(errno, std::generic_category()); }

    int descriptor_;
};

}  // namespace

WrittenTogether::WrittenTogether(const RodsInOrder& rods, AppendFile* file, std::function<void(std::string_view)> seen)
    : ranks_(rods.ranks()), file_(file), seen_(std::move(seen)) {
    if (!rods.all_take()) return;
    path_ = ranks_.of_first(file_ ? file_->path() : "");
    end_ = file_ ? file_->size() : 0;
    try {
        together_ = ranks_.open(path_);
        if (!together_) together_ = std::make_unique<LocalFile>(path_);
    } catch (const std::system_error& error) {
        throw DiskError(path_, "open for writing", error.code().value());
    }
}

void WrittenTogether::write(std::string_view bytes) {
    if (!file_) return;
    if (!together_) {
        file_->write_all(bytes);
        seen_(bytes);
        return;
    }
    for (; !bytes.empty(); bytes.remove_prefix(std::min(longest_piece, bytes.size()))) {
        const std::string_view piece = bytes.substr(0, longest_piece);
        write_at(end_, piece);
        end_ += piece.size();
    }
}

void WrittenTogether::write_column(std::uint64_t bytes, const FieldWriter::Pieces& pieces) {
    if (!together_) return pieces([&](std::uint64_t, std::string_view piece) { write(piece); });
    // What comes before is written by then: a file that ends early is seen to be incomplete.
    const auto begin = static_cast<std::uint64_t>(ranks_.sum(file_ ? static_cast<std::int64_t>(end_) : 0));
    pieces([&](std::uint64_t place, std::string_view piece) { write_at(begin + place, piece); });
    end_ = begin + bytes;
}

void WrittenTogether::write_at(std::uint64_t place, std::string_view bytes) {
    if (bytes.empty()) return;
    try {
        together_->write_at(place, bytes);
    } catch (const std::system_error& error) {
        throw DiskError(path_, "write", error.code().value());
    }
    written_.push_back({place, bytes.size(), checksum(bytes)});
}

void WrittenTogether::finish() {
    if (!together_) return;
    try {
        together_->finish();
    } catch (const std::system_error& error) {
        throw DiskError(path_, "write to the disk", error.code().value());
    }
    std::vector<Piece> pieces = ranks_.gather_at_first(written_);  // all have finished
    if (!file_) return;
    read_back(std::move(pieces));
    file_->truncate_to(end_);
}

void WrittenTogether::read_back(std::vector<Piece> pieces) {
    std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.place < b.place; });
    ReadFile file(path_);
    std::string bytes;
    std::uint64_t place = file_->size();
    file.go_to(place);
    for (const Piece& piece : pieces) {
        file.read_up_to(piece.bytes, bytes);
        if (piece.place != place || bytes.size() != piece.bytes || checksum(bytes) != piece.checksum)
            throw DiskError(path_, "write",
                            "at byte " + std::to_string(place) +
                                " it does not hold what the ranks have written; all "
                                "of them must see the same folder");
        seen_(bytes);
        place += piece.bytes;
    }
}

}  // namespace jostle
