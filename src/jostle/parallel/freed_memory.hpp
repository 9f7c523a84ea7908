#pragma once

namespace jostle::parallel {

/// From now on arrays that are freed stay with the process, but the very largest: every step takes the same arrays
/// again. Given back to the system, each of their pages is cleared anew before it is used (decision 0084). Does nothing
/// where the C library is not glibc.
void keep_freed_memory();

}  // namespace jostle::parallel
