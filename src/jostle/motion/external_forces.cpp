#include "jostle/motion/external_forces.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// In D a step, as of swimmers: the force at the surface that stops a rod is right to 1 %.
constexpr double advised_way = 0.04, farthest_way = 0.5;
/// Of a small angle, that the torque takes away in a step: thermal angles are too wide by half of it.
constexpr double automatic_turn = 0.05, advised_alignment_turn = 0.1, largest_turn = 1.0;

void require_finite(const char* key, const Vec3& vector) {
    for (const double part : {vector.x, vector.y, vector.z})
        require_value(std::isfinite(part), key, part, "is no number to reckon with", "any finite number");
}

}  // namespace

ForceOnRods::ForceOnRods(const Vec3& force, bool drives) : force_(force), drives_(drives) {
    require_finite("forces.on_rods", force);
}

std::optional<Forces> ForceOnRods::forces(const Rods& rods, const StepContext& /*context*/) const {
    Forces forces(rods.size());
    forces.force.assign(rods.size(), force_);
    return forces;
}

std::vector<StepLimit> ForceOnRods::step_limits(const Rods& rods, const MobilityOperator& mobility,
                                                std::uint64_t /*seed*/) const {
    const double force = norm(force_);
    double fastest = 0.0;  // in diameters
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const RodMobility rod = mobility.of_rod(i);
        fastest = std::max(fastest, force * std::max(rod.parallel, rod.perpendicular) / rods.diameter[i]);
    }
    return {{.key = "forces.on_rods",
             .value = fmt::format("[{:.4g}, {:.4g}, {:.4g}]", force_.x, force_.y, force_.z),
             .harm = "drags a rod through others",
             .what = "the fastest rod is dragged by",
             .unit = "D",
             .remedy = "a weaker force",
             .rate = fastest,
             .automatic = advised_way,
             .advised = advised_way,
             .largest = farthest_way}};
}

AligningTorque::AligningTorque(double energy, const Vec3& axis) : energy_(energy), axis_(axis) {
    require_value(std::isfinite(energy), "forces.alignment_energy", energy, "is no energy", "any finite number");
    require_finite("forces.alignment_axis", axis);
    require_value(norm(axis) > 0.0, "forces.alignment_axis", 0.0, "has no direction", "a vector that is not zero");
    axis_ = normalised(axis);
}

std::optional<Forces> AligningTorque::forces(const Rods& rods, const StepContext& /*context*/) const {
    Forces forces(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        const Vec3& n = rods.axis[i];
        forces.torque[i] = (2.0 * energy_ * dot(n, axis_)) * cross(n, axis_);
    });
    return forces;
}

std::vector<StepLimit> AligningTorque::step_limits(const Rods& rods, const MobilityOperator& mobility,
                                                   std::uint64_t /*seed*/) const {
    double fastest = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i)
        fastest = std::max(fastest, 2.0 * std::fabs(energy_) * mobility.of_rod(i).rotational);
    return {{.key = "forces.alignment_energy",
             .value = fmt::format("{:.4g}", energy_),
             .number = std::fabs(energy_),
             .harm = "turns rods beyond where the torque takes them",
             .what = "the part of a small angle that the torque takes away is",
             .unit = "",
             .remedy = "a weaker torque",
             .rate = fastest,
             .automatic = automatic_turn,
             .advised = advised_alignment_turn,
             .largest = largest_turn}};
}

}  // namespace jostle
