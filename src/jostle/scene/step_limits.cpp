#include "jostle/scene/step_limits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/contact/own_image.hpp"
#include "jostle/contact/wca_forces.hpp"
#include "jostle/motion/self_propulsion.hpp"
#include "jostle/scene/refusal.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/scene_motion.hpp"

namespace jostle {

namespace {

/// A tumble that turns the ends of a rod by more than this in a step (in D) could carry them through others.
constexpr double farthest_turn = 0.25;
/// A rod that swims farther than this in a step (in D) could pass through others.
constexpr double farthest_swim = 0.5;

/// Rates and speeds of cells beyond the mean by so many standard deviations are one in thirty thousand.
constexpr double deviations_of_the_fastest = 4.0;
/// Cells divide late by as much of what they add from birth to division, at most, for being looked at now and then.
constexpr double latest_division = 0.25;
constexpr auto largest_step_number = static_cast<double>(max_steps);

constexpr const char* slower_tumbles = "Use a shorter time.step or slower tumbles";

/// In kT: the energy with which one pair in 150 meets.
constexpr double high_energy = 5.0;

}  // namespace

void require_short_growth(const Scene& scene, double diameter, double time_step) {
    if (scene.growth.rate == 0.0) return;
    const double longest = 0.1 * diameter;
    const double fastest = 1.0 + deviations_of_the_fastest * scene.growth.rate_deviation;
    const double of_step = fastest * scene.growth.rate * time_step;
    if (of_step > longest)
        refuse("growth.rate", text(scene.growth.rate),
               fmt::format("lengthens cells by {} in a step of {}: contacts cannot follow", rounded(of_step),
                           rounded(time_step)),
               fmt::format("at most {}, a tenth of the diameter in a step", rounded(longest / (fastest * time_step))),
               "Use a shorter time.step");
    const double added = 0.5 * (scene.growth.division_length + diameter);
    const double max_steps_between = std::max(1.0, std::floor(latest_division * added / of_step));
    if (static_cast<double>(scene.growth.division_every) > max_steps_between)
        refuse("growth.division_every", fmt::format("{}", scene.growth.division_every),
               fmt::format("lets cells grow by {} between two looks at who divides; from birth to division they add {}",
                           rounded(static_cast<double>(scene.growth.division_every) * of_step), rounded(added)),
               fmt::format("at most {:.0f}, a quarter of it", max_steps_between),
               "Look more often, or use a shorter time.step");
}

void require_countable_steps(const Scene& scene, double time_step) {
    if (scene.time.production < time_step)
        refuse("time.production", text(scene.time.production), "is shorter than one step",
               fmt::format("at least {}{}", scene.time.step ? "time.step = " : "one step, ", text(time_step)), "");
    const bool long_production = scene.time.production / time_step > largest_step_number;
    if (long_production || scene.time.equilibration.value_or(0.0) / time_step > largest_step_number)
        refuse(long_production ? "time.production" : "time.equilibration",
               text(long_production ? scene.time.production : *scene.time.equilibration),
               fmt::format("takes more than {:g} steps of time.step = {}", largest_step_number, text(time_step)),
               fmt::format("at most {:g} steps", largest_step_number), "Use a longer step or a shorter time");
}

void require_slow_swimmers(const Scene& scene, const Rods& rods, double time_step) {
    const Swimming swimming = swimming_of(scene);
    if (swimming.speed == 0.0) return;
    const auto require_slow = [&](double speed, double diameter) {
        const double most = farthest_swim * diameter / time_step;
        if (std::fabs(speed) > most)
            refuse("motion.self_propulsion", rounded(speed),
                   fmt::format("takes a rod through others in a single step of {}", rounded(time_step)),
                   fmt::format("speeds up to {}, half a diameter in a step", rounded(most)),
                   "Use a shorter time.step or slower swimmers");
    };
    const std::vector<double> speed = SelfPropulsion(swimming).speeds(rods, scene.seed);
    for (std::size_t i = 0; i < rods.size(); ++i) require_slow(speed[i], rods.diameter[i]);
    if (scene.growth.rate > 0.0 && rods.speed.empty())  // daughters draw their own
        require_slow(std::fabs(swimming.speed) + deviations_of_the_fastest * swimming.deviation,
                     smallest_diameter(scene, rods));
    if (swimming.tumble_rate == 0.0) return;
    if (swimming.tumble_rate * time_step > 1.0)
        refuse("motion.tumble_rate", rounded(swimming.tumble_rate), "is more than one tumble in a time step",
               fmt::format("at most {}", rounded(1.0 / time_step)), slower_tumbles);
    const double grown = scene.growth.rate > 0.0 ? scene.growth.division_length : 0.0;
    const auto steps = static_cast<double>(Tumbles(swimming.tumble_rate, swimming.tumble_time).steps(time_step));
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double longest = std::max(rods.length[i], grown);
        const double fewest = std::numbers::pi * 0.5 * longest / (farthest_turn * rods.diameter[i]);
        if (steps < fewest)
            refuse("motion.tumble_time", rounded(swimming.tumble_time),
                   "is too short: the ends of a rod would pass through others in a single step",
                   fmt::format("at least {}", rounded(std::ceil(fewest) * time_step)), slower_tumbles);
    }
}

double require_slow_springs(const Scene& scene, std::span<const Spring> springs, const MobilityOfRod& mobility_of,
                            double time_step) {
    const double relaxation = spring_relaxation(springs, mobility_of, time_step);
    if (relaxation <= 1.0) return relaxation;
    refuse(
        "springs.file", scene.springs.file,
        fmt::format("springs are too stiff for the time step: in one of {} they may lose {} times their stretch (2 dt "
                    "times stiffness times mobility)",
                    rounded(time_step), rounded(relaxation)),
        fmt::format("at most 1, with a step of at most {}", rounded(time_step / relaxation)),
        "Use a shorter time.step or softer springs");
}

void require_room_between_images(const Scene& scene, const Box& box, const MobilityOperator& mobility, const Rods& rods,
                                 double time_step) {
    if (scene.contact.model != ContactModel::hard) return;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const double turn = std::sqrt(2.0 * thermal_energy(scene) * mobility.of_rod(i).rotational * time_step);
        for (std::size_t k = 0; k < 3; ++k) {
            const double edge = box.edges[static_cast<int>(k)];
            if (rods.length[i] == 0.0 || !box.periodic[k] || edge >= rods.length[i] + rods.diameter[i]) continue;
            const double room = inclination_between_images(edge, rods.length[i], rods.diameter[i]);
            if (room >= turn) continue;
            refuse("box.edges", text(box.edges),
                   fmt::format("leave a rod room to turn by {} rad between its own images along {}, and a step of {} "
                               "turns it by {}",
                               rounded(room), "xyz"[k], rounded(time_step), rounded(turn)),
                   fmt::format("a step of at most {}", rounded(time_step * room * room / (turn * turn))),
                   "Enlarge that edge, or use a shorter step");
        }
    }
}

double potential_relaxation(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, double time_step) {
    double largest = 0.0;
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const RodMobility rod = mobility.of_rod(i);
        const double half = 0.5 * rods.length[i];
        largest = std::max(largest, std::max(rod.parallel, rod.perpendicular + half * half * rod.rotational));
    }
    const double energy = scene.contact.energy.value_or(scene.fluid.kT);
    const double curvature = wca_curvature(high_energy * thermal_energy(scene), smallest_diameter(scene, rods), energy);
    return time_step * curvature * 2.0 * largest;
}

void require_soft_potential(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, double time_step) {
    if (scene.contact.model != ContactModel::wca) return;
    const double relaxation = potential_relaxation(scene, mobility, rods, time_step);
    if (relaxation <= 2.0) return;
    const double energy = scene.contact.energy.value_or(scene.fluid.kT);
    refuse(
        "contact.energy", text(energy),
        fmt::format("makes a potential too stiff for the time step: two rods that meet with 5 kT are thrown apart by "
                    "{} times their overlap in one of {}",
                    rounded(relaxation), rounded(time_step)),
        fmt::format("at most 2 times: a step of at most {}", rounded(2.0 * time_step / relaxation)),
        "Use a shorter step, a lower energy, or hard rods");
}

}  // namespace jostle
