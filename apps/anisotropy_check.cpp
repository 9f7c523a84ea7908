#include "anisotropy_check.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/io/series_columns.hpp"
#include "jostle/math/symmetric_eigen.hpp"
#include "jostle/statistics/jackknife.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

using namespace jostle;
using Json = nlohmann::ordered_json;

namespace {

/// Standard errors between measured and predicted anisotropy that are still called agreement (false alarm 6e-5).
constexpr double agreement = 4.0;
/// Order above which a run is a nematic. Isotropic phases of rods end below.
constexpr double nematic_above = 0.4;

Mat3 order_of(std::span<const double> means) {
    const auto q = means.first(6);
    return Mat3{{q[0], q[1], q[2], q[1], q[3], q[4], q[2], q[4], q[5]}};
}

double along(const Mat3& tensor, const Vec3& direction) {
    return dot(direction, tensor * direction);
}

}  // namespace

Mat3 stress_of(std::span<const double> means) {
    Mat3 tensor;
    std::copy(means.begin(), means.begin() + 9, tensor.m.begin());
    return tensor;
}

MeanDirector mean_director(const Columns& order) {
    std::array<double, 6> mean{};
    for (std::size_t k = 0; k < 6; ++k) mean[k] = mean_of(order[k]);
    const auto eigen = symmetric_eigen(order_of(mean));
    return {eigen.vectors[2], eigen.values[2]};
}

Json anisotropy_oracle(const SeriesTable& series, std::size_t first, const Rods& rods, const Columns& stress) {
    const double B = moment_anisotropy(rods.length.front() / rods.diameter.front());
    const Columns order = window_columns(series, first, order_tensor_column_names);
    const MeanDirector director = mean_director(order);
    const auto of_stress = [&](std::span<const double> means) {
        const Mat3 tensor = stress_of(means);
        const double parallel = along(tensor, director.direction);
        return 2.0 * parallel / (trace(tensor) - parallel);
    };
    const auto of_order = [&](std::span<const double> means) {  // order tensor, Z
        const double S = along(order_of(means), director.direction);
        return (means[6] - 1.0 + 2.0 * B * S) / (means[6] - 1.0 - B * S);
    };
    Columns order_and_Z = order;
    order_and_Z.push_back(from_row(series.column("Z"), first));
    Columns all = stress;
    all.insert(all.end(), order_and_Z.begin(), order_and_Z.end());

    const Estimate measured = jackknife(stress, of_stress);
    const Estimate predicted = jackknife(order_and_Z, of_order);
    // In a nematic, order and stress fluctuate together. The mean order of an isotropic run is chance, and slow: the
    // part of it that the stress follows is between none, in a dilute state, and all, close to the transition.
    double expected = predicted.value;
    std::optional<double> error;
    if (director.order < nematic_above) {
        expected = std::clamp(measured.value, 1.0, std::max(1.0, predicted.value));
        error = measured.standard_error;
    } else {
        error = jackknife(all, [&](std::span<const double> means) {
                    return of_stress(means.first(9)) - of_order(means.subspan(9));
                }).standard_error;
    }
    const double difference = measured.value - expected;
    return {{"measured", described(measured)},
            {"predicted", described(predicted)},
            {"difference", std::isfinite(difference) ? Json(difference) : Json(nullptr)},
            {"standard_error", optional_number(error)},
            {"agree", error ? Json(std::fabs(difference) <= agreement * *error) : Json(nullptr)}};
}
