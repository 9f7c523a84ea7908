// Every kind of bad input to a scene: the message names place, key, value as written and what to do.
#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <random>
#include <vector>

#include "jostle/error/input_error.hpp"
#include "jostle/error/nearest_word.hpp"
#include "jostle/scene_file/scene_reader.hpp"

using namespace jostle;

namespace {

const std::vector<std::string> good_lines = {
    "title = \"test\"",                // 1
    "seed = 7",                        // 2
    "[units]",                         // 3
    "system = \"reduced\"",            // 4
    "[box]",                           // 5
    "volume_fraction = 0.2",           // 6
    "periodic = [true, true, false]",  // 7
    "[rods]",                          // 8
    "count = 100",                     // 9
    "length = 5",                      // 10
    "start = \"random\"",              // 11
    "[fluid]",                         // 12
    "kT = 1.0",                        // 13
    "[time]",                          // 14
    "step = 1e-3",                     // 15
    "production = 50.0",               // 16
};

/// The good scene with line `number` (0: none) replaced.
std::string scene_with(int number, const std::string& line) {
    std::string text;
    for (std::size_t k = 0; k < good_lines.size(); ++k)
        text += (static_cast<int>(k) + 1 == number ? line : good_lines[k]) + "\n";
    return text;
}

InputError::Parts refusal(const std::string& text) {
    try {
        parse_scene(text, "bad.toml");
    } catch (const InputError& error) {
        const std::string message = error.what();  // a line for each mistake
        CHECK(static_cast<std::size_t>(std::count(message.begin(), message.end(), '\n')) ==
              error.parts().others.size());
        return error.parts();
    }
    FAIL("accepted: " << text);
    return {};
}

constexpr int whole_scene = 0;

struct Case {
    int replaced;  // line of the good scene; whole_scene: `by` is all of it
    std::string by;
    int line, column;
    std::string key, value, problem, advice;  // `problem` and `advice` (allowed or suggestion) are parts of the message
};

void check(const Case& c) {
    CAPTURE(c.by);
    const InputError::Parts parts = refusal(c.replaced == whole_scene ? c.by : scene_with(c.replaced, c.by));
    const std::string message = InputError(parts).what();
    CAPTURE(message);
    CHECK(parts.place.file == "bad.toml");
    CHECK(parts.place.line == c.line);
    CHECK(parts.place.column == c.column);
    CHECK(parts.key == c.key);
    CHECK(parts.value == c.value);
    CHECK(parts.problem.find(c.problem) != std::string::npos);
    CHECK((parts.allowed + parts.suggestion).find(c.advice) != std::string::npos);
    CHECK(!(parts.allowed + parts.suggestion).empty());
}

}  // namespace

TEST_CASE("a good scene is read") {
    const Scene scene = parse_scene(scene_with(0, ""), "good.toml");
    CHECK(scene.title == "test");
    CHECK(scene.seed == 7);
    CHECK(scene.box.volume_fraction == 0.2);
    CHECK(scene.box.periodic == std::array{true, true, false});
    CHECK(scene.rods.count == 100);
    CHECK(scene.rods.length == 5.0);
    CHECK(scene.time.step == 1e-3);
    CHECK(!scene.time.rms_step);
    CHECK(!scene.time.equilibration);
    CHECK(!scene.contact.range);
}

TEST_CASE("defaults: auto, byte order mark, CRLF") {
    Scene scene = parse_scene("\xef\xbb\xbf" + scene_with(15, "equilibration = \"auto\"\r"), "good.toml");
    CHECK(!scene.time.rms_step);
    CHECK(!scene.time.step);
    CHECK(!scene.time.equilibration);
    scene = parse_scene(scene_with(12,
                                   "[contact]\nrange = 0.5\n[solver]\nmethod = \"bbpgd\"\n"
                                   "step_rule = \"alternating\"\nresidual = \"paper\"\n[fluid]"),
                        "good.toml");
    CHECK(scene.contact.range == 0.5);
    CHECK(scene.solver.method == SolverMethod::bbpgd);
    CHECK(scene.solver.step_rule == StepRule::alternating);
    CHECK(scene.solver.residual == ResidualKind::paper);
}

TEST_CASE("micro system: numbers carry units") {
    const Scene scene = parse_scene(
        "units.system = \"micro\"\n"
        "box.edges = [\"30 um\", 2e1, \"30000 nm\"]\n"
        "rods = {count = 10, length = \"2500 nm\", diameter = \"1 \u00b5m\"}\n"
        "fluid = {viscosity = \"1e-3 Pa s\", kT = \"4.11e-21 J\"}\n"
        "motion.self_propulsion = \"2 um/s\"\n"
        "time = {step = \"0.1 ms\", production = \"35.1 s\", equilibration = \"1 min\"}\n",
        "micro.toml");
    CHECK(scene.box.edges.value() == Vec3{30, 20, 30});
    CHECK(scene.rods.length == 2.5);
    CHECK(scene.rods.diameter == 1.0);
    CHECK(scene.fluid.viscosity == 1e-3);
    CHECK(scene.fluid.kT == doctest::Approx(0.00411).epsilon(1e-15));
    CHECK(scene.motion.self_propulsion == 2.0);
    CHECK(scene.time.step.value() == 1e-4);
    CHECK(scene.time.production == 35.1);
    CHECK(scene.time.equilibration == 60.0);
}

TEST_CASE("unknown keys and tables") {
    const std::vector<Case> cases = {
        {10, "lenght = 5.0", 10, 1, "rods.lenght", "5.0", "unknown key", "Did you mean \"length\"?"},
        {13, "kt = 1.0", 13, 1, "fluid.kt", "1.0", "unknown key", "Did you mean \"kT\"?"},
        {6, "  vol_fraction = 0.2 # of rods", 6, 3, "box.vol_fraction", "0.2", "unknown key", "\"volume_fraction\"?"},
        {13, "zzz = 1", 13, 1, "fluid.zzz", "1", "unknown key", "\"viscosity\", \"kT\""},
        {13, "viscosity = 1\ncount = 3", 14, 1, "fluid.count", "3", "unknown key", "belongs to [rods]"},
        {16, "production = 50.0\nseed = 3", 17, 1, "time.seed", "3", "unknown key", "at the top"},
        {2, "sead = 1", 2, 1, "sead", "1", "unknown key", "Did you mean \"seed\"?"},
        {12, "[fluids]", 12, 2, "fluids", "", "unknown table", "Did you mean \"fluid\"?"},
        {12, "[friction]\nheight = 1\n[fluid]", 12, 2, "friction", "", "unknown table", "[motion]"},
        {2, "fluids.kT = 3", 2, 1, "fluids", "", "unknown table", "Did you mean \"fluid\"?"},
        {10, "[rods.length]", 10, 1, "rods.length", "[rods.length]", "is a table", "a number"},
    };
    for (const Case& c : cases) check(c);
}

TEST_CASE("wrong types") {
    const std::vector<Case> cases = {
        {10, "length = \"5.0\"", 10, 10, "rods.length", "\"5.0\"", "a text, the wrong type", "Remove the quotes: 5.0"},
        {10, "length = \"long\"", 10, 10, "rods.length", "\"long\"", "a text, the wrong type", "a number in D"},
        {10, "length = true", 10, 10, "rods.length", "true", "is true or false", "a number"},
        {10, "length = [5.0]", 10, 10, "rods.length", "[5.0]", "is an array", "a number"},
        {10, "length = 1979-05-27", 10, 10, "rods.length", "1979-05-27", "is a date", "a number"},
        {10, "length = {x = 1}", 10, 10, "rods.length", "{x = 1}", "is a table", "a number"},
        {9, "count = 2000.0", 9, 9, "rods.count", "2000.0", "not a whole number", "Write 2000, without"},
        {9, "count = 2e3", 9, 9, "rods.count", "2e3", "not a whole number", "Write 2000, without"},
        {9, "count = 0.5", 9, 9, "rods.count", "0.5", "not a whole number", "Write digits only"},
        {9, "count = nan", 9, 9, "rods.count", "nan", "not a whole number", "Write digits only"},
        {9, "count = \"100\"", 9, 9, "rods.count", "\"100\"", "a text, the wrong type", "Remove the quotes: 100"},
        {12, "[motion]\nbrownian = 1\n[fluid]", 13, 12, "motion.brownian", "1", "a whole number", "true or false"},
        {12, "[motion]\nbrownian = \"true\"\n[fluid]", 13, 12, "motion.brownian", "\"true\"", "a text", "quotes: true"},
        {1, "title = 3", 1, 9, "title", "3", "a whole number, the wrong type", "a text in quotes"},
        {4, "system = 1", 4, 10, "units.system", "1", "a whole number", "one of \"reduced\", \"micro\""},
        {whole_scene, "title = \"x\"\nrods = 5\n", 2, 8, "rods", "5", "must be a table", "Write [rods]"},
        {whole_scene, "[[rods]]\ncount = 3\n", 1, 1, "rods", "[[rods]]", "is an array", "Write [rods]"},
        {whole_scene, "rods.length.x = 5\nrods.count = 3\n", 1, 6, "rods.length", "length", "is a table", "a number"},
        {6, "volume_fraction = \"0.2 um\"", 6, 19, "box.volume_fraction", "\"0.2 um\"", "a text", "a number"},
    };
    for (const Case& c : cases) check(c);
}

TEST_CASE("arrays") {
    const std::vector<Case> cases = {
        {7, "periodic = [true, true]", 7, 12, "box.periodic", "[true, true]", "has 2 elements", "three elements"},
        {7, "periodic = true", 7, 12, "box.periodic", "true", "is true or false", "an array of three"},
        {7, "periodic = [true, true, 1]", 7, 25, "box.periodic", "1", "a whole number", "true or false"},
        {6, "edges = [10, 10, 10, 10]", 6, 9, "box.edges", "[10, 10, 10, 10]", "has 4 elements", "three elements"},
        {6, "edges = [10,\n  10,\n  \"ten\"]", 8, 3, "box.edges", "\"ten\"", "a text", "a number in D"},
        {6, "edges = []", 6, 9, "box.edges", "[]", "has 0 elements", "three elements"},
        {6, "edges = [10, -10, 10]", 6, 9, "box.edges", "[10, -10, 10]", "is negative", "greater than 0"},
        {6, "edges = [10, inf, 10]", 6, 9, "box.edges", "[10, inf, 10]", "not a finite number", "greater than 0"},
        {6, "volume_fraction = 0.2\nshape = [1, 0, 1]", 7, 9, "box.shape", "[1, 0, 1]", "is zero", "at least 1e-06"},
        {11, "start = \"aligned\"\naxis = [0, 0, 0]", 12, 8, "rods.axis", "[0, 0, 0]", "no direction", "[1, 0, 0]"},
    };
    for (const Case& c : cases) check(c);
}

TEST_CASE("words") {
    const std::vector<Case> cases = {
        {4, "system = \"mikro\"", 4, 10, "units.system", "\"mikro\"", "not one of the words",
         "Did you mean \"micro\"?"},
        {4, "system = \"SI\"", 4, 10, "units.system", "\"SI\"", "not one of the words", "\"reduced\", \"micro\""},
        {11, "start = \"Random\"", 11, 9, "rods.start", "\"Random\"", "not one of the words", "mean \"random\"?"},
        {12, "[mobility]\nmodel = \"slender-body\"\n[fluid]", 13, 9, "mobility.model", "\"slender-body\"", "not one",
         "\"slender_body\"?"},
        {12, "[solver]\nmethod = \"aut\"\n[fluid]", 13, 10, "solver.method", "\"aut\"", "not one", "\"auto\"?"},
        {12, "[solver]\nstep_rule = \"bb3\"\n[fluid]", 13, 13, "solver.step_rule", "\"bb3\"", "not one", "\"bb1\"?"},
        {12, "[solver]\nresidual = \"\"\n[fluid]", 13, 12, "solver.residual", "\"\"", "not one", "\"paper\""},
        {16, "production = 50.0\nequilibration = \"atuo\"", 17, 17, "time.equilibration", "\"atuo\"",
         "neither a number", "Did you mean \"auto\"?"},
        {12, "[contact]\nrange = \"automatic\"\n[fluid]", 13, 9, "contact.range", "\"automatic\"", "neither a number",
         "Did you mean \"auto\"?"},
        {15, "rms_step = \"auto\"", 15, 12, "time.rms_step", "\"auto\"", "a text, the wrong type", "a number"},
        {15, "rms_step = 0.03\nstep = \"auto\"", 16, 8, "time.step", "\"auto\"", "is not used with time.rms_step",
         "Remove one"},
    };
    for (const Case& c : cases) check(c);
}

TEST_CASE("numbers out of range") {
    const std::vector<Case> cases = {
        {2, "seed = -1", 2, 8, "seed", "-1", "is negative", "at least 0"},
        {9, "count = -5", 9, 9, "rods.count", "-5", "is negative", "at least 1"},
        {9, "count = 0", 9, 9, "rods.count", "0", "outside", "at least 1"},
        {9, "count = 2147483648", 9, 9, "rods.count", "2147483648", "outside", "at most 2147483647"},
        {9, "count = 9223372036854775807", 9, 9, "rods.count", "9223372036854775807", "outside", "at most"},
        {9, "count = 9223372036854775808", 9, 28, "rods.count", "9223372036854775808", "too large",
         "9223372036854775807"},
        {10, "length = -5.0", 10, 10, "rods.length", "-5.0", "is negative", "at least 0"},
        {10, "length = nan", 10, 10, "rods.length", "nan", "not a finite number", "at least 0"},
        {10, "length = +inf", 10, 10, "rods.length", "+inf", "not a finite number", "at least 0"},
        {10, "length = 1e40", 10, 10, "rods.length", "1e40", "outside", "at most 1e+15"},
        {10, "length = 1e400", 10, 15, "rods.length", "1e400", "not a number", "1e308"},
        {10, "length = 5\ndiameter = 0", 11, 12, "rods.diameter", "0", "is zero", "greater than 0"},
        {10, "length = 5\ndiameter = 1e-40", 11, 12, "rods.diameter", "1e-40", "outside", "at least 1e-15"},
        {13, "kT = -1", 13, 6, "fluid.kT", "-1", "is negative", "at least 0"},
        {13, "viscosity = 0.0", 13, 13, "fluid.viscosity", "0.0", "is zero", "greater than 0"},
        {12, "[motion]\nself_propulsion = -1\n[fluid]", 13, 19, "motion.self_propulsion", "-1", "negative",
         "at least 0"},
        {6, "volume_fraction = 0", 6, 19, "box.volume_fraction", "0", "is zero", "greater than 0"},
        {6, "volume_fraction = -0.2", 6, 19, "box.volume_fraction", "-0.2", "is negative", "less than 1"},
        {6, "volume_fraction = nan", 6, 19, "box.volume_fraction", "nan", "not a finite", "less than 1"},
        {15, "step = 0", 15, 8, "time.step", "0", "is zero", "greater than 0"},
        {15, "step = -1e-3", 15, 8, "time.step", "-1e-3", "is negative", "greater than 0"},
        {15, "rms_step = 3", 15, 12, "time.rms_step", "3", "outside", "at most 0.5"},
        {16, "production = 0", 16, 14, "time.production", "0", "is zero", "greater than 0"},
        {16, "production = 1e-4", 16, 14, "time.production", "1e-4", "shorter than one step", "time.step = 0.001"},
        {16, "production = 1e29", 16, 14, "time.production", "1e29", "more than 1e+15 steps", "at most"},
        {16, "production = 1\nequilibration = -1", 17, 17, "time.equilibration", "-1", "is negative", "at least 0"},
        {16, "production = 1\nequilibration = 1e20", 17, 17, "time.equilibration", "1e20", "steps", "at most"},
        {12, "[solver]\ntolerance = 0\n[fluid]", 13, 13, "solver.tolerance", "0", "is zero", "greater than 0"},
        {12, "[solver]\ntolerance = 0.1\n[fluid]", 13, 13, "solver.tolerance", "0.1", "outside", "less than 0.1"},
        {12, "[solver]\nmax_iterations = 0\n[fluid]", 13, 18, "solver.max_iterations", "0", "outside", "at least 1"},
        {12, "[contact]\nrange = 0\n[fluid]", 13, 9, "contact.range", "0", "is zero", "greater than 0"},
        {12, "[contact]\noverlap_limit = 1e-6\n[fluid]", 13, 17, "contact.overlap_limit", "1e-6", "1e-05", "tolerance"},
        {12, "[output]\nseries_every = 0\n[fluid]", 13, 16, "output.series_every", "0", "outside", "at least 1"},
        {12, "[output]\ncheckpoint_every = 0\n[fluid]", 13, 20, "output.checkpoint_every", "0", "outside",
         "at least 1"},
        {12, "[output]\ntrajectory_every = 0\ntrajectory_times = \"even\"\n[fluid]", 14, 20, "output.trajectory_times",
         "\"even\"", "is not used with output.trajectory_every = 0", ""},
        {12, "[output]\ntrajectory_every = \"each\"\n[fluid]", 13, 20, "output.trajectory_every", "\"each\"",
         "wrong type", "at least 0, or \"auto\""},
        {12, "[output]\ntrajectory_every = -1\n[fluid]", 13, 20, "output.trajectory_every", "-1", "negative",
         "at least 0"},
    };
    for (const Case& c : cases) check(c);
}

TEST_CASE("keys that are missing, given twice, or do not go together") {
    const std::string head = "box.volume_fraction = 0.2\nrods = {count = 100, length = 5}\n";
    const std::vector<Case> cases = {
        {9, "", 8, 1, "rods.count", "", "is missing", "Add count = 2000 under [rods]"},
        {10, "", 8, 1, "rods.length", "", "is missing", "Add length = 5.0 under [rods]"},
        {16, "", 14, 1, "time.production", "", "is missing", "Add production = 50.0"},
        {6, "", 5, 1, "box.volume_fraction", "", "is missing, and so is box.edges", "Add volume_fraction"},
        {6, "volume_fraction = 0.2\nedges = [9, 9, 9]", 7, 9, "box.edges", "[9, 9, 9]", "beside box.volume_fraction",
         "not both"},
        {15, "step = 1e-3\nrms_step = 0.03", 16, 12, "time.rms_step", "0.03", "beside time.step", "not both"},
        {6, "edges = [20, 20, 20]\nshape = [1, 1, 1]", 7, 9, "box.shape", "[1, 1, 1]", "not used with box.edges",
         "Remove"},
        {11, "file = \"rods.csv\"", 11, 8, "rods.file", "\"rods.csv\"", "not used with rods.start = \"random\"",
         "start = \"file\""},
        {11, "axis = [1, 0, 0]", 11, 8, "rods.axis", "[1, 0, 0]", "not used with rods.start = \"random\"",
         "\"aligned\""},
        {11, "start = \"file\"", 8, 1, "rods.file", "", "is missing", "Add file"},
        {whole_scene, head + "fluid.kT = 0\ntime = {production = 5, rms_step = 0.03}\n", 4, 36, "time.rms_step", "0.03",
         "fluid.kT = 0", "Give time.step instead"},
        {whole_scene, head + "motion.brownian = false\ntime = {production = 5, rms_step = 0.03}\n", 4, 36,
         "time.rms_step", "0.03", "motion.brownian = false", "Give time.step instead"},
        {whole_scene, head + "motion.brownian = false\ntime.production = 5\n", 4, 1, "time.step", "", "is missing",
         "Add step"},
        {whole_scene, "box.volume_fraction = 0.2\ntime.production = 5\n", 1, 1, "rods.count", "", "is missing",
         "Add count"},
        {10, "length = 5\nlength = 6", 11, 10, "rods.length", "6", "given twice", "Keep one"},
        {12, "[rods]\ndiameter = 1\n[fluid]", 12, 1, "", "[rods]", "table is given twice", "one heading"},
    };
    for (const Case& c : cases) check(c);
}

TEST_CASE("a box or a model that the rods do not allow") {
    const std::vector<Case> cases = {
        {6, "volume_fraction = 0.95", 6, 19, "box.volume_fraction", "0.95", "cannot be packed", "at most 0.8835"},
        {6, "volume_fraction = 0.46", 6, 19, "box.volume_fraction", "0.46", "too dense for a random", "at most 0.45"},
        {6, "edges = [8, 8, 8]", 6, 9, "box.edges", "[8, 8, 8]", "too dense", "at most 0.45"},
        {6, "edges = [7, 7, 7]", 6, 9, "box.edges", "[7, 7, 7]", "cannot be packed", "at most 0.8835"},
        {6, "edges = [3, 3, 3]", 6, 9, "box.edges", "[3, 3, 3]", "cannot be packed", "at most 0.8835"},
        {6, "edges = [100, 0.9, 100]", 6, 9, "box.edges", "[100, 0.9, 100]", "edge y is 0.9", "at least 1"},
        {6, "volume_fraction = 0.2\nshape = [1, 1, 1e-3]", 6, 19, "box.volume_fraction", "0.2", "thinner", "shape"},
        {11, "diameter = 10\n[mobility]\nmodel = \"slender_body\"", 13, 9, "mobility.model", "\"slender_body\"",
         "L/D = 0.5 a negative drag", "capsule"},
    };
    for (const Case& c : cases) check(c);
}

TEST_CASE("units") {
    const std::string head =
        "units.system = \"micro\"\nbox.volume_fraction = 0.1\nfluid = {kT = 0.004, viscosity = 1e-3}\n"
        "time = {step = 1e-4, production = 1}\n";
    const auto with_length = [&](const std::string& length) {
        return refusal(head + "rods = {count = 9, diameter = 1, length = " + length + "}\n");
    };
    const InputError::Parts wrong = with_length("\"3 s\"");
    CHECK(wrong.key == "rods.length");
    CHECK(wrong.value == "\"3 s\"");
    CHECK(wrong.place.line == 5);
    CHECK(wrong.place.column == 43);
    CHECK(wrong.problem == "is a quantity in s");
    CHECK(wrong.allowed.find("a number in um") != std::string::npos);
    CHECK(wrong.suggestion.find("300 nm") != std::string::npos);
    CHECK(with_length("\"3 parsec\"").problem == "has the unknown unit \"parsec\"");
    CHECK(with_length("\"3 \\n\"").problem == "cannot be read from \"?\" on");
    CHECK(with_length("\"3\"").suggestion == "Remove the quotes: 3");
    CHECK(with_length("\"-300 nm\"").value == "\"-300 nm\"");
    CHECK(with_length("\"-300 nm\"").problem == "is negative");
    check({10, "length = \"5 um\"", 10, 10, "rods.length", "\"5 um\"", "carries a unit", "units.system = \"micro\""});
    // 1 is no natural value of these in um, s, pN
    const InputError::Parts missing = refusal(
        "units.system = \"micro\"\nbox.volume_fraction = 0.1\nrods = {count = 9, length = 3, diameter = 1}\n"
        "time = {step = 1e-4, production = 1}\nfluid.viscosity = 1e-3\n");
    CHECK(missing.key == "fluid.kT");
    CHECK(missing.place.line == 5);
}

TEST_CASE("text that is not TOML") {
    const std::vector<Case> cases = {
        {16, "production =", 16, 13, "time.production", "", "has no value", "after the \"=\""},
        {10, "length == 5", 10, 9, "rods.length", "= 5", "is not a value", "after \"=\""},
        {10, "length 5", 10, 8, "", "length 5", "no \"=\"", "key = value"},
        {10, "length = 5 um", 10, 12, "rods.length", "5 um", "follows the value", "quotes"},
        {10, "length = 5,0", 10, 11, "rods.length", "5,0", "follows the value", "One key a line"},
        {10, "length = five", 10, 11, "rods.length", "five", "is not a value", "quotes"},
        {10, "length = .5", 10, 10, "rods.length", ".5", "not a number", "0.5"},
        {10, "length = 05", 10, 12, "rods.length", "05", "cannot begin with 0", "leading zeros"},
        {11, "start = \"random", 11, 16, "rods.start", "\"random", "no closing quote", "Close it"},
        {11, "start = random", 11, 9, "rods.start", "random", "is not a value", "Put text in quotes"},
        {7, "periodic = True", 7, 12, "box.periodic", "True", "is not a value", "lower-case"},
        {8, "[rods", 8, 6, "", "[rods", "no closing \"]\"", "[rods]"},
        {1, "title = \"\xff\"", 1, 9, "", "", "not text in UTF-8", "UTF-8"},
        {10, "= 5", 10, 1, "", "= 5", "no key", "key = value"},
        {13, "\"k\\nT\" = 1", 13, 1, "fluid.\"k\\nT\"", "1", "unknown key", "\"kT\"?"},
    };
    for (const Case& c : cases) check(c);
    CHECK(refusal("").problem.find("is empty") != std::string::npos);
    CHECK(refusal("# only a comment\n").problem.find("is empty") != std::string::npos);
    CHECK(refusal(std::string("seed = 1\0\n", 10)).problem == "is not a text file");
    std::string dots = "x";
    for (int k = 0; k < 100000; ++k) dots += ".x";  // deeper than the parser's recursion can go
    CHECK(refusal(dots + " = 1").problem == "a line of 200005 characters");
}

TEST_CASE("a scene cut short anywhere is refused or complete, and never crashes") {
    const std::string whole = scene_with(0, "");
    int accepted = 0;
    for (std::size_t end = 0; end < whole.size(); ++end) {
        try {
            parse_scene(whole.substr(0, end), "cut.toml");
            ++accepted;
        } catch (const InputError& error) {
            CHECK(error.parts().place.line >= 1);
        }
    }
    CHECK(accepted == 3);  // production = 5, 50 and 50.0: a number that lost its end is a number
}

TEST_CASE("random damage never crashes") {
    const std::uint64_t seed = 20190213;
    MESSAGE("seed " << seed);
    std::mt19937_64 random(seed);
    const std::string whole = scene_with(0, "");
    for (int k = 0; k < 3000; ++k) {
        std::string text = whole;
        for (int bit = 0; bit < 3; ++bit) text[random() % text.size()] = static_cast<char>(random());
        try {
            parse_scene(text, "damaged.toml");
        } catch (const InputError& error) {
            const std::string message = error.what();
            CHECK(std::none_of(message.begin(), message.end(), [](char c) { return c >= 0 && c < ' ' && c != '\n'; }));
        }
    }
}

TEST_CASE("files that are missing, directories, unreadable, too large") {
    char folder_name[] = "/tmp/jostle_scene_XXXXXX";
    const std::filesystem::path folder = mkdtemp(folder_name);
    const auto message = [](const std::filesystem::path& path) {
        try {
            read_scene(path);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    std::ofstream(folder / "rods.toml") << scene_with(0, "");
    CHECK(message(folder / "rods.toml").empty());
    CHECK(read_scene(folder / "rods.toml").rods.count == 100);
    CHECK(message(folder / "rod.toml").find("no such file") != std::string::npos);
    CHECK(message(folder / "rod.toml").find("Did you mean \"rods.toml\"?") != std::string::npos);
    CHECK(message(folder / "none" / "x.toml").find("no such file") != std::string::npos);
    CHECK(message(folder).find("is a directory") != std::string::npos);
    CHECK(message("").find("no such file") != std::string::npos);
    std::ofstream(folder / "empty.toml") << "";
    CHECK(message(folder / "empty.toml").find("empty.toml:1:1: scene: is empty") != std::string::npos);
    std::ofstream(folder / "bad.toml") << scene_with(10, "lenght = 5");
    CHECK(message(folder / "bad.toml").find("bad.toml:10:1: rods.lenght = 5: is an unknown key") != std::string::npos);
    std::ofstream(folder / "large.toml") << std::string(2 << 20, '\n');
    CHECK(message(folder / "large.toml").find("larger than 1 MiB") != std::string::npos);
    if (geteuid() != 0) {  // root reads everything
        chmod((folder / "rods.toml").c_str(), 0);
        CHECK(message(folder / "rods.toml").find("cannot be opened: Permission denied") != std::string::npos);
    }
    std::filesystem::remove_all(folder);
}

TEST_CASE("the nearest word") {
    const std::vector<std::string> words = {"length", "diameter", "kT", "volume_fraction"};
    CHECK(nearest_word("lenght", words) == "length");
    CHECK(nearest_word("KT", words) == "kT");
    CHECK(nearest_word("diametre", words) == "diameter");
    CHECK(nearest_word("volumefraction", words) == "volume_fraction");
    CHECK(nearest_word("atuo", {"auto"}) == "auto");  // one swap, not two replacements
    CHECK(nearest_word("viscosity", words) == "");
    CHECK(nearest_word("", words) == "");
    CHECK(nearest_word(std::string(1000, 'l'), words) == "");
    CHECK(did_you_mean("viscosity", words) == "");
}

TEST_CASE("all mistakes of a scene are said at once, in the order of their lines; what is missing comes last") {
    try {
        parse_scene(
            "random_seed = 3\n[box]\nvolume_fraction = 1.3\n[rods]\naspect_ratio = 5.0\ncount = \"many\"\n"
            "[time]\ndt = 0.1\n",
            "bad.toml");
        FAIL("accepted");
    } catch (const InputError& error) {
        std::vector<InputError::Parts> parts = error.parts().others;
        parts.insert(parts.begin(), error.parts());
        const std::vector<std::pair<std::string, int>> expected = {{"random_seed", 1},       {"box.volume_fraction", 3},
                                                                   {"rods.aspect_ratio", 5}, {"rods.count", 6},
                                                                   {"time.dt", 8},           {"time.production", 7}};
        REQUIRE(parts.size() == expected.size());
        for (std::size_t k = 0; k < parts.size(); ++k) {
            CHECK(parts[k].key == expected[k].first);
            CHECK(parts[k].place.line == expected[k].second);
        }
    }
}

TEST_CASE("once all keys are sound, all that do not go together are said at once") {
    const InputError::Parts parts = refusal(
        "[box]\nvolume_fraction = 0.7\n[rods]\ncount = 10\nlength = 3.0\n[time]\nstep = 0.1\nrms_step = 0.1\n"
        "production = 1.0\n");
    CHECK(parts.key == "box.volume_fraction");
    REQUIRE(parts.others.size() == 1);
    CHECK(parts.others[0].key == "time.rms_step");
    CHECK(parts.others[0].place.line == 8);
}

TEST_CASE("what does not go together is said beside mistakes of keys, where these are in other tables") {
    // An unknown key of [output], a time that is missing, a box given twice, a tolerance that does not suit the limit.
    const InputError::Parts parts = refusal(
        "[box]\nvolume_fraction = 0.1\nedges = [9, 9, 9]\n[rods]\ncount = 10\nlength = 3.0\n[contact]\n"
        "overlap_limit = 1e-6\n[time]\nstep = 0.1\nrms_step = 0.1\n[output]\nserie_every = 3\n");
    std::vector<std::string> keys = {parts.key};
    for (const InputError::Parts& other : parts.others) keys.push_back(other.key);
    // Of [time] nothing is said beside what is missing there.
    CHECK(keys ==
          std::vector<std::string>{"box.edges", "contact.overlap_limit", "output.serie_every", "time.production"});
}

TEST_CASE("a mistake whose table is not known keeps silent what may follow from it") {
    CHECK(refusal("volume_fraction = 0.1\n[rods]\ncount = 10\nlength = 3.0\n[time]\nproduction = 1\n").others.empty());
}

TEST_CASE("a misspelt key stands for itself: it is not said to be missing, too") {
    for (const char* line : {"lenght = 5.0", "aspect_ratio = 5.0"}) {
        const InputError::Parts parts = refusal("[box]\nvolume_fraction = 0.1\n[rods]\ncount = 9\n" +
                                                std::string(line) + "\n[time]\nproduction = 1.0\n");
        CHECK(parts.suggestion.find("\"length\"") != std::string::npos);
        CHECK(parts.others.empty());
    }
}

TEST_CASE("other names of keys lead to them") {
    const std::vector<std::pair<std::string, std::string>> names = {
        {"dt", "\"step\", under [time]"},
        {"temperature", "\"kT\", under [fluid] (an energy)"},
        {"Aspect_Ratio", "\"length\", under [rods]"},
        {"random_seed", "\"seed\", at the top"},
        {"n_rods", "\"count\", under [rods]"},
        {"phi", "\"volume_fraction\", under [box]"}};
    for (const auto& [name, advice] : names)
        for (const char* heading : {"", "[output]\n"}) {
            CAPTURE(name);
            const InputError::Parts parts = refusal(heading + name + " = 1.0\n");
            CHECK(parts.suggestion.find("It is called " + advice) == 0);
        }
}

TEST_CASE("of very many mistakes the first twenty are told, and how many more there are") {
    std::string text;
    for (int k = 0; k < 30; ++k) text += "unheard_of_" + std::to_string(k) + " = 1\n";
    const InputError::Parts parts = refusal(text);
    REQUIRE(parts.others.size() == 20);
    CHECK(parts.others.back().problem.find("more mistakes") != std::string::npos);
}
