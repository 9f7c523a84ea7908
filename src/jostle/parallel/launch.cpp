#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "jostle/parallel/launched_ranks.hpp"

namespace jostle {

namespace {

/// Of the first of these variables that holds a whole number.
std::optional<int> number_in(std::initializer_list<const char*> names) {
    for (const char* name : names) {
        const char* const value = std::getenv(name);
        if (!value) continue;
        const std::string_view text = value;
        int number = 0;
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc{} && end == text.data() + text.size()) return number;
    }
    return std::nullopt;
}

}  // namespace

Launch launch_in_environment() {
    // Open MPI's mpirun, launchers that speak PMI, and srun.
    const auto count = number_in({"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"});
    const auto rank = number_in({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"});
    if (!count || *count <= 1) return {};
    return {std::max(0, rank.value_or(0)), *count};
}

}  // namespace jostle
