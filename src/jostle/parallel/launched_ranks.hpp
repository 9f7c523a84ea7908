#pragma once

#include <memory>

#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// What the environment tells of a launcher, as mpirun or srun: how many processes it has started, and which this is.
/// A process that none has started is the only one.
struct Launch {
    int rank = 0, count = 1;

    bool is_of_several() const { return count > 1; }
};

Launch launch_in_environment();

/// The processes that a launcher has started, joined by MPI from here until this ends. Only the thread that has made
/// it may use its ranks.
///
/// Two sources define it: launched_ranks_mpi.cpp, and launched_ranks_none.cpp for builds without MPI, where it cannot
/// be made. It is no part of the library, whose users need no MPI then.
class LaunchedRanks {
public:
    /// Whether this program can join processes.
    static bool are_built_in();

    /// Errors: InputError where MPI is not built in, or joins another number than the launcher has started.
    LaunchedRanks();
    ~LaunchedRanks();
    LaunchedRanks(const LaunchedRanks&) = delete;
    LaunchedRanks& operator=(const LaunchedRanks&) = delete;

    Ranks ranks() const;
    /// How many of them are on this machine.
    int on_this_machine() const;
    /// Ends all processes, wherever they are, by this exit code.
    [[noreturn]] void give_up(int exit_code) const;

private:
    std::unique_ptr<RankLink> link_;
};

}  // namespace jostle
