#pragma once

#include <optional>
#include <vector>

#include "jostle/contact/end_configuration.hpp"
#include "jostle/contact_problem/contact_solution.hpp"
#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/domain/domain.hpp"
#include "jostle/lcp/lcp_problem.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"

namespace jostle {

/// The contact problem of a step: forces gamma with 0 <= A gamma + b  perp  gamma >= 0 (theory, eq. 2.5), for contacts
/// that it owns. A solver holds a reference, and takes in what is appended when it goes on.
///
/// Where other ranks have rods, too, it is this rank's part of the problem: all contacts of its own rods. Those with
/// ghosts are other ranks' contacts as well, and one of the two adds them up.
class ContactProblem {
public:
    /// `b`: (contacts) the velocity of each gap without forces; empty where forces are not sought. `compliance`: kappa
    /// of the DelassusOperator. `start`: (contacts) forces to begin from; empty: from 0. `box`: one that forces open.
    /// `axes`: of the rods; by default as they lie. Holds references to rods, mobility and domain.
    ContactProblem(const Rods& rods, const MobilityOperator& mobility, Contacts contacts, std::vector<double> b,
                   double time_step, double compliance = 0.0, std::vector<double> start = {},
                   const Domain& domain = Domain::whole(), const BoxColumn& box = {},
                   std::optional<ArmAxes> axes = std::nullopt)
        : contacts_(std::move(contacts)),
          contact_matrix_(contacts_, rods.id, included(mobility), domain.owned_of(rods.size())),
          matrix_(contact_matrix_, rods, mobility, compliance, box, axes),
          domain_(domain),
          b_(std::move(b)),
          start_(std::move(start)),
          time_step_(time_step) {
        note_elsewhere();
    }
    ContactProblem(const ContactProblem&) = delete;
    ContactProblem& operator=(const ContactProblem&) = delete;

    /// Adds contacts, with their part of b.
    void append(const Contacts& more, std::span<const double> b) {
        contacts_.append(more);
        b_.insert(b_.end(), b.begin(), b.end());
        contact_matrix_.extend();
        matrix_.extend();
        note_elsewhere();
    }

    /// Other constants b for the contacts that there are.
    void pose_again(std::vector<double> b) { b_ = std::move(b); }

    std::size_t size() const { return contacts_.size(); }
    const Contacts& contacts() const { return contacts_; }
    const ContactMatrix& contact_matrix() const { return contact_matrix_; }
    const DelassusOperator& matrix() const { return matrix_; }
    const std::vector<double>& constant() const { return b_; }
    const std::vector<double>& start() const { return start_; }
    /// Whether there are forces to begin from, on any rank.
    bool begins_warm() const { return domain_.ranks().any(!start_.empty()); }
    double time_step() const { return time_step_; }
    RodsWithContacts rods_with_contacts() const {
        return {contact_matrix_.local_index(), contact_matrix_.rods(), matrix_.rods()};
    }
    /// The rate at which forces on all ranks open the box, m w.gamma. No contact with a plane is another rank's, too.
    double box_rate(std::span<const double> gamma) const {
        if (!matrix_.opens_box()) return 0.0;
        return matrix_.box().mobility * sum_over_ranks<double>(domain_.ranks(), gamma.size(), [&](std::size_t l) {
                   return matrix_.column(l) * gamma[l];
               });
    }
    /// (contacts) how fast each gap opens, A gamma + b, from gamma and the velocities that follow from it.
    void gap_velocities(const ContactSolution& solution, std::span<double> rates) const {
        matrix_.rates(solution.velocities, solution.box_rate, solution.gamma, rates);
        parallel_for(rates.size(), [&](std::size_t l) { rates[l] += b_[l]; });
    }
    LcpProblem lcp() const { return {matrix_, b_, time_step_, domain_.ranks(), is_elsewhere_}; }

    const Domain& domain() const { return domain_; }
    /// (contacts) whether another rank adds it up: that of the rod with the smaller id. Empty if there is none.
    std::span<const std::uint8_t> is_elsewhere() const { return is_elsewhere_; }
    /// Velocities of ghosts, (n) as a solution has them, from their owners.
    void fetch_velocities(std::span<ContactVelocity> velocities) const {
        ContactVelocity at_rest;  // of own rods without contacts
        domain_.refresh<ContactVelocity>([&](std::uint32_t row) -> ContactVelocity& {
            const std::uint32_t local = contact_matrix_.local_index()[row];
            return local == no_local_index ? at_rest : velocities[local];
        });
    }

    /// Fills in the forces and velocities of the rods that follow from gamma.
    void complete(ContactSolution& solution, DelassusOperator::Reach reach = DelassusOperator::Reach::all) const {
        solution.resize(contact_matrix_);
        matrix_.velocities(solution.gamma, solution.forces, solution.velocities, reach);
        if (domain_.is_shared()) fetch_velocities(solution.velocities);  // the forces on ghosts are not all known here
        solution.box_rate = box_rate(solution.gamma);
    }

    /// The contacts, once nothing else of the problem is needed any more.
    Contacts take_contacts() && { return std::move(contacts_); }

private:
    /// A mobility that couples rods moves those without contacts, too.
    static ContactMatrix::Include included(const MobilityOperator& mobility) {
        return mobility.couples_rods() ? ContactMatrix::Include::all_rods : ContactMatrix::Include::rods_with_contacts;
    }

    void note_elsewhere() {
        if (!domain_.is_shared()) return;
        for (std::size_t l = is_elsewhere_.size(); l < contacts_.size(); ++l) {
            const Contact& contact = contacts_.contact[l];
            is_elsewhere_.push_back(domain_.owns(is_fixed(contact.i) ? contact.j : contact.i) ? 0 : 1);
        }
    }

    Contacts contacts_;
    ContactMatrix contact_matrix_;
    DelassusOperator matrix_;
    const Domain& domain_;
    std::vector<std::uint8_t> is_elsewhere_;
    std::vector<double> b_, start_;
    double time_step_;
};

}  // namespace jostle
