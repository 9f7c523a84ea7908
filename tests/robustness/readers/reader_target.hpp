#pragma once

// What the fuzzed readers share: bytes as a file, and what a reader may do with them.

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "jostle/disk/durable_file.hpp"
#include "jostle/error/input_error.hpp"

namespace fuzzing {

/// A file in memory that holds these bytes, and can be opened by its path.
class MemoryFile {
public:
    explicit MemoryFile(std::string_view bytes) : descriptor_(::memfd_create("fuzzed", MFD_CLOEXEC)) {
        if (descriptor_ < 0 || ::write(descriptor_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size()))
            std::abort();
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { ::close(descriptor_); }

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

/// Reads, or refuses with a message that names what is wrong; anything else ends the program, which the fuzzer reports.
template <class Reader>
int read_or_refuse(Reader reader) {
    try {
        reader();
    } catch (const jostle::InputError& refusal) {
        if (std::string_view(refusal.what()).size() < 10) std::abort();
    } catch (const jostle::DiskError&) {
    }
    return 0;
}

inline std::string_view text(const std::uint8_t* bytes, std::size_t size) {
    return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace fuzzing
