#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// What a rank has had to do since cuts were moved last, beside waiting for others. By it cuts are moved: a rank takes
/// longer where rods are dense, long, or its machine slow. No bit of a result depends on it.
struct Work {
    double seconds = 0.0;
    std::uint64_t steps = 0;

    /// Whether a rank has so much more to do than the others that cuts should be moved; not yet after few steps. All
    /// ranks call it together.
    bool is_uneven(const Ranks& ranks) const;

    /// Of each of this rank's own rods; the same for all where none of them has been measured for long. All ranks call
    /// it together.
    double of_rod(const Ranks& ranks, std::size_t own_rods) const;
};

/// Adds a step, while it lives, to the work of a rank.
class WorkTimer {
public:
    WorkTimer(const Ranks& ranks, Work& work)
        : ranks_(ranks), work_(work), waited_(ranks.seconds_waited()), began_(Clock::now()) {}
    ~WorkTimer() {
        work_.seconds += seconds() - (ranks_.seconds_waited() - waited_);
        ++work_.steps;
    }
    /// Since it began, waiting for others included.
    double seconds() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }
    WorkTimer(const WorkTimer&) = delete;
    WorkTimer& operator=(const WorkTimer&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    const Ranks& ranks_;
    Work& work_;
    double waited_;
    Clock::time_point began_;
};

}  // namespace jostle
