#include "jostle/scene/time_step.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "jostle/error/refuse.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/step_accuracy.hpp"
#include "jostle/scene/step_limits.hpp"

namespace jostle {

namespace {

constexpr auto largest_step_number = static_cast<double>(max_steps);

/// `diffusion`: the amount of diffusion in a step, in place of its automatic one.
double automatic_step(std::span<const StepLimit> limits, std::optional<double> diffusion) {
    double step = StepLimit::none;
    for (const StepLimit& limit : limits) {
        if (!(limit.rate > 0.0 && std::isfinite(limit.rate))) continue;
        const double automatic = limit.key == "fluid.kT" ? diffusion.value_or(limit.automatic) : limit.automatic;
        step = std::min(step, limit.step_of(std::min(automatic, limit.largest)));
    }
    if (std::isfinite(step) && step > 0.0) return step;
    refuse("time.step", "", "is missing, and nothing in the scene moves that a step could be found from",
           "a time, greater than 0", "Add step = 1e-3 under [time]");
}

std::string in_words(const StepLimit& limit, double amount) {
    return fmt::format("{} {}{}{}", limit.what, rounded(amount), limit.unit.empty() ? "" : " ", limit.unit);
}

}  // namespace

double time_step(const Scene& scene, const Mobility& model, const Box& box, const Rods& rods,
                 std::span<const Spring> springs) {
    if (scene.time.step) return *scene.time.step;
    if (scene.time.rms_step) {
        const double length = *scene.time.rms_step * smallest_diameter(scene, rods);
        const double kT = thermal_energy(scene_at_its_hardest(scene));
        return length * length / (2.0 * fastest_diffusion(kT, *model.at(rods, box), rods.size(), box.dimensions()));
    }
    const std::optional<double> diffusion =
        scene.time.accuracy ? rms_step_of_accuracy(*scene.time.accuracy, known_step_error(scene, rods, box))
                            : rms_step_of_ordered_rods(scene, rods, box);
    return automatic_step(
        grows(scene) ? lasting_step_limits(scene, model, box) : step_limits(scene, model, box, rods, springs),
        diffusion);
}

void require_short_step(std::span<const StepLimit> limits, double step) {
    for (const StepLimit& limit : limits) {
        const double amount = limit.amount(step), over = amount / limit.largest;
        if (!(over > 1.0)) continue;
        if (limit.step_of(limit.largest) == 0.0)
            refuse(limit.key, limit.value, limit.harm + ", however short a step is", "", "Use " + limit.remedy);
        const std::string longest = fmt::format("a step of at most {}", rounded(limit.step_of(limit.largest)));
        std::string allowed = longest;
        if (limit.number != 0.0)
            allowed = fmt::format("{}, or {}",
                                  limit.inverse ? fmt::format("at least {}", rounded(limit.number * over))
                                                : fmt::format("at most {}", rounded(limit.number / over)),
                                  longest);
        refuse(limit.key, limit.value,
               fmt::format("{}: in a step of {}, {}, and at most {} is possible", limit.harm, rounded(step),
                           in_words(limit, amount), rounded(limit.largest)),
               allowed, "Use a shorter time.step" + (limit.remedy.empty() ? "" : " or " + limit.remedy));
    }
}

std::vector<std::string> warnings_of_step(std::span<const StepLimit> limits, double step) {
    std::vector<std::string> warnings;
    for (const StepLimit& limit : limits)
        if (const double amount = limit.amount(step); amount > limit.advised * (1.0 + 1e-9) && amount <= limit.largest)
            warnings.push_back(fmt::format("the time step is long: in it, {}; {} is advised at most, a step of {}",
                                           in_words(limit, amount), rounded(limit.advised),
                                           rounded(limit.step_of(limit.advised))));
    return warnings;
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

}  // namespace jostle
