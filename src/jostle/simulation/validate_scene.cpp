#include "jostle/simulation/validate_scene.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <type_traits>

#include "jostle/error/input_error.hpp"
#include "jostle/motion/tumbles.hpp"
#include "jostle/parallel/parallel_for.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/simulation/assemble.hpp"
#include "jostle/simulation/rod_size.hpp"
#include "jostle/simulation/scene_keys.hpp"

namespace jostle {

namespace {

/// b = 2 ln(2 L/D) - 1 > 0, theory, eq. 2.10: below, the drag of a slender body across and along the axis is negative.
const double slender_limit = std::exp(0.5) / 2.0;
/// Of the standard deviation of lengths and diameters to their mean: the smallest is a quarter of it.
constexpr double largest_deviation = 0.25;
constexpr double largest_step_number = 1e15;  // counts of steps stay exact as double

[[noreturn]] void refuse(std::string key, std::string value, std::string problem, std::string allowed,
                         std::string suggestion) {
    throw InputError(
        {std::move(key), std::move(value), std::move(problem), std::move(allowed), std::move(suggestion), {}});
}

std::string text(double value) {
    return fmt::format("{}", value);
}
std::string text(const Vec3& value) {
    return fmt::format("[{}, {}, {}]", value.x, value.y, value.z);
}
std::string rounded(double value) {
    return fmt::format("{:.4g}", value);
}

/// The range in words; the bounds that only keep products finite are named when the value breaks them.
std::string describe(const Range& range, double value) {
    const bool finite = std::isfinite(value);
    std::string words;
    if (range.lower == Range::smallest && !(value > 0.0 && value < range.lower))
        words = "greater than 0";
    else if (range.lower > -Range::largest || (finite && value < range.lower))
        words = fmt::format("{} {}", range.lower_included ? "at least" : "greater than", range.lower);
    if (range.upper < Range::largest || (finite && value > range.upper))
        words += fmt::format("{}{} {}", words.empty() ? "" : " and ", range.upper_included ? "at most" : "less than",
                             range.upper);
    return words.empty() ? "a finite number" : words;
}

/// Range check of one key, by the type of its member.
struct RangeCheck {
    std::string key;

    void check(double value, const Range& range) const {
        if (range.contains(value)) return;
        const char* problem = "is outside the allowed range";
        if (!std::isfinite(value))
            problem = "is not a finite number";
        else if (value < 0.0 && range.lower >= 0.0)
            problem = "is negative";
        else if (value == 0.0)
            problem = "is zero";
        refuse(key, text(value), problem, describe(range, value), "");
    }

    void operator()(double value, const Quantity& quantity) const { check(value, quantity.range); }
    void operator()(const std::optional<double>& value, const Quantity& quantity) const {
        if (value) check(*value, quantity.range);
    }
    void operator()(const Vec3& value, const Quantity& quantity) const {
        for (int k = 0; k < 3; ++k) check(value[k], quantity.range);
    }
    void operator()(const std::optional<Vec3>& value, const Quantity& quantity) const {
        if (value) (*this)(*value, quantity);
    }
    void operator()(std::uint64_t value, const Count& count) const {
        if (value >= count.lower && value <= count.upper) return;
        refuse(key, std::to_string(value), "is outside the allowed range",
               value < count.lower ? fmt::format("at least {}", count.lower) : fmt::format("at most {}", count.upper),
               "");
    }
    template <class Member>
    void operator()(const Member&, const Plain&) const {}
};

void check_ranges(const Scene& scene) {
    const std::vector<UnusedKey> unused = unused_keys(scene);
    for_each_key(scene, [&](std::string_view table, std::string_view name, const auto& member, const auto& spec) {
        const std::string key = full_key(table, name);
        if (std::any_of(unused.begin(), unused.end(), [&](const UnusedKey& entry) { return entry.key == key; })) return;
        RangeCheck{key}(member, spec);
    });
}

struct MotionValue {
    const char* key;
    double given;  ///< 0 by default
};

/// The keys of swimmers, which mean nothing where nothing swims.
std::array<MotionValue, 5> motion_values(const Scene& scene) {
    const Scene::MotionTable& motion = scene.motion;
    return {{{"motion.self_propulsion_deviation", motion.self_propulsion_deviation},
             {"motion.tumble_rate", motion.tumble_rate},
             {"motion.tumble_time", motion.tumble_time.value_or(0.0)},
             {"motion.reversal_rate", motion.reversal_rate},
             {"output.active_stress_lag", scene.output.active_stress_lag.value_or(0.0)}}};
}

/// Values given for keys that mean nothing here; the reader sees also those that equal the default.
void check_unused(const Scene& scene) {
    const Scene defaults;
    for (const UnusedKey& unused : unused_keys(scene)) {
        std::string value;
        if (unused.key == "rods.file") value = scene.rods.file;
        if (unused.key == "rods.axis" && !(scene.rods.axis == defaults.rods.axis)) value = text(scene.rods.axis);
        if (unused.key == "rods.length_deviation" && scene.rods.length_deviation != 0.0)
            value = text(scene.rods.length_deviation);
        if (unused.key == "rods.diameter_deviation" && scene.rods.diameter_deviation != 0.0)
            value = text(scene.rods.diameter_deviation);
        if (unused.key == "output.field_spacing" && scene.output.field_spacing)
            value = text(*scene.output.field_spacing);
        if (unused.key == "output.stress_per_rod" && scene.output.stress_per_rod) value = "true";
        if (unused.key == "contact.energy" && scene.contact.energy) value = text(*scene.contact.energy);
        if (unused.key == "contact.range" && scene.contact.range) value = text(*scene.contact.range);
        for (const auto& [key, given] : motion_values(scene))
            if (unused.key == key && given != 0.0) value = text(given);
        if (unused.key == "box.shape" && !(scene.box.shape == defaults.box.shape)) value = text(scene.box.shape);
        if (!value.empty()) refuse(unused.key, value, unused.reason, "", unused.suggestion);
    }
}

void check_start(const Scene& scene) {
    if (scene.rods.start == StartKind::file && scene.rods.file.empty())
        refuse("rods.file", "", "is missing: start = \"file\" reads the rods from a file", "the name of a file",
               "Add file = \"rods.csv\" under [rods]");
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
    if (scene.box.volume_fraction && scene.box.edges)
        refuse("box.edges", text(*scene.box.edges),
               fmt::format("is given beside box.volume_fraction = {}", *scene.box.volume_fraction),
               "one of the two, not both", "Keep one of them; the other follows from it");
    if (!scene.box.volume_fraction && !scene.box.edges)
        refuse("box.volume_fraction", "", "is missing, and so is box.edges: the size of the box is not known",
               "one of the two", "Add volume_fraction = 0.2 under [box]");
}

void check_packing(const Scene& scene) {
    const double fraction = volume_fraction(scene);
    const double aspect_ratio = scene.rods.length / scene.rods.diameter;
    const bool given = scene.box.volume_fraction.has_value();
    const std::string key = given ? "box.volume_fraction" : "box.edges";
    const std::string value = given ? text(fraction) : text(*scene.box.edges);
    const std::string volume = given ? "" : fmt::format(" (volume fraction {})", rounded(fraction));
    const double densest = close_packing(aspect_ratio);
    if (!(fraction <= densest * (1.0 + 1e-12)))  // edges computed for close packing miss it by rounding
        refuse(key, value,
               fmt::format("cannot be packed{}: the densest packing of rods of L/D = {} fills {}", volume,
                           rounded(aspect_ratio), rounded(densest)),
               fmt::format("a volume fraction of at most {}", rounded(densest)),
               given ? "Lower the volume fraction" : "Enlarge the box or use fewer rods");
    const double limit = random_start_limit(aspect_ratio);
    if (scene.rods.start == StartKind::random && fraction > limit)
        refuse(key, value,
               fmt::format("is too dense for a random start{} with rods of L/D = {}", volume, rounded(aspect_ratio)),
               fmt::format("a volume fraction of at most {}", rounded(limit)),
               "Use start = \"aligned\" or \"lattice\", or a lower volume fraction");
}

void check_motion(const Scene& scene) {
    const double rate = scene.motion.tumble_rate;
    const double longest = Tumbles::largest_share / rate;
    if (rate > 0.0 && scene.motion.tumble_time && !(*scene.motion.tumble_time <= longest))
        refuse("motion.tumble_time", text(*scene.motion.tumble_time),
               fmt::format("leaves rods no time to swim between tumbles: motion.tumble_rate = {}", rate),
               fmt::format("at most {}", rounded(longest)), "Lower tumble_time or tumble_rate");
    if (!scene.time.step || scene.rods.start == StartKind::file) return;  // is looked at once there are rods
    Rods one;
    one.push_back(0, {}, {1, 0, 0}, scene.rods.length, scene.rods.diameter);
    require_slow_swimmers(scene, one, *scene.time.step);
}

void check_mobility(const Scene& scene) {
    const double aspect_ratio = (scene.rods.length - farthest_deviation * scene.rods.length_deviation) /
                                (scene.rods.diameter + farthest_deviation * scene.rods.diameter_deviation);
    if (scene.mobility.model == MobilityModel::slender_body && !(aspect_ratio > slender_limit))
        refuse("mobility.model", "\"slender_body\"",
               fmt::format("gives rods of L/D = {} a negative drag: it holds for slender rods only",
                           rounded(aspect_ratio)),
               fmt::format("L/D greater than {:.3f}", slender_limit),
               "Use model = \"finite_aspect_ratio\", which holds for every L/D");
}

void check_growth(const Scene& scene) {
    const GrowthLaw& growth = scene.growth;
    if (growth.rate == 0.0) return;
    if (!(growth.division_length > scene.rods.diameter))
        refuse(
            "growth.division_length", text(growth.division_length),
            fmt::format("is not above what two daughters need: each gets half of what the length exceeds the diameter, "
                        "{}, by",
                        scene.rods.diameter),
            fmt::format("greater than {}", scene.rods.diameter), "");
    if (scene.rods.start != StartKind::file && !(growth.division_length > scene.rods.length))
        refuse("growth.division_length", text(growth.division_length),
               fmt::format("is not above rods.length = {}, at which cells start", scene.rods.length),
               fmt::format("greater than {}", scene.rods.length), "");
    const double daughter = 0.5 * (growth.division_length - scene.rods.diameter) / scene.rods.diameter;
    if (scene.mobility.model == MobilityModel::slender_body && !(daughter > slender_limit))
        refuse(
            "growth.division_length", text(growth.division_length),
            fmt::format("makes daughters of L/D = {}, too short for the mobility \"slender_body\"", rounded(daughter)),
            fmt::format("greater than {}", rounded((2.0 * slender_limit + 1.0) * scene.rods.diameter)),
            "Or use model = \"finite_aspect_ratio\", which holds for every L/D");
}

void check_springs(const Scene& scene) {
    if (!scene.springs.file.empty() && scene.growth.rate > 0.0)
        refuse("springs.file", scene.springs.file,
               "springs hold rods that stay, and with growth.rate cells divide and die", "no springs, or no growth",
               "Remove [springs] or [growth]");
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
    if (!scene.motion.brownian || scene.fluid.kT == 0.0)
        refuse("time.rms_step", text(*scene.time.rms_step),
               fmt::format("measures the step by the Brownian motion, and there is none: {}", reason), "",
               "Give time.step instead");
    if (scene.growth.rate > 0.0)
        refuse("time.rms_step", text(*scene.time.rms_step),
               "measures the step by the Brownian motion of rods, which changes as they grow", "",
               "Give time.step instead");
}

void check_time(const Scene& scene) {
    if (scene.time.step && scene.time.rms_step)
        refuse("time.rms_step", text(*scene.time.rms_step),
               fmt::format("is given beside time.step = {}", *scene.time.step), "one of the two, not both",
               "Keep one of them");
    if (!scene.time.step && !scene.time.rms_step)
        refuse("time.step", "", "is missing, and so is time.rms_step: the time step is not known", "one of the two",
               "Add step = 1e-3 under [time]");
    check_rms_step(scene);
    if (!scene.time.step) return;
    const double step = *scene.time.step;
    require_short_growth(scene, step);
    if (scene.time.production < step)
        refuse("time.production", text(scene.time.production), "is shorter than one step",
               fmt::format("at least time.step = {}", step), "");
    const bool long_production = scene.time.production / step > largest_step_number;
    if (long_production || scene.time.equilibration.value_or(0.0) / step > largest_step_number)
        refuse(long_production ? "time.production" : "time.equilibration",
               text(long_production ? scene.time.production : *scene.time.equilibration),
               fmt::format("takes more than {:g} steps of time.step = {}", largest_step_number, step),
               fmt::format("at most {:g} steps", largest_step_number), "Use a longer step or a shorter time");
}

}  // namespace

void validate(const Scene& scene) {
    check_unused(scene);
    check_ranges(scene);
    check_start(scene);
    check_box_given_once(scene);
    if (scene.rods.start != StartKind::file) {
        check_deviations(scene);
        check_packing(scene);
        validate_box(scene, rods_volume(scene),
                     scene.rods.diameter + farthest_deviation * scene.rods.diameter_deviation);
    }
    check_motion(scene);
    check_mobility(scene);
    check_growth(scene);
    check_springs(scene);
    check_solver(scene);
    check_time(scene);
}

void require_short_growth(const Scene& scene, double time_step) {
    const double longest = 0.1 * scene.rods.diameter, of_step = scene.growth.rate * time_step;
    if (of_step > longest)
        refuse("growth.rate", text(scene.growth.rate),
               fmt::format("lengthens cells by {} in a step of {}: contacts cannot follow", rounded(of_step),
                           rounded(time_step)),
               fmt::format("at most {}, a tenth of the diameter in a step", rounded(longest / time_step)),
               "Use a shorter time.step");
}

void validate_box(const Scene& scene, double rods_volume, double largest_diameter) {
    const Vec3 edges = box_edges(scene, rods_volume);
    const bool given = scene.box.edges.has_value();
    const std::string key = given ? "box.edges" : "box.volume_fraction";
    const std::string value = text(given ? 0.0 : *scene.box.volume_fraction);
    for (int k = 0; k < 3; ++k) {
        if (edges[k] >= largest_diameter) continue;
        refuse(key, given ? text(edges) : value,
               fmt::format("makes the box thinner than a rod's diameter: edge {} is {}", "xyz"[k], rounded(edges[k])),
               fmt::format("edges of at least {}", largest_diameter),
               given ? "Enlarge that edge" : "Use more rods, a lower volume fraction or a box.shape nearer to a cube");
    }
    const double fraction = volume_fraction(scene, rods_volume);
    if (!(fraction < 1.0))
        refuse(key, given ? text(edges) : value,
               fmt::format("leaves the rods no room: their volume is {} times that of the box", rounded(fraction)),
               "a volume fraction less than 1", "Enlarge the box or use fewer rods");
}

double rods_volume(const Scene& scene) {
    if (rods_are_alike(scene))
        return static_cast<double>(scene.rods.count) * rod_volume(scene.rods.length, scene.rods.diameter);
    const std::vector<RodSize> sizes = rod_sizes(scene);
    return parallel_sum<double>(sizes.size(),
                                [&](std::size_t id) { return rod_volume(sizes[id].length, sizes[id].diameter); });
}

Vec3 box_edges(const Scene& scene, double rods_volume) {
    if (scene.box.edges) return *scene.box.edges;
    const Vec3& shape = scene.box.shape;
    const double volume = rods_volume / scene.box.volume_fraction.value();
    return std::cbrt(volume / (shape.x * shape.y * shape.z)) * shape;
}

double volume_fraction(const Scene& scene, double rods_volume) {
    if (scene.box.volume_fraction) return *scene.box.volume_fraction;
    const Vec3& edges = scene.box.edges.value();
    return rods_volume / (edges.x * edges.y * edges.z);
}

Vec3 box_edges(const Scene& scene) {
    return box_edges(scene, rods_volume(scene));
}
double volume_fraction(const Scene& scene) {
    return volume_fraction(scene, rods_volume(scene));
}

double close_packing(double aspect_ratio) {
    return rod_volume(aspect_ratio, 1.0) * 2.0 / (std::numbers::sqrt2 + aspect_ratio * std::numbers::sqrt3);
}

double random_start_limit(double aspect_ratio) {
    return std::min(0.60 / (1.0 + aspect_ratio / 15.0), 4.5 / std::max(aspect_ratio, 1.0));
}

std::vector<UnusedKey> unused_keys(const Scene& scene) {
    std::vector<UnusedKey> unused;
    const StartKind start = scene.rods.start;
    const std::string with = fmt::format("is not used with rods.start = \"{}\"", word_of(start));
    if (scene.box.edges)
        unused.push_back({"box.shape", "is not used with box.edges, which give the shape", "Remove shape or edges"});
    if (start == StartKind::file)
        for (const char* key : {"rods.length_deviation", "rods.diameter_deviation"})
            unused.push_back(
                {key, with + ": the file tells", "Give the file columns length and diameter, or remove it"});
    if (start != StartKind::file) unused.push_back({"rods.file", with, "Set start = \"file\", or remove file"});
    if (start != StartKind::aligned && start != StartKind::lattice)
        unused.push_back({"rods.axis", with, "Set start = \"aligned\", or remove axis"});
    if (scene.motion.self_propulsion == 0.0)
        for (const MotionValue& value : motion_values(scene))
            unused.push_back({value.key, "is not used with motion.self_propulsion = 0: nothing swims",
                              "Set self_propulsion, or remove it"});
    else if (scene.motion.tumble_rate == 0.0)
        unused.push_back({"motion.tumble_time", "is not used with motion.tumble_rate = 0",
                          "Set tumble_rate, or remove tumble_time"});
    const bool soft = scene.contact.model == ContactModel::wca;
    const std::string with_model = fmt::format("is not used with contact.model = \"{}\"", word_of(scene.contact.model));
    if (!soft) unused.push_back({"contact.energy", with_model, "Set model = \"wca\", or remove energy"});
    if (soft)
        for (const char* key : {"contact.brownian_correction", "contact.range", "solver.method", "solver.warm_start",
                                "solver.step_rule", "solver.residual", "solver.tolerance", "solver.max_iterations"})
            unused.push_back({key, with_model + ": there is no contact problem", "Remove it"});
    if (scene.growth.rate == 0.0)
        for (const char* key :
             {"growth.rate_deviation", "growth.division", "growth.division_length", "growth.division_deviation",
              "growth.daughters", "growth.stall_force", "growth.death_rate", "growth.division_every"})
            unused.push_back({key, "is not used without growth.rate", "Add rate under [growth], or remove it"});
    if (scene.output.trajectory_every == 0)
        unused.push_back({"output.stress_per_rod", "is not used without output.trajectory_every: there are no frames",
                          "Set trajectory_every, or remove it"});
    if (scene.output.field_every == 0)
        unused.push_back({"output.field_spacing", "is not used without output.field_every: there is no field",
                          "Set field_every, or remove it"});
    if (scene.springs.file.empty())
        unused.push_back({"springs.file", "names no file", "Name a CSV file of springs, or remove [springs]"});
    if (start == StartKind::file && scene.rods.count == 0)
        unused.push_back({"rods.count", with + ": the file tells", "Remove count"});
    return unused;
}

}  // namespace jostle
