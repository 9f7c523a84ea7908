#pragma once

#include <optional>
#include <vector>

#include "jostle/contact_problem/contact_solver.hpp"
#include "jostle/simulation/contact_searches.hpp"
#include "jostle/simulation/known_motion.hpp"
#include "jostle/simulation/simulation_settings.hpp"
#include "jostle/simulation/size_bounds.hpp"
#include "jostle/simulation/step_report.hpp"
#include "jostle/state/state.hpp"

namespace jostle {

/// How the contacts of one step are resolved (theory, sections 2.3 and 3): 0 <= A gamma + b  perp  gamma >= 0. Holds
/// references to all that it is made of.
///
/// Of Brownian rods the problem says where their paths meet others; there they are reflected, and what overlaps then is
/// brought back to touching by the same problem with other b.
class ContactResolution {
public:
    ContactResolution(const State& state, const KnownMotion& known, const StepGeometry& geometry,
                      const SizeBounds& sizes, const SimulationSettings& settings, const Domain& domain,
                      ContactSearches& searches)
        : state_(state),
          known_(known),
          geometry_(geometry),
          sizes_(sizes),
          settings_(settings),
          domain_(domain),
          searches_(searches) {}

    /// A, b, and the forces to begin from, of the contacts that were found. `opening`: the box, where forces open it.
    ContactProblem posed(const MobilityOperator& mobility, Contacts found, const BoxColumn& opening) const;

    /// The forces; the problem then has the contacts that they brought about, too, and the report how the solver ended.
    /// None if rods of other ranks might be near that are not known.
    std::optional<ContactSolution> solve(ContactProblem& problem, StepReport& report);

private:
    double tolerance_of_mirrors() const;
    ContactSolution repelled(const ContactProblem& problem) const;
    ContactSolution reflected(const ContactProblem& problem, const ContactSolution& solution) const;
    bool run_to_solution(ContactSolver& solver, ContactProblem& problem, const ContactSolution* acting);
    std::optional<Contacts> violated(const ContactProblem& problem, const EndConfiguration& end);
    Contacts relinearised(const ContactProblem& problem, const Box& box, const EndConfiguration& end,
                          const ContactSolution& solution, double max_overlap_per_diameter) const;
    Box opened_by(double rate) const;
    std::vector<double> gap_velocities(const Contacts& contacts) const;
    std::vector<double> gap_velocities_beside(const ContactSolution& acting, const Contacts& contacts,
                                              const ContactProblem& problem) const;
    EndConfiguration after_known_motion() const {
        return {state_.rods, known_.velocity, known_.end, settings_.time_step};
    }

    const State& state_;
    const KnownMotion& known_;
    const StepGeometry& geometry_;
    const SizeBounds& sizes_;
    const SimulationSettings& settings_;
    const Domain& domain_;
    ContactSearches& searches_;
};

}  // namespace jostle
