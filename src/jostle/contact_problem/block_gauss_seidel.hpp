#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact_problem/borrowed_contacts.hpp"
#include "jostle/contact_problem/contact_groups.hpp"
#include "jostle/contact_problem/contact_problem.hpp"

namespace jostle {

/// What a sweep passes over.
enum class SweepOver { all, active };

/// Keeps the velocities of the rods, V = M D gamma, while contacts are solved one after the other.
///
/// Pairs are coloured, so that no two of a colour share a rod. A sweep over all finds those that are active: that push
/// or may soon. Real is what velocities and single contacts are stored in; pairs, whose matrices may be nearly
/// singular, are in double.
///
/// A plane that contacts push is one more body. Its contacts of a colour are solved together, in every sweep: each
/// feels what any of them does, so that none stands still alone.
///
/// A pair between ranks is solved by both, to the same bits: before each colour the velocities of the rods that such
/// pairs of it share are exchanged, or before some colours only (borrow_contacts). What sweeps return is of all ranks.
template <class Real>
class BlockGaussSeidel {
public:
    /// Starts from `start`, as many numbers as there are contacts; contacts that come later start from what is then
    /// there. `colours_per_exchange`: of velocities between ranks. Holds references.
    BlockGaussSeidel(const ContactProblem& problem, double tolerance, const std::vector<double>& start,
                     std::size_t colours_per_exchange = 1);

    /// Takes in the contacts that the problem has grown by; active are those whose gap closes without forces.
    void extend();

    /// Begins again with the constants that the problem has now, and no forces.
    void begin_again(double tolerance);

    /// One pass; returns the largest change of a gap velocity by a contact's own force. It passes over contacts whose
    /// rods stand still since they were solved last (`sweep_over`), unless `stir_all` was called since.
    double sweep(double omega, SweepOver over);
    void stir_all() { all_are_stirred_ = true; }

    /// One pass over all, not over-relaxed, from where the last change of all forces would lead if it were made again,
    /// `beta` times; 0 after another sweep. Returns what `sweep` does. Not where contacts push a plane.
    double sweep_on(double beta);

    /// By how much a contact violates its conditions, at most, as the sweeps have left them; rounded as they are.
    double violation();

    /// Fills in the velocities, of the rods and of the box, as the sweeps have left them.
    void read_velocities(ContactSolution& solution) const;

    /// Fills `solution` from gamma alone, in double, so that no rounding of the sweeps is left in it.
    void refresh(ContactSolution& solution);

private:
    using Colour = ColourContacts<Real>;

    void set_tolerance(double tolerance);
    ScalarBlock<Real> contact_of(const ContactPair& pair) const;
    CoupledBlock pair_of(const ContactPair& pair) const;
    void begin_again(ScalarBlock<Real>& contact) const;
    void begin_again(CoupledBlock& pair) const;
    template <class Item, class MakeItem>
    static void append(ContactGroup<Item>& group, std::span<const ContactPair> pairs, MakeItem&& item_of);
    void append(ContactKinds<Real>& contacts, std::span<const ContactPair> new_pairs);
    std::vector<ContactPair> append_at_plane(Colour& colour, std::span<const ContactPair> new_pairs);
    void append_between_ranks(Colour& colour, std::span<const ContactPair> new_pairs);
    bool borrows_contacts() const {
        return problem_.domain().is_shared() && colours_per_exchange_ > 1 && !matrix_.box().plane;
    }
    void plan_messages();
    LocalRods<Real> local_rods();
    template <class Body>
    void for_contacts(Colour& colour, Body&& body);
    template <class Item>
    void find_active(ContactGroup<Item>& group);
    double sweep_at_plane(Colour& colour, const Relaxation& by);
    void note_stirred_rods();
    void carry_on_velocities(double beta);
    template <class Body>
    void for_all_forces(Body&& body);

    const ContactProblem& problem_;
    const DelassusOperator& matrix_;
    const std::vector<double>& b_;
    const std::vector<double>& start_;
    double activation_threshold_ = 0.0, still_ = 0.0;
    std::size_t colours_per_exchange_;
    std::size_t local_count_ = 0;                  ///< n
    std::vector<MobileRod> borrowed_rods_;         ///< (m >= n) local rods and those of borrowed contacts; or none
    std::vector<SpatialVector<Real>> velocities_;  ///< (n or m) V, kept up to date
    std::vector<SpatialVector<Real>> former_velocities_;  ///< (n or m) V of the forces before the last `sweep_on`
    double plane_velocity_ = 0.0;                         ///< of the plane that contacts push, kept up to date
    std::uint32_t sweeps_ = 0;                            ///< so far; numbers them
    bool all_are_stirred_ = false;                        ///< to the next sweep no rod stands still
    PairColours pair_colours_;
    std::vector<Colour> colours_;
    BorderMessages all_messages_;  ///< of all rods that pairs between ranks share
};

extern template class BlockGaussSeidel<float>;
extern template class BlockGaussSeidel<double>;

}  // namespace jostle
