#include "jostle/measurement/run_length.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/measurement/production_window.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

/// How often, in parts of the production time, it is looked whether the series has settled.
constexpr std::size_t looks_per_production = 20;

}  // namespace

RunLength::RunLength(const Scene& scene, double time_step, const FreeClocks& clocks, double begin)
    : scene_(scene), begin_(begin), clocks_(clocks) {
    const double row_time = time_step * static_cast<double>(scene.output.series_every);
    const auto rows = [&](double time) { return static_cast<std::size_t>(std::ceil(time / row_time - 1e-9)); };
    production_rows_ = std::max<std::size_t>(1, rows(scene.time.production));
    rows_of_schedule_ = rows(schedule_end(scene));
    if (scene.time.equilibration) fixed_rows_ = rows(*scene.time.equilibration) + production_rows_;
    rows_before_ = static_cast<std::size_t>(std::max(0.0, std::round(begin / row_time)));
    can_be_long_enough_ = longest_run_in_productions * scene.time.production >= shortest_window(clocks);
}

bool RunLength::is_over(const SeriesTable& series) {
    if (fixed_rows_ > 0) return rows_before_ + series.rows() >= fixed_rows_;
    if (series.rows() < production_rows_ || series.rows() == rows_looked_at_) return false;
    rows_looked_at_ = series.rows();
    const std::size_t look_every = std::max<std::size_t>(1, production_rows_ / looks_per_production);
    if (series.rows() % look_every != 0) return false;
    const ProductionWindow window = production_window(scene_, series, clocks_, begin_);
    const bool complete = series.rows() - window.first_row >= production_rows_;
    if (complete && (window.equilibrated() || !can_be_long_enough_)) return true;
    return static_cast<double>(series.rows()) >=
           longest_run_in_productions * static_cast<double>(production_rows_) + static_cast<double>(rows_of_schedule_);
}

double RunLength::fraction_done(std::size_t rows) const {
    const double expected = fixed_rows_ > 0
                                ? static_cast<double>(fixed_rows_)
                                : 1.25 * static_cast<double>(production_rows_) + static_cast<double>(rows_of_schedule_);
    return std::min(1.0, static_cast<double>(rows_before_ + rows) / expected);
}

}  // namespace jostle
