#include "jostle/measurement/stress_ratio_checks.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/math/symmetric_eigen.hpp"
#include "jostle/measurement/stress_columns.hpp"
#include "jostle/statistics/jackknife.hpp"
#include "jostle/statistics/order_parameter.hpp"
#include "jostle/stress/spherocylinder_moments.hpp"

namespace jostle {

namespace {

using Json = nlohmann::ordered_json;

/// Standard errors between what is measured and what equilibrium has that are still called agreement (false alarm
/// 6e-5).
constexpr double agreement = 4.0;
/// The same where the direction is chance (theory, section 1): chi of five degrees of freedom for a normal variable, or
/// of two in the plane.
constexpr double agreement_along_chance = 5.2, agreement_along_chance_in_plane = 4.4;

Mat3 order_of(std::span<const double> means) {
    const auto q = means.first(6);
    return Mat3{{q[0], q[1], q[2], q[1], q[3], q[4], q[2], q[4], q[5]}};
}

double along(const Mat3& tensor, const Vec3& direction) {
    return dot(direction, tensor * direction);
}

/// A stress along a direction over that across it.
double stress_ratio(std::span<const double> means, const Vec3& direction, int dimensions) {
    const Mat3 tensor = stress_of(means);
    const double parallel = along(tensor, direction);
    return (dimensions - 1) * parallel / (trace(tensor) - parallel);
}

/// What a ratio may be in equilibrium.
struct RatioRange {
    double from, to;
};

/// `error` of the difference between the two, which agree within `limit` of it.
Json ratio_check(const std::string& definition, const Estimate& measured, const RatioRange& in_equilibrium,
                 const std::optional<double>& error, double limit) {
    const double difference = measured.value - std::clamp(measured.value, in_equilibrium.from,
                                                          std::max(in_equilibrium.from, in_equilibrium.to));
    const auto finite = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
    return {{"definition", definition},
            {"measured", described(measured)},
            {"in_equilibrium", {{"from", finite(in_equilibrium.from)}, {"to", finite(in_equilibrium.to)}}},
            {"difference", finite(difference)},
            {"standard_error", optional_number(error)},
            {"agree", error ? Json(std::fabs(difference) <= limit * *error) : Json(nullptr)}};
}

}  // namespace

MeanDirector mean_director(const Columns& order) {
    std::array<double, 6> mean{};
    for (std::size_t k = 0; k < 6; ++k) mean[k] = column_mean(order[k]);
    const auto eigen = symmetric_eigen(order_of(mean));
    return {eigen.vectors[2], eigen.values[2]};
}

Json check_of_one(const std::string& definition, const Estimate& measured) {
    return ratio_check(definition, measured, {1.0, 1.0}, measured.standard_error, agreement);
}

Json total_stress_ratio_check(const Columns& stress, const Columns& order, int dimensions) {
    const MeanDirector director = mean_director(order);
    const Estimate measured = jackknife(
        stress, [&](std::span<const double> means) { return stress_ratio(means, director.direction, dimensions); });
    const double chance = dimensions == 2 ? agreement_along_chance_in_plane : agreement_along_chance;
    return ratio_check("total stress along the mean director of the rods over that across it", measured, {1.0, 1.0},
                       measured.standard_error, director.order < nematic_above ? chance : agreement);
}

Json collision_stress_ratio_check(const Columns& stress, const Columns& order, const std::vector<double>& Z,
                                  double aspect_ratio, int dimensions) {
    const double B = moment_anisotropy(aspect_ratio);
    const MeanDirector director = mean_director(order);
    const auto of_stress = [&](std::span<const double> means) {
        return stress_ratio(means, director.direction, dimensions);
    };
    const auto of_order = [&](std::span<const double> means) {  // order tensor, Z
        const double S = along(order_of(means), director.direction);
        return (means[6] - 1.0 + (dimensions - 1) * B * S) / (means[6] - 1.0 - B * S);
    };
    Columns order_and_Z = order;
    order_and_Z.push_back(Z);
    const Estimate measured = jackknife(stress, of_stress);
    const double predicted = jackknife(order_and_Z, of_order).value;
    const char* definition = "collision stress along the mean director of the rods over that across it";
    // In a nematic, order and stress fluctuate together. The mean order of an isotropic run is chance, and slow: the
    // part of it that the stress follows is between none, in a dilute state, and all, close to the transition.
    if (director.order < nematic_above)
        return ratio_check(definition, measured, {1.0, predicted}, measured.standard_error, agreement);
    Columns all = stress;
    all.insert(all.end(), order_and_Z.begin(), order_and_Z.end());
    const Estimate difference = jackknife(
        all, [&](std::span<const double> means) { return of_stress(means.first(9)) - of_order(means.subspan(9)); });
    return ratio_check(definition, measured, {predicted, predicted}, difference.standard_error, agreement);
}

}  // namespace jostle
