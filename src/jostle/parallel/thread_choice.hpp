#pragma once

#include <chrono>
#include <cstddef>

#include "jostle/parallel/choice_by_time.hpp"

namespace jostle {

/// Chooses the number of threads of a run by how long its steps take.
///
/// As many as are worth starting for the rods, unless other programs keep processors busy: threads then wait for each
/// other at every loop, and fewer are faster.
class ThreadChoice {
public:
    /// Sets the number for the step that begins, unless parallel::set_thread_count or OMP_NUM_THREADS has done so.
    void begin_step(std::size_t rods);
    /// Notes how long it took. A step that has failed need not tell.
    void end_step();

private:
    ChoiceByTime choice_;
    std::chrono::steady_clock::time_point began_;
};

}  // namespace jostle
