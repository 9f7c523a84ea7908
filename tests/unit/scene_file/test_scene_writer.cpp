#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "jostle/scene/scene_keys.hpp"
#include "jostle/scene/validate_scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_writer.hpp"

using namespace jostle;

namespace {

/// Scenes that `validate` accepts, with every member drawn at random.
class RandomScene {
public:
    explicit RandomScene(std::uint64_t seed) : random_(seed) {}

    Scene draw() {
        Scene scene;
        scene.title = text();
        scene.seed = random_() >> 1;
        scene.units.system = chance() ? UnitSystem::reduced : UnitSystem::micro;
        draw_rods(scene);
        draw_box(scene);
        for (bool& open : scene.box.periodic) open = chance();
        scene.fluid = {number(1e-3, 10), chance() ? number(1e-3, 10) : 0.0};
        scene.motion.brownian = chance();
        const bool slender = chance() && scene.rods.length / scene.rods.diameter > 6.0;  // the least of all: 1/7
        scene.mobility.model = slender ? MobilityModel::slender_body : MobilityModel::finite_aspect_ratio;
        draw_contact(scene);
        draw_time(scene);
        draw_swimming(scene);
        scene.output.series_every = 1 + random_() % 1000;
        if (chance()) scene.output.trajectory_every = random_() % 3 * 500;
        if (scene.output.trajectory_every != 0U && chance()) scene.output.trajectory_times = FrameTimes::logarithmic;
        scene.output.checkpoint_every = 1 + (random_() >> 2);
        scene.output.contacts = chance();
        scene.output.stress_conventions = chance();
        scene.output.stress_per_rod = scene.output.trajectory_every != 0U && chance();
        if (chance()) scene.output.field_every = 1 + random_() % 1000;
        if (scene.output.field_every > 0 && chance()) scene.output.field_spacing = number(0.1, 10);
        if (chance()) scene.springs.file = text() + "springs.csv";
        draw_forces(scene);
        if (scene.motion.self_propulsion > 0.0 && chance()) scene.output.active_stress_lag = number(1e-3, 1e3);
        return scene;
    }

private:
    bool chance() { return random_() % 2 == 0; }

    void draw_forces(Scene& scene) {
        if (chance()) {
            for (int k = 0; k < 3; ++k) scene.forces.on_rods[k] = number(1e-12, 1e-9);
            scene.forces.drift = true;
        }
        if (!chance()) return;
        scene.forces.alignment_energy = -number(1e-12, 1e-9);
        for (int k = 0; k < 3; ++k) scene.forces.alignment_axis[k] = number(1e-3, 10);
    }

    /// Between the bounds, uniform in the logarithm, with all bits of the mantissa in use; sometimes a round number.
    double number(double lower, double upper) {
        const double u = std::uniform_real_distribution<double>(0.0, 1.0)(random_);
        const double value = lower * std::pow(upper / lower, u);
        const double round = std::floor(value);
        return chance() && round > lower ? round : value;
    }

    std::string text() {
        const char* letters[] = {"a",    "Z", "\"", "\\", "\n",     "\t",     "\x7f",
                                 "\x01", "#", "=",  "'",  "\u00b5", "\u2713", " "};
        std::string drawn;
        for (std::uint64_t k = random_() % 12; k > 0; --k) drawn += letters[random_() % std::size(letters)];
        return drawn;
    }

    /// Slow enough for the step, if that is known.
    void draw_swimming(Scene& scene) {
        if (chance()) return;
        const double step = scene.time.step.value_or(1.0), fast = 0.05 * scene.rods.diameter / step;
        scene.motion.self_propulsion = number(1e-5 * fast, fast);
        if (chance()) scene.motion.self_propulsion_deviation = number(1e-5 * fast, fast);
        if (chance()) scene.motion.reversal_rate = number(1e-5, 1e5);
        if (chance()) return;
        scene.motion.tumble_rate = number(1e-6, 1e-4) / step;
        if (chance()) scene.motion.tumble_time = number(200, 1e4) * step;
    }

    void draw_contact(Scene& scene) {
        scene.contact.overlap_limit = number(0.1, 0.99);
        if (chance()) {
            scene.contact.model = ContactModel::wca;
            if (scene.fluid.kT == 0.0 || chance()) scene.contact.energy = number(1e-3, 1e3);
            return;
        }
        scene.contact.brownian_correction = chance();
        if (chance()) scene.contact.range = number(1e-9, 1.0) * scene.rods.diameter;
        scene.solver = {chance() ? SolverMethod::automatic : SolverMethod::bbpgd,
                        static_cast<WarmStarts>(random_() % 3),
                        static_cast<StepRule>(random_() % 3),
                        static_cast<ResidualKind>(random_() % 2),
                        number(1e-12, 0.09),
                        1 + random_() % 1000000};
    }

    void draw_rods(Scene& scene) {
        scene.rods.start = static_cast<StartKind>(random_() % 4);
        scene.rods.count = 1000 + random_() % 100000;
        scene.rods.diameter = number(1e-2, 1e2);
        scene.rods.length = chance() ? 0.0 : scene.rods.diameter * number(0.1, 20);
        if (scene.rods.start == StartKind::file) {
            scene.rods.file = "folder/" + text();
            if (chance()) scene.rods.count = 0;
        }
        if ((scene.rods.start == StartKind::random || scene.rods.start == StartKind::aligned) && chance()) {
            scene.rods.count = 100 + random_() % 100;
            scene.rods.diameter_deviation = number(1e-3, 0.25) * scene.rods.diameter;
            scene.rods.length_deviation = number(1e-3, 0.25) * scene.rods.length;
        }
        if (scene.rods.start == StartKind::aligned || scene.rods.start == StartKind::lattice)
            scene.rods.axis = {number(1e-3, 1), -number(1e-3, 1), number(1e-3, 1)};
    }

    void draw_box(Scene& scene) {
        const double edge = scene.rods.diameter * number(200, 1e4);
        if (chance()) {
            scene.box.edges = Vec3{edge, edge * number(0.5, 2), edge * number(0.5, 2)};
        } else {
            scene.box.volume_fraction = number(1e-4, 0.2);
            scene.box.shape = {number(0.5, 2), number(0.5, 2), number(0.5, 2)};
        }
    }

    void draw_time(Scene& scene) {
        const bool still = !scene.motion.brownian || scene.fluid.kT == 0.0;
        if (still || chance())
            scene.time.step = number(1e-6, 1);
        else
            scene.time.rms_step = number(1e-5, 0.5);
        if (chance()) scene.time.equilibration = chance() ? 0.0 : number(1e-3, 1e3);
        scene.time.production = number(1, 1e6);
    }

    std::mt19937_64 random_;
};

}  // namespace

TEST_CASE("a written scene reads back as the same scene, to the last bit") {
    const std::uint64_t seed = 64109;
    MESSAGE("seed " << seed);
    RandomScene random(seed);
    for (int k = 0; k < 1000; ++k) {
        const Scene scene = random.draw();
        validate(scene);
        const std::string text = to_toml(scene);
        CAPTURE(text);
        REQUIRE(parse_scene(text, "resolved.toml") == scene);
    }
}

TEST_CASE("every key that means something is written, with its unit") {
    const Scene scene = parse_scene(
        "box.volume_fraction = 0.2\nrods = {count = 100, length = 5}\ntime.production = 50\n", "short.toml");
    const std::string text = to_toml(scene);
    for (const char* line : {"seed = 1\n",
                             "[units]\nsystem = \"reduced\"\n",
                             "volume_fraction = 0.2\n",
                             "shape = [1.0, 1.0, 1.0]\n",
                             "periodic = [true, true, true]\n",
                             "count = 100\n",
                             "length = 5.0  # D\n",
                             "diameter = 1.0  # D\n",
                             "start = \"random\"\n",
                             "viscosity = 1.0  # mu\n",
                             "kT = 1.0  # kT\n",
                             "model = \"capsule\"\n",
                             "brownian = true\n",
                             "self_propulsion = 0.0  # kT/(mu D2)\n",
                             "brownian_correction = true\n",
                             "range = \"auto\"  # D\n",
                             "overlap_limit = 0.2\n",
                             "method = \"auto\"\n",
                             "step_rule = \"bb1\"\n",
                             "residual = \"length\"\n",
                             "tolerance = 1e-05\n",
                             "max_iterations = 10000\n",
                             "\nstep = \"auto\"",
                             "equilibration = \"auto\"",
                             "production = 50.0  # mu D3/kT\n",
                             "series_every = 10\n",
                             "trajectory_every = \"auto\"\n",
                             "trajectory_times = \"even\"\n",
                             "checkpoint_every = 1000\n",
                             "contacts = false\n"}) {
        CAPTURE(line);
        CHECK(text.find(line) != std::string::npos);
    }
    for (const char* absent : {"edges", "axis", "file", "rms_step ="}) CHECK(text.find(absent) == std::string::npos);
    CHECK(parse_scene(text, "resolved.toml") == scene);
}
