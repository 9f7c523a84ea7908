#include "jostle/parallel/freed_memory.hpp"

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

namespace jostle::parallel {

namespace {

/// Larger arrays have mappings of their own, which end with them: kept, they would leave the largest gaps in the heap.
[[maybe_unused]] constexpr int largest_kept = 128 << 20;  // bytes

}  // namespace

void keep_freed_memory() {
#ifdef __GLIBC__
    ::mallopt(M_MMAP_THRESHOLD, largest_kept);
    ::mallopt(M_TRIM_THRESHOLD, -1);  // the end of the heap is not given back
#endif
}

}  // namespace jostle::parallel
