// Lets the fuzzer see what a child of the fuzzed program covers: the counters of edges lie in memory that both share.
// This file is built without counters of its own, and linked first.
#include <sys/mman.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

// By these names the linker tells where the counters lie that the compiler has made, one for each edge.
extern "C" std::uint8_t __start___sancov_cntrs, __stop___sancov_cntrs;

namespace {

// Only whole pages can be shared: the counters of the program come after a page of these. Each has an address and
// flags.
constexpr std::size_t page = 4096;
[[gnu::section("__sancov_cntrs"), gnu::used, gnu::aligned(1)]] std::uint8_t first_counters[page];
[[gnu::section("__sancov_pcs"), gnu::used, gnu::aligned(8)]] std::uintptr_t first_edges[page][2];

std::uintptr_t whole_pages(const std::uint8_t* address) {
    return reinterpret_cast<std::uintptr_t>(address) / page * page;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
    auto* const begin = reinterpret_cast<std::uint8_t*>(whole_pages(&__start___sancov_cntrs + page - 1));
    const std::size_t size = whole_pages(&__stop___sancov_cntrs) - reinterpret_cast<std::uintptr_t>(begin);
    const std::vector<std::uint8_t> counted(begin, begin + size);
    if (::mmap(begin, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED)
        std::abort();
    std::memcpy(begin, counted.data(), size);
    return 0;
}
