#pragma once

#include <chrono>
#include <stdexcept>

#include "jostle/setup/anneal.hpp"
#include "run_options.hpp"

/// The wall time is over before the start is made.
class StartOutOfTime : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// Tells how a start is being made, where that takes long.
class StartWatch {
public:
    /// Holds the reference.
    explicit StartWatch(const RunOptions& options) : options_(options) {}

    /// Throws StartOutOfTime.
    void see(const jostle::Annealing& now);

    /// Since it was made.
    double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    const RunOptions& options_;
    Clock::time_point begin_ = Clock::now(), last_ = begin_;
};
