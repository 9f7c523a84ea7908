#include "jostle/mobility/drag_mobility.hpp"

#include <cassert>
#include <cmath>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

void apply_to_rod(const RodMobility& mobility, const Vec3& axis, const Vec3& force, const Vec3& torque, Vec3& linear,
                  Vec3& angular) {
    const double more_along = (mobility.parallel - mobility.perpendicular) * dot(axis, force);
    linear = mobility.perpendicular * force + more_along * axis;
    angular = mobility.rotational * (torque - dot(axis, torque) * axis);
}

}  // namespace

DragMobility::DragMobility(DragLaw law) : law_(std::move(law)) {}

void DragMobility::update(const Rods& rods) {
    // Equal neighbours are common (all rods alike, synchronous growth): they share one kind.
    std::vector<std::uint32_t> kind(rods.size()), first;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const bool same = i > 0 && rods.length[i] == rods.length[i - 1] && rods.diameter[i] == rods.diameter[i - 1];
        if (!same) first.push_back(static_cast<std::uint32_t>(i));
        kind[i] = static_cast<std::uint32_t>(first.size() - 1);
    }
    std::vector<Kind> kinds(first.size());
    const auto ask = [&](std::size_t k) {
        const RodMobility own = law_(rods.length[first[k]], rods.diameter[first[k]]);
        kinds[k] = {own, {std::sqrt(own.parallel), std::sqrt(own.perpendicular), std::sqrt(own.rotational)}};
    };
    try {
        parallel_for(kinds.size(), ask);
    } catch (const InputError&) {  // of the first rod that the law refuses, whichever thread came first
        for (std::size_t k = 0; k < kinds.size(); ++k) ask(k);
    }
    kind_.swap(kind);
    kinds_.swap(kinds);
}

void DragMobility::apply(const Rods& rods, const Forces& forces, Velocities& velocities) const {
    assert(kind_.size() == rods.size() && forces.size() == rods.size());
    velocities.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        apply_to_rod(kinds_[kind_[i]].own, rods.axis[i], forces.force[i], forces.torque[i], velocities.linear[i],
                     velocities.angular[i]);
    });
}

void DragMobility::add_square_root(const Rods& rods, std::size_t first, std::span<const Normals> normals, double scale,
                                   Velocities& velocities) const {
    assert(kind_.size() == rods.size() && velocities.size() == rods.size() && first + normals.size() <= rods.size());
    parallel_for(normals.size(), [&](std::size_t k) {
        const std::size_t i = first + k;
        const Normals& xi = normals[k];
        Vec3 linear, angular;
        apply_to_rod(kinds_[kind_[i]].root, rods.axis[i], {xi[0], xi[1], xi[2]}, {xi[3], xi[4], xi[5]}, linear,
                     angular);
        velocities.linear[i] += scale * linear;
        velocities.angular[i] += scale * angular;
    });
}

}  // namespace jostle
