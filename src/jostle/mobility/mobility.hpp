#pragma once

#include <span>

#include "jostle/math/random.hpp"
#include "jostle/rods/forces.hpp"
#include "jostle/rods/rod_mobility.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// The linear map from forces on the rods to their velocities: symmetric, positive semi-definite.
///
/// The only thing that the contact problem knows of the fluid. `rods` in the calls are those of the last `update`.
class Mobility {
public:
    virtual ~Mobility() = default;

    /// Takes over the present lengths and diameters; to be called whenever these change (not when rods move).
    virtual void update(const Rods& rods) = 0;

    /// velocities = M forces, for the present axes of `rods`.
    virtual void apply(const Rods& rods, const Forces& forces, Velocities& velocities) const = 0;

    /// velocities += scale B xi with B B^T = M, where `normals` holds the standard normal numbers xi, three for forces
    /// and three for torques: Brownian velocities for scale = sqrt(2 kT/dt). They are those of the rods from row
    /// `first` on, the others' being 0: a mobility that does not couple rods can so be given them part by part.
    virtual void add_square_root(const Rods& rods, std::size_t first, std::span<const Normals> normals, double scale,
                                 Velocities& velocities) const = 0;

    /// Whether a force on one rod moves others. If not, `of_rod` says everything.
    virtual bool couples_rods() const = 0;

    /// The diagonal block of rod `i`: its own mobility.
    virtual RodMobility of_rod(std::size_t i) const = 0;
};

}  // namespace jostle
