#include "jostle/mobility/drag_mobility.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

void apply_to_rod(const RodMobility& mobility, const Vec3& axis, const Vec3& force, const Vec3& torque, Vec3& linear,
                  Vec3& angular) {
    const double along = (mobility.parallel - mobility.perpendicular) * dot(axis, force);
    linear = mobility.perpendicular * force + along * axis;
    angular = mobility.rotational * (torque - dot(axis, torque) * axis);
}

}  // namespace

DragMobility::DragMobility(DragLaw law) : law_(std::move(law)) {}

void DragMobility::update(const Rods& rods) {
    // Equal neighbours are common (all rods alike, synchronous growth): they share one evaluation. No threads: laws may
    // throw.
    std::vector<RodMobility> updated(rods.size());
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const bool same = i > 0 && rods.length[i] == rods.length[i - 1] && rods.diameter[i] == rods.diameter[i - 1];
        updated[i] = same ? updated[i - 1] : law_(rods.length[i], rods.diameter[i]);
    }
    rod_mobility_.swap(updated);
}

void DragMobility::apply(const Rods& rods, const Forces& forces, Velocities& velocities) const {
    assert(rod_mobility_.size() == rods.size() && forces.size() == rods.size());
    velocities.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        apply_to_rod(rod_mobility_[i], rods.axis[i], forces.force[i], forces.torque[i], velocities.linear[i],
                     velocities.angular[i]);
    });
}

void DragMobility::apply_square_root(const Rods& rods, const Forces& normals, Velocities& velocities) const {
    assert(rod_mobility_.size() == rods.size() && normals.size() == rods.size());
    velocities.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        const RodMobility& own = rod_mobility_[i];
        const RodMobility root = {std::sqrt(own.parallel), std::sqrt(own.perpendicular), std::sqrt(own.rotational)};
        apply_to_rod(root, rods.axis[i], normals.force[i], normals.torque[i], velocities.linear[i],
                     velocities.angular[i]);
    });
}

}  // namespace jostle
