#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "jostle/mobility/mobility.hpp"
#include "jostle/rods/spring.hpp"

namespace jostle {

// Springs between rods: U = M F with their forces and torques as the step begins (theory, eq. 2.16). Explicit in time:
// steps must be short beside what springs need to relax, see `spring_relaxation`. Forces: rods/spring.hpp.

/// Throws InputError for a stiffness or a rest length that is negative or not finite.
void require_sound_springs(std::span<const Spring> springs);

/// Rods of these ids have exchanged head and tail: a point s along the old axis is at -s along the new one.
void turn_round(std::span<Spring> springs, std::span<const std::uint64_t> ids);

using MobilityOfRod = std::function<RodMobility(std::uint64_t id)>;

/// Of these rods; where they are one that stands for all, of that, and 0 of an id that is not there. `mobility` must
/// outlive it.
MobilityOfRod mobility_by_id(const Rods& rods, const MobilityOperator& mobility);

/// The part of its stretch that any spring loses in a step, at most: dt max over rods of 2 sum over its springs of k m
/// (theory, eq. 2.17), with m the larger mobility of the point, max(parallel, perpendicular + s^2 rotational).
///
/// Exact for two equal spheres; an upper bound of every network's rates. Above 1 springs overshoot, above 2 they may
/// blow up.
double spring_relaxation(std::span<const Spring> springs, const MobilityOfRod& mobility_of, double time_step);

}  // namespace jostle
