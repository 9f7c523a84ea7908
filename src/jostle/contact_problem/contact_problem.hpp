#pragma once

#include <vector>

#include "jostle/contact_problem/contact_solution.hpp"
#include "jostle/contact_problem/delassus_operator.hpp"
#include "jostle/lcp/lcp_problem.hpp"

namespace jostle {

/// The contact problem of a step: forces gamma with 0 <= A gamma + b  perp  gamma >= 0 (theory, eq. 2.5), for contacts
/// that it owns. A solver holds a reference, and takes in what is appended when it goes on.
class ContactProblem {
public:
    /// `b`: (contacts) the velocity of each gap without forces; empty where forces are not sought. `compliance`: kappa
    /// of the DelassusOperator. `start`: (contacts) forces to begin from; empty: from 0. Holds references to rods and
    /// mobility.
    ContactProblem(const Rods& rods, const MobilityOperator& mobility, Contacts contacts, std::vector<double> b,
                   double time_step, double compliance = 0.0, std::vector<double> start = {})
        : contacts_(std::move(contacts)),
          contact_matrix_(contacts_, rods.id, included(mobility)),
          matrix_(contact_matrix_, rods, mobility, compliance),
          b_(std::move(b)),
          start_(std::move(start)),
          time_step_(time_step) {}
    ContactProblem(const ContactProblem&) = delete;
    ContactProblem& operator=(const ContactProblem&) = delete;

    /// Adds contacts, with their part of b.
    void append(const Contacts& more, std::span<const double> b) {
        contacts_.append(more);
        b_.insert(b_.end(), b.begin(), b.end());
        contact_matrix_.extend();
        matrix_.extend();
    }

    std::size_t size() const { return contacts_.size(); }
    const Contacts& contacts() const { return contacts_; }
    const ContactMatrix& contact_matrix() const { return contact_matrix_; }
    const DelassusOperator& matrix() const { return matrix_; }
    const std::vector<double>& constant() const { return b_; }
    const std::vector<double>& start() const { return start_; }
    double time_step() const { return time_step_; }
    LcpProblem lcp() const { return {matrix_, b_, time_step_}; }

    /// Fills in the forces and velocities of the rods that follow from gamma.
    void complete(ContactSolution& solution) const {
        solution.resize(contact_matrix_);
        matrix_.velocities(solution.gamma, solution.forces, solution.velocities);
    }

    /// The contacts, once nothing else of the problem is needed any more.
    Contacts take_contacts() && { return std::move(contacts_); }

private:
    /// A mobility that couples rods moves those without contacts, too.
    static ContactMatrix::Include included(const MobilityOperator& mobility) {
        return mobility.couples_rods() ? ContactMatrix::Include::all_rods : ContactMatrix::Include::rods_with_contacts;
    }

    Contacts contacts_;
    ContactMatrix contact_matrix_;
    DelassusOperator matrix_;
    std::vector<double> b_, start_;
    double time_step_;
};

}  // namespace jostle
