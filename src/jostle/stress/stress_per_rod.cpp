#include "jostle/stress/stress_per_rod.hpp"

#include <algorithm>
#include <cassert>

namespace jostle {

std::vector<Mat3> stress_per_rod(const CollisionMoments& moments, std::span<const std::uint64_t> ids) {
    assert(std::is_sorted(ids.begin(), ids.end()));
    std::vector<Mat3> stress(ids.size());
    const auto give = [&](std::uint64_t id, const Mat3& part) {
        const auto found = std::lower_bound(ids.begin(), ids.end(), id);
        if (found != ids.end() && *found == id) stress[static_cast<std::size_t>(found - ids.begin())] += part;
    };
    for (const CollisionMoments::Pair& pair : moments.pairs) {
        const bool alone = is_id_of_fixed(pair.id_i);
        const Mat3 part = (alone ? 1.0 : 0.5) * pair.moment();
        if (!alone) give(pair.id_i, part);
        give(pair.id_j, part);
    }
    for (const CollisionMoments::Body& body : moments.bodies) give(body.id, body.geometric);
    return stress;
}

}  // namespace jostle
