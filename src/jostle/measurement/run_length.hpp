#pragma once

#include <cstddef>

#include "jostle/run_files/series_file.hpp"
#include "jostle/scene/scene.hpp"
#include "jostle/statistics/equilibrium_check.hpp"

namespace jostle {

/// Where equilibration has to be detected, a run that has not settled after this many times `production` ends anyhow.
inline constexpr double longest_run_in_productions = 10.0;

/// Decides, from the series alone, when a run has all that it was asked for.
class RunLength {
public:
    /// `begin`: time at which the first row of the series that will be shown begins.
    RunLength(const Scene& scene, double time_step, const FreeClocks& clocks, double begin = 0.0);

    bool is_over(const SeriesTable& series);

    /// From 0 to 1; with equilibration to be detected, as if it took a quarter of the production.
    double fraction_done(std::size_t rows) const;

private:
    Scene scene_;
    double begin_;
    FreeClocks clocks_;
    bool can_be_long_enough_ = true;  ///< else more time would only end in the same words
    std::size_t production_rows_ = 1;
    std::size_t rows_of_schedule_ = 0;
    std::size_t fixed_rows_ = 0;   ///< 0: equilibration is detected
    std::size_t rows_before_ = 0;  ///< `begin`
    std::size_t rows_looked_at_ = 0;
};

}  // namespace jostle
