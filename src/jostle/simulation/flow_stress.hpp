#pragma once

#include "jostle/domain/domain.hpp"
#include "jostle/math/mat3.hpp"
#include "jostle/mobility/mobility.hpp"
#include "jostle/motion/shear_flow.hpp"
#include "jostle/rods/clock.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// Sum over rods of -B/(2 mu_r) d(n n)/dt by the flow, in the step that the clock stands before; an energy.
///
/// In a steady state it is, in the mean, V times the sum of geometric and orientation stress, at any density and rate
/// (theory, eq. 8.5): the flow turns the axes, Brownian rotation and contacts turn them back. `mobility`: of the rods.
/// Of several ranks each has its own rods, and the sum is over all.
Mat3 sum_of_flow_stresses(const Rods& rods, const MobilityOperator& mobility, const ShearFlow& flow, const Clock& clock,
                          double time_step, const Domain& domain = Domain::whole());

}  // namespace jostle
