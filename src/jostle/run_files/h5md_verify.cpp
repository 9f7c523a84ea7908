#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "jostle/disk/byte_buffer.hpp"
#include "jostle/disk/checksum.hpp"
#include "jostle/disk/durable_file.hpp"
#include "jostle/disk/hdf5_objects.hpp"
#include "jostle/run_files/h5md_writer.hpp"

namespace jostle {
namespace {

constexpr std::string_view seal_mark = "\x89JH5MD\r\n";
constexpr std::uint64_t seal_bytes = 24;
constexpr const char* make_again = "Make it again from the journal by running the same command, or take a copy";

struct Seal {
    std::uint64_t bytes = 0;  ///< of the file before the seal
    std::uint64_t hash = 0;   ///< of these
};

/// Reads `bytes` bytes from the beginning; `rest` gets those after them.
std::uint64_t checksum_of(const std::string& path, std::uint64_t bytes, std::string& rest) {
    ReadFile file(path);
    RunningChecksum checksum;
    std::string block;
    for (std::uint64_t left = bytes; left > 0; left -= block.size()) {
        file.read_up_to(std::min<std::uint64_t>(left, 1 << 20), block);
        if (block.empty()) break;
        checksum.add(block);
    }
    file.read_up_to(seal_bytes, rest);
    return checksum.value();
}

/// Whether the seal is there; throws InputError if it is and does not match.
bool seal_is_sound(const std::string& path) {
    const std::uint64_t size = ReadFile(path).size();
    if (size < seal_bytes) return false;
    std::string end;
    const std::uint64_t hash = checksum_of(path, size - seal_bytes, end);
    if (!end.starts_with(seal_mark)) return false;
    ByteReader reader(std::string_view(end).substr(seal_mark.size()));
    const Seal seal{reader.take<std::uint64_t>(), reader.take<std::uint64_t>()};
    if (seal.bytes == size - seal_bytes && seal.hash == hash) return true;
    throw refused_file(path, "the trajectory is damaged: its bytes do not match the checksum at its end", make_again);
}

/// Where HDF5's own part of the file ends: written in its superblock (versions 2 and 3 of the format).
std::optional<std::uint64_t> end_of_hdf5(const std::string& path) {
    constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
    constexpr std::size_t place = 28;
    std::string head;
    ReadFile(path).read_up_to(place + sizeof(std::uint64_t), head);
    if (!head.starts_with(signature))
        throw refused_file(path,
                           "the trajectory is damaged or no H5MD file of jostle: it does not begin as HDF5 files do",
                           make_again);
    const bool knows_its_end = head.size() == place + sizeof(std::uint64_t) && (head[8] == 2 || head[8] == 3);
    if (!knows_its_end) return std::nullopt;
    return ByteReader(std::string_view(head).substr(place)).take<std::uint64_t>();
}

void read_through(hid_t dataset) {
    const Hdf5Id space(H5Dget_space(dataset), "read");
    const Hdf5Id file_type(H5Dget_type(dataset), "read");
    const Hdf5Id type(H5Tget_native_type(file_type, H5T_DIR_ASCEND), "read");
    const int rank = hdf5_checked(H5Sget_simple_extent_ndims(space), "read");
    std::vector<hsize_t> count(static_cast<std::size_t>(rank));
    hdf5_checked(H5Sget_simple_extent_dims(space, count.data(), nullptr), "read");
    std::size_t row_bytes = H5Tget_size(type);
    for (std::size_t k = 1; k < count.size(); ++k) row_bytes *= count[k];
    const hsize_t rows = count.empty() ? 1 : count[0];
    const hsize_t block =
        std::clamp<hsize_t>((1 << 20) / std::max<std::size_t>(row_bytes, 1), 1, std::max<hsize_t>(rows, 1));
    std::vector<char> values(row_bytes * block);
    if (count.empty()) hdf5_checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "read");
    std::vector<hsize_t> start(count.size(), 0);
    for (hsize_t row = 0; !count.empty() && row_bytes > 0 && row < rows; row += block) {
        start[0] = row;
        count[0] = std::min(block, rows - row);
        hdf5_checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr), "read");
        const Hdf5Id memory(H5Screate_simple(rank, count.data(), nullptr), "read");
        hdf5_checked(H5Dread(dataset, type, memory, space, H5P_DEFAULT, values.data()), "read");
    }
}

/// For H5Ovisit: C code calls it, so no exception may leave it.
herr_t visit(hid_t file, const char* name, const H5O_info_t* object, void* failure) {
    auto& first = *static_cast<std::optional<Hdf5Failure>*>(failure);
    try {
        if (object->type != H5O_TYPE_DATASET) return 0;
        const Hdf5Id dataset(H5Dopen2(file, name, H5P_DEFAULT), "open");
        read_through(dataset);
        return 0;
    } catch (Hdf5Failure& problem) {
        problem.operation += std::string(" /") + name;
        first = std::move(problem);
        return -1;
    }
}

}  // namespace

void seal_h5md(const std::string& path) {
    AppendFile file(path);
    std::string nothing;
    const std::uint64_t hash = checksum_of(path, file.size(), nothing);
    ByteWriter seal;
    seal.put(file.size());
    seal.put(hash);
    file.write_all(std::string(seal_mark) + seal.bytes());
    file.sync();
}

void verify_h5md(const std::string& path) {
    // First what can be seen without HDF5, which can hang in a damaged file (1.10), or in a pipe.
    const std::optional<std::uint64_t> end = end_of_hdf5(path);
    const std::uint64_t size = ReadFile(path).size();
    if (!seal_is_sound(path) && end && size != *end)
        throw refused_file(path,
                           "the trajectory is damaged: it has " + std::to_string(size) +
                               " bytes, those of HDF5 end at " + std::to_string(*end) +
                               ", and what follows is no checksum of jostle",
                           make_again);
    const QuietHdf5 quiet;
    std::optional<Hdf5Failure> failure;
    try {
        const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "open the file");
        hdf5_checked(H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, visit, &failure, H5O_INFO_BASIC),
                     "read the structure");
        if (H5Lexists(file, "h5md", H5P_DEFAULT) <= 0) failure = Hdf5Failure{"find /h5md", "it is no H5MD file", 0};
    } catch (const Hdf5Failure& problem) {
        if (!failure) failure = problem;
    }
    if (!failure) return;
    throw refused_file(path,
                       "the trajectory is damaged or no H5MD file of jostle: cannot " + failure->operation +
                           " (HDF5: " + failure->reason + ")",
                       make_again);
}

}  // namespace jostle
