#include "jostle/motion/springs.hpp"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "jostle/error/refuse.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

void require_sound_springs(std::span<const Spring> springs) {
    for (const Spring& spring : springs) {
        require_value(std::isfinite(spring.stiffness) && spring.stiffness >= 0.0, "stiffness", spring.stiffness,
                      "is no stiffness of a spring", ">= 0, finite");
        require_value(std::isfinite(spring.rest_length) && spring.rest_length >= 0.0, "rest_length", spring.rest_length,
                      "is no rest length of a spring", ">= 0, finite");
    }
}

void turn_round(std::span<Spring> springs, std::span<const std::uint64_t> ids) {
    const std::unordered_set<std::uint64_t> turned(ids.begin(), ids.end());
    if (turned.empty()) return;
    parallel_for(springs.size(), [&](std::size_t l) {
        Spring& spring = springs[l];
        if (turned.contains(spring.rod_1)) spring.s_1 = -spring.s_1;
        if (turned.contains(spring.rod_2)) spring.s_2 = -spring.s_2;
    });
}

MobilityOfRod mobility_by_id(const Rods& rods, const MobilityOperator& mobility) {
    if (rods.size() == 1) return [of_all = mobility.of_rod(0)](std::uint64_t) { return of_all; };
    std::unordered_map<std::uint64_t, std::size_t> rows;
    for (std::size_t i = 0; i < rods.size(); ++i) rows[rods.id[i]] = i;
    return [rows = std::move(rows), &mobility](std::uint64_t id) {
        const auto found = rows.find(id);
        return found == rows.end() ? RodMobility{} : mobility.of_rod(found->second);
    };
}

double spring_relaxation(std::span<const Spring> springs, const MobilityOfRod& mobility_of, double time_step) {
    std::unordered_map<std::uint64_t, double> rate;
    const auto add = [&](std::uint64_t id, double s, double stiffness) {
        const RodMobility rod = mobility_of(id);
        rate[id] += 2.0 * stiffness * std::max(rod.parallel, rod.perpendicular + s * s * rod.rotational);
    };
    for (const Spring& spring : springs) {
        add(spring.rod_1, spring.s_1, spring.stiffness);
        add(spring.rod_2, spring.s_2, spring.stiffness);
    }
    double fastest = 0.0;
    for (const auto& [id, value] : rate) fastest = std::max(fastest, value);
    return time_step * fastest;
}

}  // namespace jostle
