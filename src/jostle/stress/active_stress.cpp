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
    id_.clear();
    remember_new(rods, box);
}

void ActiveStress::divide(const Rods& rods, const Box& box, std::span<const Division> divisions) {
    if (divisions.empty()) return;
    know(rods);
    std::vector<Vec3> now(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) { now[place_of(rods.id[i])] = unwrapped(rods, box, i); });
    for (const Division& division : divisions) {
        const std::size_t mother = place_of(division.mother), daughter = place_of(division.daughter);
        const Vec3 apart = 0.5 * (now[daughter] - now[mother]);  // her centre was half way between the two
        for (std::vector<Vec3>* remembered : {&newer_, &older_}) {
            const Vec3 from = (*remembered)[mother];
            (*remembered)[mother] = from - apart;
            (*remembered)[daughter] = from + apart;
        }
    }
}

Mat3 ActiveStress::virial(const Rods& rods, const Box& box, std::span<const Vec3> force) {
    ++looks_;
    if (looks_ % lag_ == 0) {
        older_.swap(newer_);
        newer_.assign(newer_.size(), unknown);
    }
    remember_new(rods, box);
    if (looks_ < lag_) return not_a_number * identity();
    return parallel_sum<Mat3>(rods.size(), [&](std::size_t i) {
        const std::size_t place = place_of(rods.id[i]);
        const Vec3& from = is_known(older_[place]) ? older_[place] : newer_[place];
        return outer(unwrapped(rods, box, i) - from, force[i]);
    });
}

/// Of an id in `id_`; or where it would stand.
std::size_t ActiveStress::place_of(std::uint64_t id) const {
    if (id < id_.size() && id_[id] == id) return id;  // where none are born and none die, ids are 0 to N - 1
    return static_cast<std::size_t>(std::lower_bound(id_.begin(), id_.end(), id) - id_.begin());
}

/// Makes places for the rods that are there, and for no other.
void ActiveStress::know(const Rods& rods) {
    const auto is_there = [&](std::uint64_t id) {
        const std::size_t place = place_of(id);
        return place < id_.size() && id_[place] == id;
    };
    const auto there = parallel_sum<std::size_t>(
        rods.size(), [&](std::size_t i) { return is_there(rods.id[i]) ? std::size_t{1} : 0; });
    if (there == rods.size() && there == id_.size()) return;
    std::vector<std::uint64_t> ids = rods.id;
    std::sort(ids.begin(), ids.end());
    std::vector<Vec3> newer(ids.size(), unknown), older(ids.size(), unknown);
    for (std::size_t k = 0; k < ids.size(); ++k) {
        if (!is_there(ids[k])) continue;
        const std::size_t place = place_of(ids[k]);
        newer[k] = newer_[place];
        older[k] = older_[place];
    }
    id_.swap(ids);
    newer_.swap(newer);
    older_.swap(older);
}

/// Where `newer_` does not know a rod, it is remembered at its present place.
void ActiveStress::remember_new(const Rods& rods, const Box& box) {
    know(rods);
    parallel_for(rods.size(), [&](std::size_t i) {
        Vec3& position = newer_[place_of(rods.id[i])];
        if (!is_known(position)) position = unwrapped(rods, box, i);
    });
}

std::vector<double> ActiveStress::to_numbers() const {
    std::vector<double> numbers = {static_cast<double>(lag_), static_cast<double>(looks_)};
    for (std::size_t k = 0; k < id_.size(); ++k) {
        numbers.push_back(static_cast<double>(id_[k]));  // ids are below 2^53
        for (const Vec3& position : {newer_[k], older_[k]})
            numbers.insert(numbers.end(), {position.x, position.y, position.z});
    }
    return numbers;
}

ActiveStress ActiveStress::from_numbers(std::span<const double> numbers) {
    constexpr std::size_t first = 2, each = 7;
    const auto is_count = [](double value) { return value >= 0.0 && value <= 1e16; };  // false for nan
    bool whole = numbers.size() >= first && (numbers.size() - first) % each == 0;
    for (std::size_t k = 0; whole && k < numbers.size(); k += k < first ? 1 : each) whole = is_count(numbers[k]);
    if (!whole)
        throw InputError({.key = "checkpoint",
                          .problem = "the positions that the active stress counts from are not whole",
                          .suggestion = "Start anew with --fresh"});
    ActiveStress stress(static_cast<std::uint64_t>(numbers[0]));
    stress.looks_ = static_cast<std::uint64_t>(numbers[1]);
    for (std::size_t k = first; k < numbers.size(); k += each) {
        stress.id_.push_back(static_cast<std::uint64_t>(numbers[k]));
        stress.newer_.push_back({numbers[k + 1], numbers[k + 2], numbers[k + 3]});
        stress.older_.push_back({numbers[k + 4], numbers[k + 5], numbers[k + 6]});
    }
    return stress;
}

}  // namespace jostle
