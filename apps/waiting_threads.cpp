#include "waiting_threads.hpp"

#include <unistd.h>

#include <cstdlib>

void give_way_to_other_programs(char** words) {
    if (std::getenv("OMP_WAIT_POLICY") != nullptr || std::getenv("GOMP_SPINCOUNT") != nullptr) return;
    ::setenv("GOMP_SPINCOUNT", "1000", 1);  // what the library takes by itself where it starts too many threads
    ::execv("/proc/self/exe", words);       // returns only if it could not
}
