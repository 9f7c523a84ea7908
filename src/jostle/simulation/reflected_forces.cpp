#include "jostle/simulation/reflected_forces.hpp"

#include <algorithm>
#include <cmath>

#include "jostle/contact/gap_drift.hpp"
#include "jostle/contact/reflection.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// By how much the gap of a contact opens in a step without noise, curvature apart: by motions and forces, by a flow
/// that has sheared the box, by the load of a piston, and by what else has brought the rods to overlap as the step
/// began.
double drift_of_motions(const Contact& contact, const Rods& rods, const ArmAxes& axes, const KnownMotion& known,
                        double time_step, double strain) {
    const bool at_piston = contact.i == known.piston.body;
    const double gap = at_piston ? contact.gap - known.piston.displacement : contact.gap;
    const double begun = std::min(gap, 0.0) + (at_piston ? known.piston.drift : 0.0);
    const double sheared = strain * contact.normal.x * contact.normal.y * contact_radii(contact, rods);
    if (known.drift.size() == 0) return begun + sheared;
    return begun + sheared + time_step * gap_rate(contact, axes, known.drift);
}

}  // namespace

std::vector<double> reflected_forces(const ContactProblem& problem, const ContactSolution& solution, const State& state,
                                     const ArmAxes& axes, const KnownMotion& known, std::span<const RodMobility> own,
                                     const SimulationSettings& settings, double strain) {
    const GapDrift curvature(state.rods, axes, state.box, own);
    const auto alone = [&](std::uint32_t row) { return MobileRod{axes(row), own[row]}; };
    const bool coupled = problem.matrix().couples_rods();
    const double dt = settings.time_step;
    std::vector<double> gamma = solution.gamma;
    parallel_for(gamma.size(), [&](std::size_t l) {
        if (gamma[l] == 0.0 || problem.contacts().feature[l] == ContactFeature::relinearised) return;
        const Contact& contact = problem.contacts().contact[l];
        const double compliant = problem.matrix().diagonal()[l];
        const double rigid = compliant - problem.matrix().compliance(l);
        if (!(rigid > 0.0)) return;
        double curved = curvature(contact, problem.contacts().image[l]);
        if (coupled && !is_fixed(contact.i))  // theory, eq. 3.5b
            curved *= rigid / relative_mobility(contact, alone(contact.i), alone(contact.j));
        const double drift = drift_of_motions(contact, state.rods, axes, known, dt, strain) + settings.kT * dt * curved;
        const double sigma = std::sqrt(2.0 * settings.kT * dt * rigid);
        gamma[l] *= compliant / rigid * reflected_part(compliant * gamma[l] * dt, drift, sigma);
    });
    return gamma;
}

}  // namespace jostle
