// Journals of a trajectory, with the checksum of every frame's head made right, so that its numbers are believed.
#include <xxhash.h>

#include <cstring>

#include "jostle/run_files/trajectory_journal.hpp"
#include "reader_target.hpp"

namespace {

constexpr std::size_t file_head = 16;
constexpr std::size_t frame_head = 64;  // mark, step, time, edges, periodic, N; then its checksum

void seal(std::string& journal) {
    for (std::size_t at = journal.find("FRAME", file_head);
         at != std::string::npos && at + frame_head + 8 <= journal.size(); at = journal.find("FRAME", at + 1)) {
        const std::uint64_t hash = XXH3_64bits(journal.data() + at, frame_head);
        std::memcpy(journal.data() + at + frame_head, &hash, 8);
        std::size_t end = journal.find("FRAME", at + frame_head);
        if (end == std::string::npos) end = journal.size();
        if (end < at + frame_head + 16) continue;
        const std::uint64_t whole = XXH3_64bits(journal.data() + at, end - 8 - at);
        std::memcpy(journal.data() + end - 8, &whole, 8);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    std::string journal(fuzzing::text(bytes, size));
    seal(journal);
    const fuzzing::MemoryFile file(journal);
    return fuzzing::read_or_refuse([&] {
        jostle::TrajectoryReader reader(file.path());
        jostle::TrajectoryFrame frame;
        while (reader.next(frame)) {
        }
    });
}
