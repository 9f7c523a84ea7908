#include "waiting_threads.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <initializer_list>
#include <system_error>

namespace {

bool any_is_set(std::initializer_list<const char*> names) {
    return std::any_of(names.begin(), names.end(), [](const char* name) { return std::getenv(name) != nullptr; });
}

}  // namespace

void limit_spin_waiting(char** words) {
    if (any_is_set({"OMP_WAIT_POLICY", "GOMP_SPINCOUNT"})) return;
    ::setenv("GOMP_SPINCOUNT", "10000", 1);
    std::error_code unknown;
    const auto program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    if (!unknown) ::execv(program.c_str(), words);  // returns only if it could not
}
