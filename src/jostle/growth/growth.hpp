#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/growth/growth_law.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// A cell that came into being, or ceased to be.
struct LineageEvent {
    enum class Kind { birth, death };
    Kind kind;
    std::uint64_t id;
    std::uint64_t mother;  ///< of a birth: the cell that divided, which lives on; of a death: its own id
    double length;         ///< of the cell then
};

/// Growth, division and death of cells (theory, section 5).
///
/// A cell of length L divides into two of length (L - D)/2 with centres at -+(L + D)/4 along its axis: end to end they
/// touch, and reach as far as their mother. The one behind keeps her id; the one in front, at the head, gets a new one,
/// mother + 2^(founder_bits + divisions), divisions counted in her line since the start: no two cells ever share one.
/// All draws are pure functions of (seed, id, divisions), deaths of (seed, id, step): the same for any number of
/// threads, any order of rows, and after any restart.
class Growth {
public:
    Growth(const GrowthLaw& law, std::uint64_t seed) : law_(law), seed_(seed) {}

    /// Gives the rods at the start their cycles, which all are as if just born, and `founder_bits`.
    void found(Rods& rods) const;

    /// One step of growth: the cell's rate dt, times the share of it that compression leaves.
    void lengthen(Rods& rods, double time_step) const;

    /// How much compression slows the cells: dL/dt = rate (1 - F/F_stall), at least 0, with F averaged over
    /// `stall_memory` (theory, eq. 5.2). `rows`: of the rods with contacts; `forces`: (rows.size()) on them in this
    /// step; the compression by them is -moment.n/L.
    void slow_down(Rods& rods, std::span<const std::uint32_t> rows, std::span<const ContactForce> forces,
                   double time_step) const;

    /// Whether cells divide and die after the step with this number.
    bool is_due(std::uint64_t step) const { return step % law_.division_every == 0; }

    /// Lets cells divide and die; the events are in the order of ids. Daughters' rows come last. Throws InputError if a
    /// line has had more divisions than ids can tell apart.
    std::vector<LineageEvent> divide(Rods& rods, const Box& box, std::uint64_t step, double time_step) const;

private:
    CellCycle newborn(std::uint64_t id, double length, double diameter, std::uint64_t step,
                      std::uint64_t divisions) const;
    bool divides(const Rods& rods, std::size_t row, std::uint64_t step, double time_step) const;
    bool dies(std::uint64_t id, std::uint64_t step, double time_step) const;
    double stall_memory(double diameter) const;
    LineageEvent split(Rods& rods, std::size_t row, const Box& box, std::uint64_t step) const;

    GrowthLaw law_;
    std::uint64_t seed_;
};

}  // namespace jostle
