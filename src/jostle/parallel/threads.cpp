#include <omp.h>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle::parallel {

void set_thread_count(int count) {
    omp_set_num_threads(std::max(1, count));
}

int thread_count() {
    return omp_get_max_threads();
}

}  // namespace jostle::parallel
