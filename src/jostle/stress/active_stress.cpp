#include "jostle/stress/active_stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr Vec3 unknown{not_a_number, not_a_number, not_a_number};

bool is_known(const Vec3& position) {
    return !std::isnan(position.x);
}

Vec3 unwrapped(const Rods& rods, const Box& box, std::size_t i) {
    return rods.centre[i] + box.displacement(rods.image[i]);
}

}  // namespace

ActiveStress::ActiveStress(std::uint64_t lag) : lag_(lag) {
    if (lag == 0)
        throw InputError({.key = "output.active_stress_lag",
                          .value = fmt::format("{}", lag),
                          .problem = "is shorter than one row of the series",
                          .allowed = "at least 1 row",
                          .suggestion = {},
                          .place = {}});
}

void ActiveStress::begin(const Rods& rods, const Box& box) {
    looks_ = 0;
    newer_.clear();
    older_.clear();
    remember_new(rods, box);
}

Mat3 ActiveStress::virial(const Rods& rods, const Box& box, std::span<const Vec3> force) {
    ++looks_;
    if (looks_ % lag_ == 0) {
        older_.swap(newer_);
        newer_.clear();
    }
    remember_new(rods, box);
    if (looks_ < lag_) return not_a_number * identity();
    return parallel_sum<Mat3>(rods.size(), [&](std::size_t i) {
        const std::uint64_t id = rods.id[i];
        const Vec3& from = is_known(older_[id]) ? older_[id] : newer_[id];
        return outer(unwrapped(rods, box, i) - from, force[i]);
    });
}

/// Where `newer_` does not know a rod, it is remembered at its present place.
void ActiveStress::remember_new(const Rods& rods, const Box& box) {
    std::uint64_t ids = newer_.size();
    for (const std::uint64_t id : rods.id) ids = std::max(ids, id + 1);
    newer_.resize(ids, unknown);
    older_.resize(ids, unknown);
    parallel_for(rods.size(), [&](std::size_t i) {
        Vec3& position = newer_[rods.id[i]];
        if (!is_known(position)) position = unwrapped(rods, box, i);
    });
}

std::vector<double> ActiveStress::to_numbers() const {
    std::vector<double> numbers = {static_cast<double>(lag_), static_cast<double>(looks_)};
    for (std::size_t id = 0; id < newer_.size(); ++id)
        for (const Vec3& position : {newer_[id], older_[id]})
            numbers.insert(numbers.end(), {position.x, position.y, position.z});
    return numbers;
}

ActiveStress ActiveStress::from_numbers(std::span<const double> numbers) {
    constexpr std::size_t first = 2, each = 6;
    if (numbers.size() < first || (numbers.size() - first) % each != 0)
        throw InputError({.key = "checkpoint",
                          .problem = "the positions that the active stress counts from are not whole",
                          .suggestion = "Start anew with --fresh"});
    ActiveStress stress(static_cast<std::uint64_t>(numbers[0]));
    stress.looks_ = static_cast<std::uint64_t>(numbers[1]);
    for (std::size_t k = first; k < numbers.size(); k += each) {
        stress.newer_.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
        stress.older_.push_back({numbers[k + 3], numbers[k + 4], numbers[k + 5]});
    }
    return stress;
}

}  // namespace jostle
