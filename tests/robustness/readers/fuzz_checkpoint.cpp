// Checkpoints whose checksum is right: what a flipped bit cannot make, but a forger can.
#include <xxhash.h>

#include "jostle/run_files/checkpoint.hpp"
#include "reader_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    constexpr std::size_t header = 24, checksum = 8;
    std::string content(fuzzing::text(bytes, size));
    if (size >= header + checksum) {
        const std::uint64_t payload = size - header - checksum;
        content.replace(16, 8, reinterpret_cast<const char*>(&payload), 8);
        const std::uint64_t hash = XXH3_64bits(content.data(), size - checksum);
        content.replace(size - checksum, checksum, reinterpret_cast<const char*>(&hash), checksum);
    }
    const fuzzing::MemoryFile file(content);
    return fuzzing::read_or_refuse([&] { (void)jostle::read_checkpoint(file.path()); });
}
