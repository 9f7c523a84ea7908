#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "jostle/hydrodynamics/ewald_split.hpp"
#include "jostle/mobility/mobility.hpp"

namespace jostle {

/// More rods than this are not coupled in an open box: there every pair is kept, and each application passes over all.
inline constexpr std::size_t max_rods_in_open_box = 2000;

struct FluidFlows;
struct FluidGrids;
struct NearMemory;

/// Whether spheres turn with the fluid around them, and stir it by turning. Nothing else depends on the direction of a
/// sphere, so that those that neither swim nor are aligned need not.
enum class SpheresTurn { not_with_fluid, with_fluid };

/// Rods that move each other through the fluid (theory, section 7): M = W^T G W + the remainders of the rods' own
/// mobilities, with blobs of force along each rod, in an unbounded fluid or in a box that is periodic along all
/// directions.
///
/// Symmetric to the rounding of floats, in which flows are summed, and positive at any distance. It has the rods' far
/// fields and what these do to other rods (their Faxen laws); it leaves out lubrication and the stresses that rods
/// answer straining flow with.
class HydrodynamicMobility final : public Mobility {
public:
    /// `tolerance`: relative error of velocities in a periodic box, 1e-6 to 1e-2, against exact sums over images;
    /// `cutoff` of the sum in real space (a length), or none: that which costs least.
    explicit HydrodynamicMobility(double viscosity, double tolerance = 1e-3,
                                  std::optional<double> cutoff = std::nullopt,
                                  SpheresTurn spheres = SpheresTurn::not_with_fluid);

    /// Errors: InputError for a box that is periodic along some directions only, for more than `max_rods_in_open_box`
    /// rods in an open one, and for rods that `blobs_of` refuses. The operator sets up its sums when first applied.
    std::unique_ptr<const MobilityOperator> at(const Rods& rods, const Box& box) const override;

private:
    double viscosity_, tolerance_;
    std::optional<double> cutoff_;
    SpheresTurn spheres_;
    mutable std::mutex lock_;  ///< of what was last made
    mutable std::shared_ptr<const FluidFlows> last_;
    mutable std::shared_ptr<FluidGrids> spare_grids_;  ///< those of the last operator, which the next may take over
    mutable std::shared_ptr<NearMemory> spare_near_;   ///< and its other memory
};

}  // namespace jostle
