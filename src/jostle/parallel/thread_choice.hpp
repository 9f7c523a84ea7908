#pragma once

#include <array>
#include <chrono>
#include <cstddef>

namespace jostle {

/// Chooses the number of threads of a run by how long its steps take, which their results do not depend on.
///
/// As many as are worth starting for the rods, unless other programs keep processors busy: threads then wait for each
/// other at every loop, and fewer are faster. So now and then some steps are made with half or twice as many, and the
/// faster number stays.
class ThreadChoice {
public:
    /// Sets the number for the step that begins, unless parallel::set_thread_count or OMP_NUM_THREADS has done so.
    void begin_step(std::size_t rods);
    /// Notes how long it took. A step that has failed need not tell.
    void end_step();

    /// The number for the next step, at most `most`; then `took`, how long that step took. What the two above rest on.
    int next(int most);
    void took(double seconds);

private:
    void begin_trial();
    void end_trial(bool faster);
    double usual() const;

    int count_ = 0, most_ = 0;       ///< 0: no step yet
    int on_trial_ = 0;               ///< another number; 0 between trials
    bool fewer_ = true;              ///< the next trial is of fewer
    std::array<double, 5> times_{};  ///< of the last steps with `count_`
    std::array<double, 3> trial_{};
    std::size_t timed_ = 0, tried_ = 0;
    static constexpr int least_patience = 5;
    int patience_ = least_patience;  ///< steps between trials
    double usual_at_trial_ = 0.0;    ///< when the last trial ended
    std::chrono::steady_clock::time_point began_;
};

}  // namespace jostle
