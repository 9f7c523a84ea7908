#include "jostle/stress/active_stress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/error/refuse.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"

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
        refuse("output.active_stress_lag", fmt::format("{}", lag), "is shorter than one row of the series",
               "at least 1 row");
}

void ActiveStress::begin(const Rods& rods, const Box& box) {
    looks_ = 0;
    id_.clear();
    remember_new(rods, box);
}

void ActiveStress::stretch(const Vec3& by) {
    for (std::vector<Vec3>* remembered : {&newer_, &older_})
        for (Vec3& position : *remembered)
            for (int k = 0; k < 3; ++k) position[k] *= by[k];
}

void ActiveStress::divide(const Rods& rods, const Box& box, std::span<const Division> divisions) {
    if (divisions.empty()) return;
    know(rods);
    std::vector<Vec3> now(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) { now[index_of(rods.id[i])] = unwrapped(rods, box, i); });
    for (const Division& division : divisions) {
        const std::size_t mother = index_of(division.mother), daughter = index_of(division.daughter);
        const Vec3 apart = 0.5 * (now[daughter] - now[mother]);  // her centre was half way between the two
        for (std::vector<Vec3>* remembered : {&newer_, &older_}) {
            const Vec3 from = (*remembered)[mother];
            (*remembered)[mother] = from - apart;
            (*remembered)[daughter] = from + apart;
        }
    }
}

Mat3 ActiveStress::virial(const Rods& rods, const Box& box, std::span<const Vec3> force, const Ranks& ranks) {
    ++looks_;
    if (looks_ % lag_ == 0) {
        older_.swap(newer_);
        newer_.assign(newer_.size(), unknown);
    }
    remember_new(rods, box);
    if (looks_ < lag_) return not_a_number * identity();
    return sum_over_ranks<Mat3>(ranks, rods.size(), [&](std::size_t i) {
        const std::size_t index = index_of(rods.id[i]);
        const Vec3& from = is_known(older_[index]) ? older_[index] : newer_[index];
        return outer(unwrapped(rods, box, i) - from, force[i]);
    });
}

void ActiveStress::keep(std::uint64_t begin, std::uint64_t end) {
    const auto first = std::lower_bound(id_.begin(), id_.end(), begin) - id_.begin();
    const auto beyond = std::lower_bound(id_.begin(), id_.end(), end) - id_.begin();
    for (std::vector<Vec3>* remembered : {&newer_, &older_})
        *remembered = {remembered->begin() + first, remembered->begin() + beyond};
    id_ = {id_.begin() + first, id_.begin() + beyond};
}

/// Of an id in `id_`; or where it would stand.
std::size_t ActiveStress::index_of(std::uint64_t id) const {
    if (id < id_.size() && id_[id] == id) return id;  // where none are born and none die, ids are 0 to N - 1
    return static_cast<std::size_t>(std::lower_bound(id_.begin(), id_.end(), id) - id_.begin());
}

/// Makes places for the rods that are there, and for no other.
void ActiveStress::know(const Rods& rods) {
    const auto is_there = [&](std::uint64_t id) {
        const std::size_t index = index_of(id);
        return index < id_.size() && id_[index] == id;
    };
    const auto there = parallel_sum<std::size_t>(
        rods.size(), [&](std::size_t i) { return is_there(rods.id[i]) ? std::size_t{1} : 0; });
    if (there == rods.size() && there == id_.size()) return;
    std::vector<std::uint64_t> ids = rods.id;
    std::sort(ids.begin(), ids.end());
    std::vector<Vec3> newer(ids.size(), unknown), older(ids.size(), unknown);
    for (std::size_t k = 0; k < ids.size(); ++k) {
        if (!is_there(ids[k])) continue;
        const std::size_t index = index_of(ids[k]);
        newer[k] = newer_[index];
        older[k] = older_[index];
    }
    id_.swap(ids);
    newer_.swap(newer);
    older_.swap(older);
}

/// Where `newer_` does not know a rod, it is remembered at its present place.
void ActiveStress::remember_new(const Rods& rods, const Box& box) {
    know(rods);
    parallel_for(rods.size(), [&](std::size_t i) {
        Vec3& position = newer_[index_of(rods.id[i])];
        if (!is_known(position)) position = unwrapped(rods, box, i);
    });
}

NamedNumbers ActiveStress::to_named() const {
    NamedNumbers numbers;
    numbers["lag"] = {static_cast<double>(lag_)};
    numbers["looks"] = {static_cast<double>(looks_)};
    numbers["id"].assign(id_.begin(), id_.end());  // below 2^53
    for (const auto& [name, positions] : {std::pair{"newer", &newer_}, {"older", &older_}}) {
        std::vector<double>& coordinates = numbers[name];
        for (const Vec3& position : *positions)
            coordinates.insert(coordinates.end(), {position.x, position.y, position.z});
    }
    return numbers;
}

ActiveStress ActiveStress::from_named(const NamedNumbers& numbers) {
    const auto require = [](bool sound) {
        if (!sound)
            throw InputError({.key = "checkpoint",
                              .problem = "the positions that the active stress counts from are not whole",
                              .suggestion = "Start anew with --fresh"});
    };
    const auto values = [&](const char* name) -> std::span<const double> {
        const auto found = numbers.find(name);
        return found == numbers.end() ? std::span<const double>() : found->second;
    };
    const auto are_counts = [](std::span<const double> all) {
        return std::all_of(all.begin(), all.end(), [](double value) { return value >= 0.0 && value <= 1e16; });
    };
    const auto lag = values("lag"), looks = values("looks"), id = values("id");
    require(lag.size() == 1 && looks.size() == 1 && are_counts(lag) && are_counts(looks) && are_counts(id));
    ActiveStress stress(static_cast<std::uint64_t>(lag[0]));
    stress.looks_ = static_cast<std::uint64_t>(looks[0]);
    for (const double each : id) stress.id_.push_back(static_cast<std::uint64_t>(each));
    for (const auto& [name, positions] : {std::pair{"newer", &stress.newer_}, {"older", &stress.older_}}) {
        const auto coordinates = values(name);
        require(coordinates.size() == 3 * id.size());
        for (std::size_t k = 0; k < coordinates.size(); k += 3)
            positions->push_back({coordinates[k], coordinates[k + 1], coordinates[k + 2]});
    }
    return stress;
}

}  // namespace jostle
