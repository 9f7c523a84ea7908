#include "jostle/statistics/equilibrium_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "jostle/statistics/drift.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/statistics/time_series.hpp"

namespace jostle {

namespace {

using Columns = std::vector<std::vector<double>>;
using Verdict = EquilibriumCheck::Verdict;

constexpr double least_orders = 8.0;  // independent values of S

/// Rows in which the order tensor forgets itself; the sum over all nine elements knows no direction.
double decay_of_tensor(Columns tensor) {
    for (const std::size_t off_diagonal : {1, 2, 4})
        for (double& value : tensor[off_diagonal]) value *= std::numbers::sqrt2;
    return correlation_time(tensor);
}

/// Of the watched columns and the order the first one that drifts.
std::string drifting_column(const ProductionSeries& series) {
    const auto drifts = [](const WatchedColumn& column) {
        const Drift found = drift(column.rows);
        if (!found.is_significant()) return std::string();
        return fmt::format("the {} changes by {:.3g} +- {:.2g} over the window", column.name, found.change,
                           found.standard_error);
    };
    for (const WatchedColumn& column : series.watched)
        if (std::string found = drifts(column); !found.empty()) return found;
    return series.order.empty() ? "" : drifts({"nematic order", series.order});
}

std::string covers(double number, const char* what, double least) {
    return fmt::format("covers {}; at least {} are needed", in_times(number, what), least);
}

struct Clock {
    double time;
    double least;      ///< of its times a window has to cover
    const char* what;  ///< "diffusion time"
    double EquilibriumCheck::*times;
    const char* why = "";  ///< at the end of the sentence
};

constexpr const char* crowded = ", slow as the crowd is";

Clock clock_of_rotation(const FreeClocks& clocks) {
    return {clocks.rotation, least_rotation_times, "rotation time", &EquilibriumCheck::rotation_times};
}

std::array<Clock, 6> other_clocks(const FreeClocks& clocks) {
    using Check = EquilibriumCheck;
    return {{{clocks.flow, least_flow_times, "unit of strain, or period,", &Check::flow_times},
             {clocks.arrest * clocks.diffusion, least_diffusion_times, "diffusion time", &Check::diffusion_times,
              clocks.arrest > 1.0 ? crowded : ""},
             {clocks.passing, least_passing_times, "passing time", &Check::passing_times},
             {clocks.spreading, least_spreading_times, "spreading time", &Check::spreading_times},
             {clocks.volume, least_volume_times, "relaxation time", &Check::volume_times},
             {clocks.springs, least_spring_times, "spring relaxation time", &Check::spring_times}}};
}

/// Why the window is too short; empty where it is not. Fills in what it covers.
std::string too_short(const ProductionSeries& series, const FreeClocks& clocks, double window,
                      EquilibriumCheck& check) {
    const auto by = [window, &check](const Clock& clock) {
        if (clock.time > 0.0) check.*clock.times = window / clock.time;
        return clock.time > 0.0 && check.*clock.times < clock.least
                   ? covers(check.*clock.times, clock.what, clock.least) + clock.why
                   : std::string();
    };
    const std::string by_rotation = by(clock_of_rotation(clocks));
    std::string by_others;
    for (const Clock& clock : other_clocks(clocks))
        if (std::string short_of = by(clock); by_others.empty()) by_others = std::move(short_of);
    if (!series.order.empty()) check.rotation_time = clocks.rotation;
    if (!by_rotation.empty()) return by_rotation;
    if (!series.order.empty()) {
        if (average(series.order).mean < nematic_above) {
            const double decay =
                tensor_decays_per_rotation(series.dimensions) * decay_of_tensor(series.order_tensor) * series.row_time;
            check.rotation_time = std::max(clocks.rotation, decay);
            check.rotation_times = window / check.rotation_time;
            if (!std::isfinite(decay))
                return fmt::format("crowded as they are, the rods have turned fewer than {} times",
                                   least_rotation_times);
        } else if (clocks.rotation > 0.0) {
            check.rotation_time = clocks.slowdown * clocks.rotation;
            check.rotation_times = window / check.rotation_time;
        }
        if (check.rotation_time > 0.0 && check.rotation_times < least_rotation_times)
            return covers(check.rotation_times, "rotation time", least_rotation_times) + crowded;
        const double orders =
            0.5 * static_cast<double>(series.order.size()) / correlation_time(std::span(&series.order, 1));
        if (orders < least_orders)
            return fmt::format("covers {} independent value{} of the nematic order; at least {} are needed",
                               orders < 1.0 ? "not one" : fmt::format("{:.2g}", orders), orders < 2.0 ? "" : "s",
                               least_orders);
    }
    return by_others;
}

}  // namespace

double shortest_window(const FreeClocks& clocks) {
    const Clock rotation = clock_of_rotation(clocks);
    double shortest = rotation.least * rotation.time;
    for (const Clock& clock : other_clocks(clocks)) shortest = std::max(shortest, clock.least * clock.time);
    return shortest;
}

EquilibriumCheck check_equilibrium(const ProductionSeries& series, const FreeClocks& clocks) {
    EquilibriumCheck check;
    const std::size_t rows = series.watched.empty() ? 0 : series.watched.front().rows.size();
    const double window = static_cast<double>(rows) * series.row_time;
    check.reason = too_short(series, clocks, window, check);
    check.verdict = Verdict::too_short;
    if (!check.reason.empty()) return check;
    check.reason = drifting_column(series);
    check.verdict = check.reason.empty() ? Verdict::reached : Verdict::drifting;
    return check;
}

std::string in_times(double number, const std::string& what) {
    return number < 1.0 ? fmt::format("{:.2g} of a {}", number, what) : fmt::format("{:.3g} {}s", number, what);
}

std::string in_words(Verdict verdict) {
    switch (verdict) {
        case Verdict::reached:
            return "reached";
        case Verdict::drifting:
            return "not reached";
        case Verdict::too_short:
            return "too short to tell";
        case Verdict::not_checked:
            break;
    }
    return "not checked";
}

std::string in_words(const EquilibriumCheck& check) {
    if (!check.reason.empty()) return in_words(check.verdict) + ": " + check.reason;
    std::string covered;
    for (const auto& [times, what] : {std::pair{check.rotation_times, "rotation time"},
                                      {check.diffusion_times, "diffusion time"},
                                      {check.passing_times, "passing time"},
                                      {check.spreading_times, "spreading time"},
                                      {check.volume_times, "relaxation time"},
                                      {check.spring_times, "spring relaxation time"}})
        if (times > 0.0) covered += (covered.empty() ? "" : ", ") + in_times(times, what);
    return in_words(check.verdict) + (covered.empty() ? "" : ": covers " + covered);
}

}  // namespace jostle
