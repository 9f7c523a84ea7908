#include <omp.h>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle::parallel {

void set_thread_count(int count) {
    omp_set_num_threads(std::max(1, count));
}

int thread_count() {
    return omp_get_max_threads();
}

std::pair<std::size_t, std::size_t> own_share(std::size_t count) {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto own = static_cast<std::size_t>(omp_get_thread_num());
    return {count * own / threads, count * (own + 1) / threads};
}

}  // namespace jostle::parallel
