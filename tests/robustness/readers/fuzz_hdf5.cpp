// Tables of other programs in HDF5. The HDF5 library itself is Debian's and not instrumented: its crashes are found,
// its branches are not seen. A child process reads the file: shared_counters.cpp lets what it covers be seen.
#include "jostle/tables/body_table.hpp"
#include "reader_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const fuzzing::MemoryFile file(fuzzing::text(bytes, size));
    return fuzzing::read_or_refuse([&] { (void)jostle::read_bodies(file.path()); });
}
