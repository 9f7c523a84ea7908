#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "jostle/math/random.hpp"
#include "jostle/rods/axial_stresslets.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/forces.hpp"
#include "jostle/rods/relative_mobility.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/rods/velocities.hpp"

namespace jostle {

/// M among some of the rods: without the rows and columns of the others.
class MobilityAmong {
public:
    virtual ~MobilityAmong() = default;

    /// velocities = M forces, (n) each, in the order of the rods that were asked for; `velocities` is given that size.
    virtual void apply(const Forces& forces, Velocities& velocities) const = 0;

    /// The same of a part of M that costs much less to apply; what it leaves out is positive semi-definite.
    virtual void apply_near(const Forces& forces, Velocities& velocities) const = 0;
};

/// M at one configuration: the linear map from forces on the rods to their velocities, symmetric and positive
/// semi-definite.
///
/// The only thing that motions and the contact problem know of the fluid. Rows are those of the rods that it was made
/// for; these, the box and the `Mobility` must outlive it, and stay as they are while it is used.
class MobilityOperator {
public:
    virtual ~MobilityOperator() = default;
    MobilityOperator(const MobilityOperator&) = delete;
    MobilityOperator& operator=(const MobilityOperator&) = delete;

    /// velocities = M forces, (N) each; `velocities` is given that size.
    virtual void apply(const Forces& forces, Velocities& velocities) const = 0;

    /// The same without the part that acts from afar, which is dear; the whole where there is no such part.
    virtual void apply_near(const Forces& forces, Velocities& velocities) const { apply(forces, velocities); }

    /// velocities += scale B xi with B B^T = M and standard normal numbers xi, which are a function of seed, step and
    /// stream of the key and of the rods' ids: Brownian velocities for scale = sqrt(2 kT/dt).
    virtual void add_square_root(const RandomKey& key, double scale, Velocities& velocities) const = 0;

    /// velocities += kT div M, the thermal drift, and those of the rods in the flow of the force dipoles of others; 0,
    /// and nothing to add, where rods do not move each other.
    virtual void add_axial_flow(const AxialStresslets& /*stresslets*/, Velocities& /*velocities*/) const {}

    /// Whether a force on one rod moves others. If not, `of_rod` says everything.
    virtual bool couples_rods() const = 0;

    /// M among the rods of these rows, where it has a near part; else none. The rows may not hold one twice. What is
    /// returned holds a reference to the operator.
    virtual std::unique_ptr<const MobilityAmong> among(std::span<const std::uint32_t> /*rows*/) const {
        return nullptr;
    }

    /// The diagonal block of rod `i`: its own mobility.
    virtual RodMobility of_rod(std::size_t i) const = 0;

    /// How fast the points move apart along their normal per force that pushes them apart: A_ll of a contact there. Of
    /// a mobility that couples rods it is the true one, coupling included; here that of the rods' own blocks.
    virtual double relative_mobility(const PairOfPoints& points) const {
        const auto rod = [this](std::size_t row) { return MobileRod{rods_.axis[row], of_rod(row)}; };
        return jostle::relative_mobility(points, rod(points.i), rod(points.j));
    }

protected:
    explicit MobilityOperator(const Rods& rods) : rods_(rods) {}
    const Rods& rods() const { return rods_; }

private:
    const Rods& rods_;
};

/// A model of the fluid: gives the mobility of any configuration.
class Mobility {
public:
    virtual ~Mobility() = default;

    /// M of these rods as they stand, with their present lengths and diameters. May keep for the next call what costs
    /// time to find; may be called by several threads.
    virtual std::unique_ptr<const MobilityOperator> at(const Rods& rods, const Box& box) const = 0;
};

}  // namespace jostle
