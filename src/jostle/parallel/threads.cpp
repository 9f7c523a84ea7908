#include <omp.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle::parallel {

namespace {

/// For fewer, loops are so short that another thread saves no more than waiting for it takes (docs/performance.md).
constexpr std::size_t rods_per_thread = 2000;

const auto processors = static_cast<std::size_t>(omp_get_num_procs());
const bool is_in_environment = std::getenv("OMP_NUM_THREADS") != nullptr;
std::atomic<int> chosen = 0;  ///< 0: OpenMP's own, which belongs to the calling thread

}  // namespace

void set_thread_count(int count) {
    chosen = std::max(1, count);
}

bool thread_count_is_free() {
    return chosen == 0 && !is_in_environment;
}

int worthwhile_thread_count(std::size_t rods) {
    return static_cast<int>(std::clamp(rods / rods_per_thread, std::size_t{1}, processors));
}

void suit_thread_count(int count) {
    if (thread_count_is_free()) omp_set_num_threads(count);
}

int thread_count() {
    return chosen > 0 ? chosen.load() : omp_get_max_threads();
}

std::pair<std::size_t, std::size_t> own_share(std::size_t count) {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto own = static_cast<std::size_t>(omp_get_thread_num());
    return {count * own / threads, count * (own + 1) / threads};
}

}  // namespace jostle::parallel
