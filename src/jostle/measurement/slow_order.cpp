#include "jostle/measurement/slow_order.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "jostle/measurement/summary_entries.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/stress/column_names.hpp"

namespace jostle {

namespace {

/// sum_ab Q_ab^2, row by row, from xx xy xz yy yz zz.
std::vector<double> squared(const Columns& tensor) {
    std::vector<double> rows(tensor[0].size());
    for (std::size_t k = 0; k < tensor.size(); ++k) {
        const double times = k == 0 || k == 3 || k == 5 ? 1.0 : 2.0;
        for (std::size_t row = 0; row < rows.size(); ++row) rows[row] += times * tensor[k][row] * tensor[k][row];
    }
    return rows;
}

}  // namespace

std::optional<SlowColumn> slow_order(const ProductionWindow& window, const SeriesTable& series, double row_time,
                                     int dimensions) {
    const double rotation_time = window.equilibrium.rotation_time;
    if (!(rotation_time > 0.0) || !std::isfinite(rotation_time)) return std::nullopt;
    const double decay = rotation_time / tensor_decays_per_rotation(dimensions) / row_time;
    SlowColumn order{from_row(series.column("nematic_order"), window.first_row), decay, true};
    if (column_mean(order.rows) < nematic_above)
        order = {squared(window_columns(series, window.first_row, order_tensor_column_names)), 0.5 * decay, false};
    const double shown = correlation_time(std::span(&order.rows, 1));
    if (!std::isfinite(shown) || shown <= order.correlation_time) return order;
    return SlowColumn{std::move(order.rows), shown, false};
}

}  // namespace jostle
