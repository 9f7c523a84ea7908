#include "check_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "jostle/measurement/frame_steps.hpp"
#include "jostle/measurement/run_length.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_flow.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/step_accuracy.hpp"
#include "jostle/scene/step_limits.hpp"
#include "jostle/scene/time_step.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_settings.hpp"
#include "jostle/scene_file/scene_writer.hpp"
#include "jostle/setup/assemble.hpp"
#include "jostle/setup/free_clocks.hpp"
#include "jostle/setup/lattice.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

/// The rods that derived numbers are about: those of the file, or some that stand for all.
struct Population {
    Rods rods;
    double count = 0.0;
    double volume = 0.0;
};

Population population_of(const Scene& scene, const std::optional<Rods>& from_file) {
    if (from_file)
        return {*from_file, static_cast<double>(from_file->size()), total_volume(*from_file, dimensions_of(scene))};
    return {representative_rods(scene), static_cast<double>(scene.rods.count), rods_volume(scene)};
}

/// Rough costs, from docs/performance.md: a step of one rod takes longer where there are more contacts.
double seconds_per_rod_and_step(double volume_fraction) {
    return (0.15 + 1.6 * volume_fraction + 12.0 * volume_fraction * volume_fraction) * 1e-6;
}
/// What the fluid adds: more blobs of force for longer rods, and more applications of the mobility where rods are dense
/// (docs/guide/hydrodynamics.md).
double seconds_of_fluid_per_rod_and_step(const Scene& scene, double volume_fraction) {
    if (scene.mobility.model != MobilityModel::hydrodynamic) return 0.0;
    return (8.0 + 4.0 * scene.rods.length / scene.rods.diameter) * (0.2 + 8.0 * volume_fraction) * 1e-6;
}
double bytes_of_fluid_per_rod(const Scene& scene) {
    if (scene.mobility.model != MobilityModel::hydrodynamic) return 0.0;
    return 3000.0 + 800.0 * scene.rods.length / scene.rods.diameter;
}
double bytes_per_rod(double volume_fraction) {
    return 520.0 + 3000.0 * volume_fraction + 8300.0 * volume_fraction * volume_fraction;
}

void print(const char* name, const std::string& value) {
    std::printf("%-28s %s\n", name, value.c_str());
}

std::string with_unit(double value, const Scene& scene, Dimension dimension) {
    const ReadableUnit unit = readable_unit(scene, unit_of(scene, dimension));
    return fmt::format("{:.6g}{}{}", value * unit.factor, unit.name.empty() ? "" : " ", unit.name);
}

/// What numbers in the scene are in.
std::string units_text(const Scene& scene) {
    if (scene.units.system == UnitSystem::micro)
        return dimensions_of(scene) == 2 ? "um, s, pN (stress in pN/um)" : "um, s, pN (stress in pN/um2 = Pa)";
    const auto unit = [&](Dimension dimension) { return readable_unit_of(scene, dimension); };
    std::string text = fmt::format("length {}, ", unit(dimension::length));
    if (scene.fluid.kT == 1.0) return text + fmt::format("energy kT, time {}", unit(dimension::time));
    text += fmt::format("viscosity {}, time time_unit", unit(dimension::viscosity));
    if (grows(scene)) text += " = " + with_unit(1.0, scene, dimension::time);
    return text;
}

/// L/D, or the range of it.
std::string aspect_ratios(const Rods& rods) {
    const auto ratio = [&](std::size_t i) { return rods.length[i] / rods.diameter[i]; };
    double least = ratio(0), largest = least;
    for (std::size_t i = 1; i < rods.size(); ++i) {
        least = std::min(least, ratio(i));
        largest = std::max(largest, ratio(i));
    }
    return least == largest ? fmt::format("{:.6g}", least) : fmt::format("{:.6g} to {:.6g}", least, largest);
}

void print_swimming(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, double dt) {
    const Swimming swimming = swimming_of(scene);
    const double persistence = persistence_time(scene, mobility, rods.size());
    print("persistence time, free",
          std::isfinite(persistence) ? with_unit(persistence, scene, dimension::time) : "without end");
    if (swimming.tumble_rate > 0.0) {
        const double turn =
            std::numbers::pi / static_cast<double>(Tumbles(swimming.tumble_rate, swimming.tumble_time).steps(dt));
        print("tumble time", with_unit(swimming.tumble_time, scene, dimension::time));
        print("tumble turns ends per step",
              fmt::format("{:.3g} D at most", 0.5 * turn * rods.length[0] / rods.diameter[0]));
    }
    if (stirs(scene))
        print("force dipole", with_unit(swimming.force_dipole, scene, dimension::energy) +
                                  (swimming.force_dipole > 0.0 ? ": pushers" : ": pullers"));
    const double lag = active_stress_lag(scene, mobility, rods.size());
    const bool too_short = lag > scene.time.equilibration.value_or(0.0) + scene.time.production;
    print("active stress lag", with_unit(lag, scene, dimension::time) +
                                   (too_short ? ": the run may be too short to measure the active stress" : ""));
}

std::string step_error_text(const Scene& scene, const Rods& rods, const Box& box, double rms_step) {
    const StepError error = known_step_error(scene, rods, box);
    return fmt::format("about {:.2g} %, by the largest that was measured of {}",
                       100.0 * largest_step_error(rms_step, error), error.states);
}

void print_motion(const Scene& scene, const MobilityOperator& mobility, const Box& box, const Rods& rods, double dt) {
    const double kT = thermal_energy(scene);
    const RodMobility rod = mobility.of_rod(0);
    const double diameter = *std::min_element(rods.diameter.begin(), rods.diameter.end());
    const double rotation = kT * rod.rotational;
    if (kT > 0.0) {
        const ReadableUnit diffusion = readable_unit(scene, unit_of(scene, {2, -1, 0}));
        const double fastest = fastest_diffusion(kT, mobility, rods.size(), dimensions_of(scene));
        print("D_parallel, D_perpendicular", fmt::format("{:.6g}, {}", kT * rod.parallel * diffusion.factor,
                                                         with_unit(kT * rod.perpendicular, scene, {2, -1, 0})));
        print("D_t of the fastest rod", with_unit(fastest, scene, {2, -1, 0}));
        print("D_R, 1/D_R",
              with_unit(rotation, scene, dimension::rate) + ", " + with_unit(1.0 / rotation, scene, dimension::time));
        print("dt D_R", fmt::format("{:.3g}", dt * rotation));
        const double rms_step = std::sqrt(2.0 * fastest * dt) / diameter;
        print("rms step / D", fmt::format("{:.4g}", rms_step));
        if (unknown_step_error(scene).empty())
            print("error of Z by the step", step_error_text(scene, rods, box, rms_step));
    }
    const double speed = scene.motion.self_propulsion;
    if (swims(scene)) {
        double farthest = 0.0;
        for (const double own : SelfPropulsion(swimming_of(scene)).speeds(rods, scene.seed))
            farthest = std::max(farthest, std::fabs(own) * dt / diameter);
        print("propelled per step / D", fmt::format("{:.3g}", farthest));
        if (kT > 0.0 && rods.length[0] > 0.0)
            print("U_0/(L D_R)", fmt::format("{:.4g}", speed / (rods.length[0] * rotation)));
    }
}

/// One number of a ramp, or the edges of a box.
std::string value_text(double value, const Scene& scene, Dimension dimension) {
    return with_unit(value, scene, dimension);
}
std::string value_text(const Vec3& value, const Scene& scene, Dimension dimension) {
    const std::string unit = readable_unit_of(scene, dimension);
    if (dimensions_of(value) == 2) return fmt::format("{:.6g} x {:.6g} {}", value.x, value.y, unit);
    return fmt::format("{:.6g} x {:.6g} x {:.6g} {}", value.x, value.y, value.z, unit);
}

template <class Value>
void print_ramp(const char* name, const Value& first, const Ramp<Value>& ramp, const Scene& scene,
                Dimension dimension) {
    if (ramp.empty()) return;
    std::string text = value_text(first, scene, dimension);
    for (const auto& [time, value] : ramp)
        text += fmt::format(", at {} {}", with_unit(time, scene, dimension::time), value_text(value, scene, dimension));
    print(name, text);
}

/// What the scene's schedule changes, from what to what.
void print_schedule(const Scene& scene, const Box& box, double rods_volume) {
    if (!has_schedule(scene)) return;
    print_ramp("ramp of self_propulsion", scene.motion.self_propulsion, scene.schedule.self_propulsion, scene,
               dimension::speed);
    print_ramp("ramp of kT", scene.fluid.kT, scene.schedule.kT, scene, dimension::energy);
    print_ramp("ramp of box edges", box.edges(), ramp_of_edges(scene, rods_volume), scene, dimension::length);
    print_ramp("ramp of phi", rods_volume / box.volume(), ramp_of_fraction(scene), scene, dimension::none);
    const double end = schedule_end(scene), run = scene.time.equilibration.value_or(end) + scene.time.production;
    if (run < end)
        print("WARNING",
              fmt::format("the run ends at {}, before the schedule does", with_unit(run, scene, dimension::time)));
    if (scene.time.equilibration.value_or(end) < end)
        print("averages", "take in the schedule: nothing is in equilibrium, and there are no error bars");
}

/// How many of its own clocks the production covers, and how much of it would do for error bars, which is returned; 0
/// where nothing tells.
double print_clocks(const Scene& scene, const MobilityOperator& mobility, const Rods& rods, const Box& box, double phi,
                    std::span<const Spring> springs) {
    constexpr double margin = 1.25;  // over what is needed at the least
    if (grows(scene)) return 0.0;
    const FreeClocks clocks = free_clocks(scene, mobility, rods, box, phi, springs);
    const double production = scene.time.production;
    std::string covered, needed;
    double enough = 0.0;
    const auto cover = [&](double time, double least, const std::string& what) {
        if (time == 0.0) return;
        covered += (covered.empty() ? "" : ", ") + in_times(production / time, what);
        if (needed.empty() && production < least * time) needed = fmt::format("{} {}s are needed", least, what);
        enough = std::max(enough, margin * least * time);
    };
    if (std::isinf(clocks.rotation)) {
        print("rotation time, alone", "without end: there is no steady state to average over");
        return 0.0;
    }
    if (clocks.rotation > 0.0) {
        print("rotation time, alone", with_unit(clocks.rotation, scene, dimension::time));
        if (clocks.axes_turn)
            print("rotation time, in the crowd", fmt::format("about {:.2g} {}", clocks.slowdown * clocks.rotation,
                                                             readable_unit_of(scene, dimension::time)));
        cover(clocks.rotation, least_rotation_times, "rotation time");
        if (clocks.axes_turn) enough *= clocks.slowdown;
    }
    if (clocks.flow > 0.0 && flows(scene)) {
        print(oscillates(scene) ? "periods of the flow" : "strain of the production",
              fmt::format("{:.4g}", production / clocks.flow));
        if (needed.empty() && production < least_flow_times * clocks.flow)
            needed = fmt::format("{} are needed", least_flow_times);
    }
    if (clocks.diffusion > 0.0) print("diffusion time D^2/D_t", with_unit(clocks.diffusion, scene, dimension::time));
    if (clocks.arrest > 1.0)
        print("diffusion time, in the crowd", fmt::format("about {:.2g} {}", clocks.arrest * clocks.diffusion,
                                                          readable_unit_of(scene, dimension::time)));
    cover(clocks.arrest * clocks.diffusion, least_diffusion_times, "diffusion time");
    if (clocks.passing > 0.0) print("rods pass each other in", with_unit(clocks.passing, scene, dimension::time));
    cover(clocks.passing, least_passing_times, "passing time");
    if (clocks.spreading > 0.0) print("rods spread in", with_unit(clocks.spreading, scene, dimension::time));
    cover(clocks.spreading, least_spreading_times, "spreading time");
    if (clocks.volume > 0.0) print("volume relaxes in", with_unit(clocks.volume, scene, dimension::time));
    cover(clocks.volume, least_volume_times, "relaxation time");
    if (clocks.springs > 0.0) print("springs relax in", with_unit(clocks.springs, scene, dimension::time));
    cover(clocks.springs, least_spring_times, "spring relaxation time");
    if (covered.empty()) return 0.0;
    print("production", needed.empty() ? "covers " + covered + " of a rod alone"
                                       : "too short to tell: covers " + covered + "; at least " + needed);
    print("production for error bars",
          fmt::format("about {:.2g} {} (an estimate)", enough, readable_unit_of(scene, dimension::time)));
    return enough;
}

void print_limits(const Scene& scene, const Rods& rods, const MobilityOperator& mobility,
                  std::span<const Spring> springs, double dt) {
    if (!springs.empty()) {
        print("springs", fmt::format("{}", springs.size()));
        print("springs relax per step",
              fmt::format("{:.3g} of their stretch at most", spring_limit(scene, springs, rods, mobility).amount(dt)));
    }
    if (scene.contact.model == ContactModel::wca)
        print("potential relaxes per step",
              fmt::format("{:.3g} of the overlap of rods that meet with 5 kT, at most; 2 is too much",
                          potential_limit(scene, rods, mobility).amount(dt)));
}

/// How a population changes in a time, without noise and stalling: its end, and its mean, over its beginning.
struct PopulationGrowth {
    double end = 1.0, mean = 1.0;
};

PopulationGrowth population_growth(const Scene& scene, double time) {
    const GrowthLaw& growth = scene.growth;
    if (!grows(scene)) return {};
    const double doubling = 0.5 * (growth.division_length + scene.rods.diameter) / growth.rate;
    const double exponent = (std::numbers::ln2 / doubling - growth.death_rate) * time;
    print("doubling time", with_unit(doubling, scene, dimension::time));
    return {std::exp(exponent), exponent == 0.0 ? 1.0 : std::expm1(exponent) / exponent};
}

constexpr double max_rods = 4e9;  ///< rows have 32 bits

/// `for_errors`: the production that error bars take, about, or 0.
void print_cost(const Scene& scene, const Population& population, const Box& box, double dt, double for_errors) {
    const double phi = population.volume / box.volume();
    // In whole rows of the series, as they are run.
    const auto every = static_cast<double>(scene.output.series_every);
    const auto in_rows = [&](double time) { return every * std::ceil(time / (dt * every) - 1e-9); };
    const double steps = in_rows(expected_equilibration(scene)) + std::max(every, in_rows(scene.time.production));
    const PopulationGrowth growth = population_growth(scene, steps * dt);
    const double count = population.count * growth.end, filled = phi * growth.end;
    const bool colony = grows(scene) && !box.is_periodic();  // as dense as cells lie, whatever the box
    const double densest =
        colony ? crowded(box.dimensions()) : std::max(phi, std::min(filled, crowded(box.dimensions())));
    if (grows(scene)) {
        const bool too_many = !(count <= max_rods);
        print("N in the end, about",
              too_many ? "more than any run can hold: end it earlier" : fmt::format("{:.3g}", count));
        if (too_many) return;
        if (box.is_periodic())
            print("phi in the end, about",
                  fmt::format("{:.3g}{}", filled,
                              filled <= crowded(box.dimensions()) ? "" : ": cells have no room to grow so many"));
    }
    // A run whose equilibration is to be found goes on until it has error bars, if that is not too long.
    const double asked = scene.time.production;
    const bool goes_on = !scene.time.equilibration && for_errors <= longest_run_in_productions * asked;
    const double longer = goes_on ? std::max(1.0, for_errors / asked) : 1.0;
    const double rows = steps / every;
    const FrameSteps frame_steps(scene, dt, population.count);
    const double frames = frame_steps.frames(steps);
    print("steps", fmt::format("{:.6g}{}", steps,
                               scene.time.equilibration ? "" : " (if equilibration takes a quarter of production)"));
    if (longer > 1.0) print("steps with error bars, about", fmt::format("{:.2g}", steps * longer));
    if (frame_steps.every() > 0)
        print("frames", scene.output.trajectory_times == FrameTimes::logarithmic
                            ? fmt::format("{:.0f}, at logarithmic times", frames)
                            : fmt::format("{:.0f}, one every {} steps", frames, frame_steps.every()));
    print("memory, about",
          fmt::format("{:.0f} MB", 20.0 + count * (bytes_per_rod(densest) + bytes_of_fluid_per_rod(scene)) / 1e6));
    print("disk, about", fmt::format("{:.1f} MB", (rows * 400.0 + frames * count * 52.0 + count * 250.0) / 1e6));
    const double on_the_way = 0.5 * (phi + densest);  // of exponential growth, mean over the cells
    const double seconds =
        steps * population.count * growth.mean *
        (seconds_per_rod_and_step(on_the_way) + seconds_of_fluid_per_rod_and_step(scene, on_the_way));
    print("time on one thread, about",
          colony ? "not known: the larger a colony, the longer its contact forces take to find"
                 : fmt::format("{:.3g} s{}", seconds,
                               longer > 1.0 ? fmt::format(", with error bars {:.2g} s", seconds * longer) : ""));
}

ExitCode check(const Scene& scene, const std::string& scene_path) {
    const auto from_file = rods_from_file(scene, scene_path);
    const Population population = population_of(scene, from_file);
    const Box box = box_of(scene, from_file);
    if (from_file) beginning_of(scene, scene_path);  // which looks for overlaps
    require_lattice_fits(scene, box);
    const double phi = population.volume / box.volume();
    const auto model = make_mobility(scene);
    const auto mobility = model->at(population.rods, box);
    const std::vector<Spring> springs =
        springs_from_file(scene, scene_path, population.rods, static_cast<std::uint64_t>(population.count));
    const double dt = time_step(scene, *model, box, population.rods, springs);
    require_countable_steps(scene, dt);
    const auto limits = step_limits(scene, *model, box, population.rods, springs);
    require_short_step(limits, dt);
    const auto field = make_field(scene, box);
    const auto fixed = fixed_rods(scene, scene_path);

    std::printf("%s\n# what follows from it\n", to_toml(scene).c_str());
    print("units", units_text(scene));
    print("N", fmt::format("{:.0f}", population.count));
    print("L/D", aspect_ratios(population.rods));
    print(dimensions_of(scene) == 2 ? "phi (area fraction)" : "phi", fmt::format("{:.6g}", phi));
    if (const std::string warning = start_warning(scene, phi); !warning.empty()) print("WARNING", warning);
    print("box", value_text(box.edges(), scene, dimension::length));
    if (fixed)
        print("fixed rods", fmt::format("{}, {} {:.6g} but for their overlaps", fixed->size(), fraction_words(scene),
                                        total_volume(*fixed, dimensions_of(scene)) / box.volume()));
    print_schedule(scene, box, population.volume);
    print("time step", with_unit(dt, scene, dimension::time));
    for (const std::string& warning : warnings_of_step(limits, dt)) print("WARNING", warning);
    print_motion(scene, *mobility, box, population.rods, dt);
    if (swims(scene)) print_swimming(scene, *mobility, population.rods, dt);
    print_limits(scene, population.rods, *mobility, springs, dt);
    if (field) {
        const auto& [x, y, z] = field->cells();
        print("stress field", dimensions_of(scene) == 2 ? fmt::format("{} x {} cells", x, y)
                                                        : fmt::format("{} x {} x {} cells", x, y, z));
    }
    const Ramp<Vec3> ramp_of_box = ramp_of_edges(scene, population.volume);
    const Box last = ramp_of_box.empty() ? box : box.with_edges(ramp_of_box.back().value);
    const double for_errors =
        print_clocks(scene_at_end(scene), *mobility, population.rods, last, population.volume / last.volume(), springs);
    print_cost(scene, population, last, dt, for_errors);
    return ExitCode::done;
}

}  // namespace

ExitCode check_command(const std::string& scene_path, const std::vector<std::string>& set) {
    const std::vector<Setting> settings = parse_settings(set);
    return in_settings(scene_path, settings, [&] {
        const Scene scene = parse_scene(with_settings(read_scene_text(scene_path), scene_path, settings), scene_path);
        return in_scene_file(scene_path, [&] { return check(scene, scene_path); });
    });
}
