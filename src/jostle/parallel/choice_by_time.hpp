#pragma once

#include <array>
#include <cstddef>

namespace jostle {

/// Chooses a number by how long steps take with it, which their results do not depend on.
///
/// It begins with the largest. Now and then some steps are made with half or twice as many, and the faster number
/// stays.
class ChoiceByTime {
public:
    /// The number for the next step, from 1 to `most`; then `took`, how long that step took (s). A step that has failed
    /// need not tell.
    int next(int most);
    void took(double seconds);
    bool has_begun() const { return count_ > 0; }

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
};

}  // namespace jostle
