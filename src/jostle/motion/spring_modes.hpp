#pragma once

#include <span>

#include "jostle/motion/springs.hpp"
#include "jostle/rods/spring.hpp"

namespace jostle {

/// The time in which the slowest mode of a network of springs relaxes, 0 if there are no springs (theory, section 4).
///
/// Centres of rods that springs of strength K join, each with its mean mobility over all directions: 1 over the
/// smallest rate, but for 0, of dx/dt = -M K x. A spring that noise turns is softer than its stiffness k by the random
/// walk that its chain makes: 1/K = 1/k + b^2/(d kT), with b its rest length and the arms |s_1| + |s_2|. So a pair of
/// soft springs has 1/(k (mu_1 + mu_2)), and a chain of m freely jointed links Rouse's time.
///
/// `mobility_of`: of every rod that a spring names. `kT`: 0 without noise, where springs have their stiffness alone.
/// `dimensions`: d, 2 or 3.
double slowest_spring_time(std::span<const Spring> springs, const MobilityOfRod& mobility_of, double kT,
                           int dimensions);

}  // namespace jostle
