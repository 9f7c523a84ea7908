#include "jostle/statistics/equilibrium_check.hpp"

#include <fmt/format.h>

#include <algorithm>
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

/// Why the window is too short; empty where it is not. Fills in what it covers.
std::string too_short(const ProductionSeries& series, const FreeClocks& clocks, double window,
                      EquilibriumCheck& check) {
    if (clocks.diffusion > 0.0) check.diffusion_times = window / (clocks.arrest * clocks.diffusion);
    if (clocks.rotation > 0.0) {
        check.rotation_times = window / clocks.rotation;
        if (check.rotation_times < least_rotation_times)
            return covers(check.rotation_times, "rotation time", least_rotation_times);
    }
    if (!series.order.empty()) {
        check.rotation_time = clocks.rotation;
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
            return covers(check.rotation_times, "rotation time", least_rotation_times) + ", slow as the crowd is";
        const double orders =
            0.5 * static_cast<double>(series.order.size()) / correlation_time(std::span(&series.order, 1));
        if (orders < least_orders)
            return fmt::format("covers {} independent value{} of the nematic order; at least {} are needed",
                               orders < 1.0 ? "not one" : fmt::format("{:.2g}", orders), orders < 2.0 ? "" : "s",
                               least_orders);
    }
    if (clocks.flow > 0.0) check.flow_times = window / clocks.flow;
    if (clocks.flow > 0.0 && check.flow_times < least_flow_times)
        return covers(check.flow_times, "unit of strain, or period,", least_flow_times);
    if (clocks.diffusion > 0.0 && check.diffusion_times < least_diffusion_times)
        return covers(check.diffusion_times, "diffusion time", least_diffusion_times) +
               (clocks.arrest > 1.0 ? ", slow as the crowd is" : "");
    if (clocks.spreading > 0.0) check.spreading_times = window / clocks.spreading;
    if (clocks.spreading > 0.0 && check.spreading_times < least_spreading_times)
        return covers(check.spreading_times, "spreading time", least_spreading_times);
    if (clocks.volume > 0.0) check.volume_times = window / clocks.volume;
    if (clocks.volume > 0.0 && check.volume_times < least_volume_times)
        return covers(check.volume_times, "relaxation time", least_volume_times);
    return "";
}

}  // namespace

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
                                      {check.spreading_times, "spreading time"},
                                      {check.volume_times, "relaxation time"}})
        if (times > 0.0) covered += (covered.empty() ? "" : ", ") + in_times(times, what);
    return in_words(check.verdict) + (covered.empty() ? "" : ": covers " + covered);
}

}  // namespace jostle
