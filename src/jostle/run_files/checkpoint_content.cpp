#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "jostle/math/range.hpp"
#include "jostle/rods/clock.hpp"
#include "jostle/run_files/checkpoint.hpp"

namespace jostle {

namespace {

/// Of centres and edges: rounding when a rod is wrapped.
constexpr double rounding = 1e-9;
/// Rods that leave an open box go as many of its edges at most; farther ones would be in no cell of a grid.
constexpr double max_edges_away = 1e12;
/// Of |axis|^2 from 1.
constexpr double axis_tolerance = 1e-6;
constexpr std::uint64_t max_ids = std::uint64_t{1} << 53;  ///< as a double tells them apart

/// Collects the first problem.
class ContentCheck {
public:
    const std::string& problem() const { return problem_; }

    void require(bool sound, std::string_view what, double value) {
        if (!sound && problem_.empty()) problem_ = fmt::format("{} = {}", what, value);
    }
    void require_of_rod(bool sound, std::string_view what, std::size_t row, double value) {
        if (!sound) require(false, fmt::format("{} in row {}", what, row), value);
    }

private:
    std::string problem_;
};

bool within(double value, double lower, double upper) {
    return value >= lower && value <= upper;  // false for nan
}
bool is_zero_or_positive(double value) {
    return within(value, 0.0, Range::largest);
}

void check_box(const Box& box, ContentCheck& check) {
    check.require(box.dimensions() == 3 || !box.periodic()[2], "periodic along z in a flat box", 1.0);
    for (int k = 0; k < box.dimensions(); ++k)
        check.require(within(box.edges()[k], Range::smallest, Range::largest), "edge of the box", box.edges()[k]);
    check.require(within(std::fabs(box.offset()), 0.0, box.edges().x), "offset of the box", box.offset());
}

void check_rods(const Rods& rods, const Box& box, ContentCheck& check) {
    const double farthest = max_edges_away * box.longest_edge();
    for (std::size_t i = 0; i < rods.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const bool wrapped = box.periodic()[static_cast<std::size_t>(k)];
            const double lower = wrapped ? -rounding * box.edges()[k] : -farthest;
            const double upper = wrapped ? (1.0 + rounding) * box.edges()[k] : farthest;
            check.require_of_rod(within(rods.centre[i][k], lower, upper), "centre", i, rods.centre[i][k]);
        }
        if (box.dimensions() == 2) {
            check.require_of_rod(rods.centre[i].z == 0.0, "z in a flat box", i, rods.centre[i].z);
            check.require_of_rod(rods.axis[i].z == 0.0, "nz in a flat box", i, rods.axis[i].z);
        }
        const double squared = squared_norm(rods.axis[i]);
        check.require_of_rod(within(squared, 1.0 - axis_tolerance, 1.0 + axis_tolerance), "|axis|^2", i, squared);
        check.require_of_rod(is_zero_or_positive(rods.length[i]), "length", i, rods.length[i]);
        check.require_of_rod(within(rods.diameter[i], Range::smallest, Range::largest), "diameter", i,
                             rods.diameter[i]);
        if (!rods.speed.empty())
            check.require_of_rod(within(rods.speed[i], -Range::largest, Range::largest), "speed", i, rods.speed[i]);
        if (rods.cycle.empty()) continue;
        const CellCycle& cycle = rods.cycle[i];
        for (const double value : {cycle.growth_rate, cycle.division_at, cycle.share})
            check.require_of_rod(is_zero_or_positive(value), "growth", i, value);
    }
}

/// Each once; where nothing grows they are 0 to N - 1.
void check_ids(const Rods& rods, ContentCheck& check) {
    std::vector<std::uint64_t> ids = rods.id;
    std::sort(ids.begin(), ids.end());
    const auto twice = std::adjacent_find(ids.begin(), ids.end());
    if (twice != ids.end()) check.require(false, "an id of two rods", static_cast<double>(*twice));
    const std::uint64_t end = rods.cycle.empty() ? rods.size() : max_ids;
    if (!ids.empty()) check.require(ids.back() < end, "id of a rod", static_cast<double>(ids.back()));
}

void check_springs(const std::vector<Spring>& springs, std::size_t rods, ContentCheck& check) {
    for (const Spring& spring : springs) {
        for (const std::uint64_t rod : {spring.rod_1, spring.rod_2})
            check.require(rod < rods, "rod of a spring", static_cast<double>(rod));
        for (const double place : {spring.s_1, spring.s_2})
            check.require(within(place, -Range::largest, Range::largest), "place of a spring", place);
        check.require(is_zero_or_positive(spring.rest_length), "rest length of a spring", spring.rest_length);
        check.require(is_zero_or_positive(spring.stiffness), "stiffness of a spring", spring.stiffness);
    }
}

}  // namespace

std::string impossible_content(const Checkpoint& checkpoint) {
    ContentCheck check;
    check.require(checkpoint.state.clock.step <= max_steps, "step", static_cast<double>(checkpoint.state.clock.step));
    check.require(is_zero_or_positive(checkpoint.state.clock.time), "time", checkpoint.state.clock.time);
    check_box(checkpoint.state.box, check);
    check_rods(checkpoint.state.rods, checkpoint.state.box, check);
    check_ids(checkpoint.state.rods, check);
    check_springs(checkpoint.state.springs, checkpoint.state.rods.size(), check);
    for (const PreviousForce& force : checkpoint.state.previous_forces)
        check.require(is_zero_or_positive(force.gamma), "contact force", force.gamma);
    return check.problem();
}

}  // namespace jostle
