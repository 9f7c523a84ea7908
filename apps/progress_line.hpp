#pragma once

#include <chrono>
#include <cstdint>
#include <string>

/// What the user sees of a run while it goes on: on a terminal one line that is kept up to date, elsewhere a line now
/// and then.
class ProgressLine {
public:
    struct Now {
        std::uint64_t step = 0;
        double time = 0.0;
        double phi = 0.0;
        double Z = 0.0;  ///< of the last row
        double max_overlap_in_D = 0.0;
        double iterations = 0.0;
        double contacts = 0.0;
        double fraction_done = 0.0;  ///< 0 to 1; an estimate where equilibration is detected as the run goes
        bool cells_grow = false;     ///< what is left takes longer than as much has taken
        std::string remark = {};     ///< at the end of the line
    };

    /// `quiet`: says nothing at all.
    explicit ProgressLine(bool quiet);
    ~ProgressLine();

    /// Whether it is time to show the state.
    bool is_due() const;
    void show(const Now& now);

private:
    using Clock = std::chrono::steady_clock;
    bool quiet_;
    bool terminal_;
    bool shown_ = false;
    Clock::time_point begin_, last_;
    std::uint64_t first_step_ = 0;
    double first_fraction_ = 0.0;
    bool begun_ = false;
};
