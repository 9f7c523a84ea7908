#include "jostle/simulation/step_stress.hpp"

#include "jostle/contact/fixed_rod_grid.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"
#include "jostle/stress/spring_stress.hpp"

namespace jostle {

namespace {

/// Axes after the known motion and one half of what contact forces (and other ones) turn them, of the rods in contact.
void find_half_way_axes(const ResolvedStep& step, double time_step, std::vector<Vec3>& half_way_axis) {
    half_way_axis.resize(step.state.rods.size());
    parallel_for(step.solution.rods.size(), [&](std::size_t k) {
        const std::uint32_t row = step.solution.rods[k];
        const Vec3& axis = step.state.rods.axis[row];
        const Vec3 collision = cross(step.arms[k].axis, step.solution.velocities[k].axis_rate);
        const Vec3 by_forces = step.known.by_forces.size() == 0 ? Vec3{} : step.known.by_forces.angular[row];
        const Vec3 turned = step.known.velocity.angular[row] - 0.5 * by_forces;
        half_way_axis[row] = axis_after(axis, turned + 0.5 * collision, time_step);
    });
}

/// The forces that this rank adds up, with 0 for contacts that another one does.
class ForcesHere {
public:
    explicit ForcesHere(const ResolvedStep& step) {
        const std::vector<double>& gamma = step.solution.gamma;
        if (!step.domain.is_shared()) {
            here_ = gamma;
            return;
        }
        own_.resize(gamma.size());
        parallel_for(gamma.size(), [&](std::size_t l) {
            const Contact& contact = step.contacts.contact[l];
            own_[l] = step.domain.owns(is_fixed(contact.i) ? contact.j : contact.i) ? gamma[l] : 0.0;
        });
        here_ = own_;
    }
    ForcesHere(const ForcesHere&) = delete;
    ForcesHere& operator=(const ForcesHere&) = delete;
    std::span<const double> get() const { return here_; }

private:
    std::vector<double> own_;
    std::span<const double> here_;
};

/// Theory 1: the sum over contacts of (r_j - r_i) F, and over rods of the geometric part of the net torque. With the
/// time-step correction: of rods half way through their collisions (theory, eq. 3.7).
void measure_collision_stress(const ResolvedStep& step, std::span<const double> gamma,
                              const SimulationSettings& settings, std::span<const Vec3> axis, StepReport& report,
                              CollisionMoments& moments) {
    const Rods& rods = step.state.rods;
    const Ranks& ranks = step.domain.ranks();
    const auto distance = settings.brownian_correction ? ContactDistance::touching : ContactDistance::at_start;
    std::vector<Vec3> torque(step.solution.rods.size());
    parallel_for(torque.size(), [&](std::size_t k) {
        const std::uint32_t row = step.solution.rods[k];
        if (step.domain.owns(row)) torque[k] = cross(axis[row], step.solution.forces[k].moment);
    });
    const RodTorques torques = {step.solution.rods, torque};
    const Mat3 centre_of_mass = centre_of_mass_virial(step.contacts, gamma, rods, axis, distance, ranks);
    report.collision_virial = centre_of_mass + geometric_stress(rods, axis, torques, ranks);
    if (settings.stress_conventions || settings.flow) report.centre_of_mass_virial = centre_of_mass;
    if (settings.collision_moments)
        moments = collision_moments(step.contacts, gamma, rods, step.state.box, axis, torques, distance);
    if (settings.stress_conventions || settings.pressure)
        report.centre_of_mass_virial = centre_of_mass_virial(step.contacts, gamma, rods, axis, distance, ranks);
    if (!settings.stress_conventions) return;
    report.centre_line_virial = centre_line_virial(step.contacts, gamma, rods, distance, ranks);
}

/// Theory 1, eqs. (1.16) and (1.22): the forces of springs, and the torques of motions, as the step began, with moments
/// half way through what forces do in it (eq. 1.17).
void measure_stress_of_known_forces(const ResolvedStep& step, double time_step, bool has_springs, StepReport& report) {
    const Rods& rods = step.state.rods;
    Velocities by_forces = step.known.by_forces;
    parallel_for(step.solution.rods.size(), [&](std::size_t k) {
        const std::uint32_t row = step.solution.rods[k];
        by_forces.linear[row] += step.solution.velocities[k].centre;
        by_forces.angular[row] += cross(step.arms[k].axis, step.solution.velocities[k].axis_rate);
    });
    Configuration half_way;
    half_way.resize(rods.size());
    const double half_step = 0.5 * time_step;
    parallel_for(rods.size(), [&](std::size_t i) {
        half_way.centre[i] = centre_after(rods.centre[i], by_forces.linear[i], half_step);
        half_way.axis[i] = axis_after(rods.axis[i], by_forces.angular[i], half_step);
    });
    if (has_springs)
        report.spring_virial =
            sum_of_spring_stresses(step.state.springs, step.known.pulls, rods, half_way.centre, half_way.axis,
                                   step.domain.ranks(), step.domain.owned_of(rods.size()));
    const std::vector<Vec3>& torque = step.known.exerted.torque;
    report.torque_virial =
        sum_over_ranks<Mat3>(step.domain.ranks(), step.domain.owned_of(torque.size()), [&](std::size_t i) {
            return geometric_stress_of_rod(half_way.axis[i], rods.length[i], rods.diameter[i], torque[i]);
        });
}

/// Theory 6: the sum of the contact forces on each wall, and on all fixed rods.
void measure_wall_forces(const ResolvedStep& step, std::span<const double> gamma, StepReport& report) {
    const Ranks& ranks = step.domain.ranks();
    for (const Wall& wall : walls_of(step.state.box))
        report.wall_force[wall.number] = sum_over_ranks<double>(ranks, gamma.size(), [&](std::size_t l) {
            return step.contacts.contact[l].i == wall.body() ? gamma[l] : 0.0;
        });
    if (!step.state.box.fixed_rods()) return;
    report.fixed_rod_force = sum_over_ranks<Vec3>(ranks, gamma.size(), [&](std::size_t l) {
        const Contact& contact = step.contacts.contact[l];
        return is_fixed_rod(contact.i) ? -gamma[l] * contact.normal : Vec3{};
    });
}

}  // namespace

void measure_stress(const ResolvedStep& step, const SimulationSettings& settings, std::vector<Vec3>& half_way_axis,
                    StepReport& report, CollisionMoments& moments) {
    if (step.known.by_forces.size() > 0)
        measure_stress_of_known_forces(step, settings.time_step, settings.has_springs, report);
    if (settings.corrects_brownian_motion()) find_half_way_axes(step, settings.time_step, half_way_axis);
    const std::span<const Vec3> axis = settings.corrects_brownian_motion() ? half_way_axis : step.state.rods.axis;
    const ForcesHere forces(step);
    const std::span<const double> gamma = forces.get();
    measure_collision_stress(step, gamma, settings, axis, report, moments);
    measure_wall_forces(step, gamma, report);
    report.active_contacts = sum_over_ranks<std::size_t>(
        step.domain.ranks(), gamma.size(), [&](std::size_t l) { return gamma[l] > 0.0 ? std::size_t{1} : 0; });
}

}  // namespace jostle
