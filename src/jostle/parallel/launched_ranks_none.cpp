// In place of launched_ranks_mpi.cpp where there is no MPI.

#include <cstdlib>
#include <string>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/launched_ranks.hpp"

namespace jostle {

bool LaunchedRanks::are_built_in() {
    return false;
}

LaunchedRanks::LaunchedRanks() {
    throw InputError({.key = "ranks",
                      .value = std::to_string(launch_in_environment().count),
                      .problem = "this jostle was built without MPI, and so makes a run in one process only",
                      .suggestion = "Start it without a launcher, as by --threads, or build it where MPI is found "
                                    "(docs/guide/clusters.md)"});
}

LaunchedRanks::~LaunchedRanks() = default;

Ranks LaunchedRanks::ranks() const {
    return {};
}

int LaunchedRanks::on_this_machine() const {
    return 1;
}

void LaunchedRanks::give_up(int exit_code) const {
    std::_Exit(exit_code);
}

}  // namespace jostle
