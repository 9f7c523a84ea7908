#include "jostle/scene/validate_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "jostle/error/refuse.hpp"
#include "jostle/motion/tumbles.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/mistakes.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/pressure_control.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/scene_mobility.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/scene_ranges.hpp"
#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/step_accuracy.hpp"
#include "jostle/scene/step_limits.hpp"
#include "jostle/scene/time_step.hpp"
#include "jostle/scene/unused_keys.hpp"
#include "jostle/scene/validate_fluid.hpp"
#include "jostle/scene/validate_plane.hpp"
#include "jostle/scene/validate_schedule.hpp"

namespace jostle {

namespace {

/// b = 2 ln(2 L/D) - 1 > 0, theory, eq. 2.10: below, the drag of a slender body across and along the axis is negative.
const double slender_limit = std::exp(0.5) / 2.0;
/// Of the standard deviation of lengths and diameters to their mean: the smallest is a quarter of it.
constexpr double largest_deviation = 0.25;

void check_start(const Scene& scene) {
    if (scene.rods.start == StartKind::file && scene.rods.file.empty())
        refuse("rods.file", "", "is missing: start = \"file\" reads the rods from a file", "the name of a file",
               "Add file = \"rods.csv\" under [rods]");
    if (scene.rods.start == StartKind::run && scene.rods.run.empty())
        refuse("rods.run", "", "is missing: start = \"run\" takes the rods of another run", "the folder of a run",
               "Add run = \"rods.run\" under [rods]");
    if (dimensions_of(scene) == 2 && scene.rods.axis.z != 0.0)
        refuse("rods.axis", text(scene.rods.axis), "points out of the plane of box.dimensions = 2", "two numbers: x, y",
               "Use [1, 0]");
    if (norm(scene.rods.axis) == 0.0)
        refuse("rods.axis", text(scene.rods.axis), "has no direction", "a vector that is not zero", "Use [1, 0, 0]");
}

/// Deviations that leave every rod a length and a diameter, and that the start can place.
void check_deviations(const Scene& scene) {
    const Scene::RodsTable& rods = scene.rods;
    const auto check = [&](const char* key, double deviation, double mean) {
        if (deviation == 0.0) return;
        if (rods.start == StartKind::lattice)
            refuse(key, text(deviation), "is given with start = \"lattice\", which places rods that are alike", "0",
                   "Use start = \"aligned\" or \"random\"");
        if (!(deviation <= largest_deviation * mean))
            refuse(key, text(deviation), fmt::format("is large against the mean, {}", mean),
                   fmt::format("at most {}, a quarter of the mean", rounded(largest_deviation * mean)), "");
    };
    check("rods.length_deviation", rods.length_deviation, rods.length);
    check("rods.diameter_deviation", rods.diameter_deviation, rods.diameter);
}

void check_box_given_once(const Scene& scene) {
    const auto& fraction = given_fraction(scene);
    const char* key = fraction_key(scene);
    if (fraction && scene.box.edges)
        refuse("box.edges", text(*scene.box.edges), fmt::format("is given beside {} = {}", key, *fraction),
               "one of the two, not both", "Keep one of them; the other follows from it");
    if (!fraction && !scene.box.edges)
        refuse(key, "", "is missing, and so is box.edges: the size of the box is not known", "one of the two",
               fmt::format("Add {} = 0.2 under [box]", parts_of_key(key).second));
}

void check_packing(const Scene& scene) {
    const double fraction = volume_fraction(scene);
    const double aspect_ratio = scene.rods.length / scene.rods.diameter;
    const bool given = given_fraction(scene).has_value();
    const std::string key = given ? fraction_key(scene) : "box.edges", words = fraction_words(scene);
    const std::string value = given ? text(fraction) : text(*scene.box.edges);
    const std::string volume = given ? "" : fmt::format(" ({} {})", words, rounded(fraction));
    const double densest = close_packing(aspect_ratio, dimensions_of(scene));
    if (!(fraction <= densest * (1.0 + 1e-12)))  // edges computed for close packing miss it by rounding
        refuse(key, value,
               fmt::format("cannot be packed{}: the densest packing of rods of L/D = {} fills {}", volume,
                           rounded(aspect_ratio), rounded(densest)),
               fmt::format("{} {} of at most {}", dimensions_of(scene) == 2 ? "an" : "a", words, rounded(densest)),
               given ? "Lower the " + words : "Enlarge the box or use fewer rods");
    const double limit = random_start_limit(aspect_ratio, dimensions_of(scene));
    if (scene.rods.start == StartKind::random && fraction > limit)
        refuse(key, value,
               fmt::format("is too dense for a random start{} with rods of L/D = {}", volume, rounded(aspect_ratio)),
               fmt::format("{} {} of at most {}", dimensions_of(scene) == 2 ? "an" : "a", words, rounded(limit)),
               "Use start = \"aligned\" or \"lattice\", or a lower " + words);
}

/// Whether the rods of the scene have room in its box.
void check_room(const Scene& scene) {
    check_deviations(scene);
    check_packing(scene);
    validate_box(scene, rods_volume(scene), largest_diameter(scene));
    validate_walls(scene, rods_volume(scene), largest_length(scene), largest_diameter(scene));
    validate_sheared_box(scene, rods_volume(scene), largest_length(scene) + largest_diameter(scene));
    validate_packing_of_schedule(scene);
}

void check_motion(const Scene& scene) {
    const double rate = scene.motion.tumble_rate;
    const double longest = Tumbles::largest_share / rate;
    if (rate > 0.0 && scene.motion.tumble_time && !(*scene.motion.tumble_time <= longest))
        refuse("motion.tumble_time", text(*scene.motion.tumble_time),
               fmt::format("leaves rods no time to swim between tumbles: motion.tumble_rate = {}", rate),
               fmt::format("at most {}", rounded(longest)), "Lower tumble_time or tumble_rate");
}

void check_mobility(const Scene& scene) {
    const double aspect_ratio =
        (scene.rods.length - farthest_deviation * scene.rods.length_deviation) / largest_diameter(scene);
    if (scene.mobility.model == MobilityModel::slender_body && !(aspect_ratio > slender_limit))
        refuse("mobility.model", "\"slender_body\"",
               fmt::format("gives rods of L/D = {} a negative drag: it holds for slender rods only",
                           rounded(aspect_ratio)),
               fmt::format("L/D greater than {:.3f}", slender_limit),
               "Use model = \"capsule\", which holds for every L/D");
}

/// L/D of the shortest cells that divisions of mothers of this diameter make, but for one in a million. Of adders and
/// timers half of what a mother deviates by is handed on, so that lengths deviate by sqrt(1 + 1/4 + 1/16 + ...) of what
/// is added.
double shortest_daughter(const Scene& scene, double diameter) {
    const GrowthLaw& growth = scene.growth;
    const double added = 0.5 * (growth.division_length + diameter);
    double deviation = growth.division_deviation * added * std::sqrt(4.0 / 3.0);
    if (growth.division == DivisionRule::sizer) deviation = growth.division_deviation * growth.division_length;
    if (growth.division == DivisionRule::timer)
        deviation = std::hypot(growth.division_deviation, growth.rate_deviation) * added * std::sqrt(4.0 / 3.0);
    const double mother = growth.division_length - 5.0 * deviation;
    return std::max(0.0, 0.5 * (mother - diameter) / diameter);
}

void check_springs(const Scene& scene) {
    if (!scene.springs.file.empty() && grows(scene))
        refuse("springs.file", scene.springs.file,
               "springs hold rods that stay, and with growth.rate cells divide and die", "no springs, or no growth",
               "Remove [springs] or [growth]");
}

void check_fixed_rods(const Scene& scene) {
    if (scene.rods.fixed.empty()) return;
    const std::string& file = scene.rods.fixed;
    if (scene.contact.model == ContactModel::wca)
        refuse("rods.fixed", file, "fixed rods are hard, and contact.model = \"wca\" is soft", "no file",
               "Use contact.model = \"hard\"");
    if (scene.mobility.model == MobilityModel::hydrodynamic)
        refuse("rods.fixed", file, "no flow is known past rods that stand still in the fluid", "no file",
               "Use mobility.model = \"capsule\"");
    if (squeezes_box(scene))
        refuse("rods.fixed", file, "fixed rods stay where they are, and a schedule changes the box", "no file",
               "Remove " + key_of_box_ramp(scene) + ", or fixed");
}

/// Whether something stops the rods that a force drags.
void check_forces(const Scene& scene) {
    const Scene::ForcesTable& forces = scene.forces;
    if (norm(forces.alignment_axis) == 0.0)
        refuse("forces.alignment_axis", text(forces.alignment_axis), "has no direction", "a vector that is not zero",
               dimensions_of(scene) == 2 ? "Use [1, 0]" : "Use [0, 0, 1]");
    if (forces.drift || !drifts(scene)) return;
    const std::array<bool, 3> walled = walled_directions(scene);
    Vec3 held = forces.on_rods;
    for (std::size_t k = 0; k < 3; ++k)
        if (!walled[k]) held[static_cast<int>(k)] = 0.0;
    refuse("forces.on_rods", text(forces.on_rods),
           "drags the rods without end along directions in which no wall stops them", text(held) + ", or drift = true",
           "Close the box there (walls.faces), or set forces.drift = true if the rods are to fall for ever");
}

void check_solver(const Scene& scene) {
    if (scene.contact.model == ContactModel::wca) {
        if (!scene.contact.energy && scene.fluid.kT == 0.0)
            refuse("contact.energy", "", "is missing, and fluid.kT = 0, which would stand for it", "an energy above 0",
                   "Add energy = 1.0 under [contact]");
        return;
    }
    if (scene.solver.residual == ResidualKind::length && scene.solver.tolerance >= scene.contact.overlap_limit)
        refuse("contact.overlap_limit", text(scene.contact.overlap_limit),
               fmt::format("is not larger than the overlap that the solver leaves, solver.tolerance = {}",
                           scene.solver.tolerance),
               fmt::format("greater than {}", scene.solver.tolerance), "Lower solver.tolerance");
}

void check_rms_step(const Scene& scene) {
    if (!scene.time.rms_step) return;
    const char* reason = !scene.motion.brownian ? "motion.brownian = false" : "fluid.kT = 0";
    if (thermal_energy(scene_at_its_hardest(scene)) == 0.0)
        refuse("time.rms_step", text(*scene.time.rms_step),
               fmt::format("measures the step by the Brownian motion, and there is none: {}", reason), "",
               "Give time.step instead");
    if (grows(scene))
        refuse("time.rms_step", text(*scene.time.rms_step),
               "measures the step by the Brownian motion of rods, which changes as they grow", "",
               "Give time.step instead");
}

void check_accuracy(const Scene& scene) {
    if (!scene.time.accuracy) return;
    const bool by_time = scene.time.step.has_value();
    if (by_time || scene.time.rms_step)
        refuse("time.accuracy", text(*scene.time.accuracy),
               fmt::format("is given beside {} = {}", by_time ? "time.step" : "time.rms_step",
                           by_time ? *scene.time.step : *scene.time.rms_step),
               "one of the two, not both", "Keep one of them");
    if (const std::string reason = unknown_step_error(scene); !reason.empty())
        refuse("time.accuracy", text(*scene.time.accuracy),
               "needs to know the error that a step makes, which was measured for hard Brownian rods in equilibrium; "
               "here " +
                   reason,
               "", "Remove it, or give time.step or time.rms_step");
}

void check_time(const Scene& scene) {
    if (scene.time.step && scene.time.rms_step)
        refuse("time.rms_step", text(*scene.time.rms_step),
               fmt::format("is given beside time.step = {}", *scene.time.step), "one of the two, not both",
               "Keep one of them");
    const bool moves = thermal_energy(scene_at_its_hardest(scene)) > 0.0 || swims(scene) || squeezes_box(scene) ||
                       grows(scene) || !scene.springs.file.empty() || scene.forces.on_rods != Vec3{} ||
                       scene.forces.alignment_energy != 0.0 || flows(scene) || scene.pressure.external;
    if (!scene.time.step && !scene.time.rms_step && !moves)
        refuse("time.step", "", "is missing, and nothing in the scene moves that a step could be found from",
               "a time, greater than 0", "Add step = 1e-3 under [time]");
    check_rms_step(scene);
    check_accuracy(scene);
    if (scene.time.step) require_countable_steps(scene, *scene.time.step);
}

/// Whether rods of this volume and diameter can be in a box at all.
void require_room(const std::string& key, const std::string& value, const Vec3& edges, double rods_volume,
                  double largest_diameter, const std::string& remedy) {
    for (int k = 0; k < dimensions_of(edges); ++k) {
        if (edges[k] >= largest_diameter) continue;
        refuse(key, value,
               fmt::format("makes the box thinner than a rod's diameter: edge {} is {}", "xyz"[k], rounded(edges[k])),
               fmt::format("edges of at least {}", largest_diameter), remedy);
    }
    const double fraction = rods_volume / volume_of(edges);
    const bool flat = dimensions_of(edges) == 2;
    if (!(fraction < 1.0))
        refuse(key, value,
               fmt::format("leaves the rods no room: their {} is {} times that of the box", flat ? "area" : "volume",
                           rounded(fraction)),
               fmt::format("{} fraction less than 1", flat ? "an area" : "a volume"),
               "Enlarge the box or use fewer rods");
}

/// Of a scene that is sound otherwise.
void check_step(const Scene& scene) {
    if (!scene.time.step || rods_are_given(scene)) return;  // is looked at once there are rods
    Rods one;
    one.push_back(0, {}, {1, 0, 0}, scene.rods.length, scene.rods.diameter);
    const Box box{box_edges(scene), box_periodic(scene)};
    require_short_step(free_step_limits(scene, *make_mobility(scene), box, one), *scene.time.step);
}

void check_growth(const Scene& scene) {
    validate_growth(scene, largest_diameter(scene));
}

void check_contact_range(const Scene& scene) {
    if (!rods_are_given(scene)) validate_contact_range(scene, largest_length(scene) + largest_diameter(scene));
}

void check_box(const Scene& scene) {
    if (given_fraction(scene).has_value() != scene.box.edges.has_value() && !rods_are_given(scene)) check_room(scene);
}

/// A check of how keys go together, and the tables whose keys it looks at.
struct TogetherCheck {
    void (*check)(const Scene&);
    std::vector<std::string_view> tables;
};

const std::vector<TogetherCheck>& together_checks() {
    static const std::vector<TogetherCheck> checks = {
        {check_start, {"rods", "box"}},
        {validate_plane, {"box", "walls", "mobility", "forces", "schedule", "flow", "rods"}},
        {check_box_given_once, {"box"}},
        {check_box, {"box", "walls", "rods", "schedule", "flow"}},
        {check_motion, {"motion", "schedule"}},
        {check_mobility, {"mobility", "rods"}},
        {validate_fluid, {"mobility", "rods", "box", "motion", "growth", "springs", "schedule", "contact", "solver"}},
        {validate_flow, {"flow", "box", "rods", "motion", "forces", "mobility", "growth", "schedule", "output"}},
        {validate_schedule, {"schedule", "box", "walls", "growth"}},
        {check_springs, {"springs", "growth"}},
        {check_fixed_rods, {"rods", "contact", "mobility", "schedule"}},
        {validate_pressure,
         {"pressure", "flow", "motion", "fluid", "walls", "box", "growth", "schedule", "rods", "mobility", "contact",
          "springs", "forces", "solver"}},
        {check_forces, {"forces", "walls", "box"}},
        {check_solver, {"contact", "solver", "fluid"}},
        {check_time, {"time", "motion", "fluid", "growth", "springs", "schedule", "forces", "flow", "pressure"}},
        {check_growth, {"growth", "rods", "mobility"}},
        {check_contact_range, {"contact", "rods", "growth"}}};
    return checks;
}

}  // namespace

void validate(const Scene& scene) {
    Mistakes alone;  // of the keys by themselves: only of sound ones it can be said how they go together
    alone.look([&] { refuse_unused_keys(scene); });
    alone.look([&] { require_ranges(scene); });
    alone.refuse_any();
    require_fit_together(scene, {});
    check_step(scene);
}

void require_fit_together(const Scene& scene, std::span<const std::string> unsound) {
    Mistakes mistakes;
    const auto is_sound = [&](std::string_view table) {
        return std::find(unsound.begin(), unsound.end(), table) == unsound.end();
    };
    for (const TogetherCheck& each : together_checks())
        if (std::all_of(each.tables.begin(), each.tables.end(), is_sound)) mistakes.look([&] { each.check(scene); });
    mistakes.refuse_any();
}

void validate_box(const Scene& scene, double rods_volume, double largest_diameter) {
    const Vec3 edges = box_edges(scene, rods_volume);
    const bool given = scene.box.edges.has_value();
    require_room(given ? "box.edges" : fraction_key(scene), given ? text(edges) : text(*given_fraction(scene)), edges,
                 rods_volume, largest_diameter,
                 given ? "Enlarge that edge"
                       : fmt::format("Use more rods, a lower {} or a box.shape nearer to a {}", fraction_words(scene),
                                     dimensions_of(scene) == 2 ? "square" : "cube"));
    for (const auto& [time, squeezed] : ramp_of_edges(scene, rods_volume))
        require_room(key_of_box_ramp(scene), fmt::format("[{}, {}]", time, text(squeezed)), squeezed, rods_volume,
                     largest_diameter, "Compress less, or use more rods");
}

void validate_contact_range(const Scene& scene, double longest) {
    const double cell = grows(scene) ? scene.growth.division_length + largest_diameter(scene) : 0.0;
    const double most = std::max(longest, cell);
    if (!scene.contact.range || *scene.contact.range <= most) return;
    refuse("contact.range", text(*scene.contact.range),
           fmt::format("reaches beyond what a rod can touch: the longest measures {} from end to end", rounded(most)),
           fmt::format("at most {}", rounded(most)), "Use \"auto\"");
}

void validate_growth(const Scene& scene, double largest_diameter) {
    const GrowthLaw& growth = scene.growth;
    if (!grows(scene)) return;
    if (!(growth.division_length > largest_diameter))
        refuse(
            "growth.division_length", text(growth.division_length),
            fmt::format("is not above what two daughters need: each gets half of what the length exceeds the diameter, "
                        "{}, by",
                        largest_diameter),
            fmt::format("greater than {}", largest_diameter), "");
    if (!rods_are_given(scene) && !(growth.division_length > scene.rods.length))
        refuse("growth.division_length", text(growth.division_length),
               fmt::format("is not above rods.length = {}, at which cells start", scene.rods.length),
               fmt::format("greater than {}", scene.rods.length), "");
    const double daughter = shortest_daughter(scene, largest_diameter);
    if (scene.mobility.model == MobilityModel::slender_body && !(daughter > slender_limit))
        refuse("growth.division_length", text(growth.division_length),
               fmt::format("makes daughters as short as L/D = {}, too short for the mobility \"slender_body\"",
                           rounded(daughter)),
               fmt::format("greater than {} where nothing deviates",
                           rounded((2.0 * slender_limit + 1.0) * largest_diameter)),
               "Or use model = \"capsule\", which holds for every L/D");
}

}  // namespace jostle
