#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "jostle/disk/durable_file.hpp"
#include "jostle/disk/named_fields.hpp"
#include "jostle/domain/rods_in_order.hpp"

namespace jostle {

/// The next bytes of a file that ranks write together: what the first rank has, and columns of their rods.
///
/// The first rank writes all of it, or each rank writes the slices that it takes (`RodsInOrder::TakenBy`), at their
/// places; the bytes are the same. A checksum over all of them needs them in their order: where every rank writes, the
/// first reads them back for it, and requires of each piece that it is what was to be written.
///
/// Errors of all that it does: DiskError.
class WrittenTogether {
public:
    /// All ranks make it together. `file`: of the first rank; none for the others. `seen` gets all bytes in their
    /// order at the first rank, at the latest in `finish`.
    WrittenTogether(const RodsInOrder& rods, AppendFile* file, std::function<void(std::string_view)> seen);

    /// Bytes that the first rank has; the others write nothing.
    void write(std::string_view bytes);
    /// So many bytes of rods, of which `pieces` gives to a sink what this rank takes. All call it together.
    void write_column(std::uint64_t bytes, const FieldWriter::Pieces& pieces);
    /// Where every rank has written, returns when all of it is on the disk and `file` has its size. All call it
    /// together.
    void finish();

private:
    struct Piece {
        std::uint64_t place, bytes, checksum;
    };

    void write_at(std::uint64_t place, std::string_view bytes);
    void read_back(std::vector<Piece> pieces);

    Ranks ranks_;
    AppendFile* file_;
    std::function<void(std::string_view)> seen_;
    std::string path_;
    std::unique_ptr<FileOfRanks> together_;  ///< none where the first rank writes all
    std::uint64_t end_ = 0;                  ///< of what is written, at the first rank
    std::vector<Piece> written_;             ///< by this rank
};

}  // namespace jostle
