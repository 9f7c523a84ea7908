// --set KEY=VALUE: what a scene file becomes, and how errors about it are told.
#include <doctest/doctest.h>

#include "jostle/error/input_error.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_settings.hpp"

using namespace jostle;

namespace {

const std::string scene =
    "title = \"rods\"\n"
    "[box]  # of the rods\n"
    "volume_fraction = 0.2  # dense\n"
    "shape = [1,\n"
    "         1, 2]\n"
    "[rods]\n"
    "count = 100\n"
    "length = 5\n"
    "[time]\n"
    "production = 50.0";  // no line end

std::string with(const std::vector<std::string>& settings, const std::string& text = scene) {
    return with_settings(text, "rods.toml", parse_settings(settings));
}

std::string message(const std::vector<std::string>& settings, const std::string& text = scene) {
    try {
        const auto parsed = parse_settings(settings);
        in_settings("rods.toml", parsed,
                    [&] { return parse_scene(with_settings(text, "rods.toml", parsed), "rods.toml"); });
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool starts_with(const std::string& text, const std::string& part) {
    INFO(text);
    return text.rfind(part, 0) == 0;
}

}  // namespace

TEST_CASE("values are replaced where they stand, with all comments kept") {
    CHECK(with({}) == scene);
    const std::string changed = with({"box.volume_fraction = 0.3", "box.shape=[1, 2, 3]", "title=a \"b\""});
    CHECK(changed ==
          "title = \"a \\\"b\\\"\"\n[box]  # of the rods\nvolume_fraction = 0.3  # dense\nshape = [1, 2, 3]\n"
          "[rods]\ncount = 100\nlength = 5\n[time]\nproduction = 50.0");
    CHECK(parse_scene(changed, "").title == "a \"b\"");
}

TEST_CASE("keys that are missing are added to their table, wherever that stands") {
    const Scene made = parse_scene(with({"seed=7", "time.rms_step=0.05", "rods.start=aligned", "contact.range=1",
                                         "box.periodic=[true, "
                                         "true, false]"}),
                                   "");
    CHECK(made.seed == 7);
    CHECK(made.time.rms_step == 0.05);
    CHECK(made.rods.start == StartKind::aligned);
    CHECK(made.contact.range == 1.0);
    CHECK_FALSE(made.box.periodic[2]);
    const std::string dotted = "box.volume_fraction = 0.2\nrods = {count = 9, length = 1}\ntime = {}\n";
    const Scene other =
        parse_scene(with({"box.shape=[1, 1, 2]", "rods.diameter=2", "rods.count=8", "time.production=3"}, dotted), "");
    CHECK(other.box.shape.z == 2.0);
    CHECK(other.rods.diameter == 2.0);
    CHECK(other.rods.count == 8);
    CHECK(other.time.production == 3.0);
}

TEST_CASE("of keys that exclude each other the one that is set stays") {
    const Scene made = parse_scene(with({"box.edges=[20, 20, 20]"}), "");
    CHECK(made.box.edges.has_value());
    CHECK_FALSE(made.box.volume_fraction.has_value());
    CHECK(with({"box.edges=[20, 20, 20]"}).find("# dense") != std::string::npos);
    const Scene back =
        parse_scene(with({"box.volume_fraction=0.1", "time.rms_step=0.02"},
                         "[box]\nedges = [9, 9, 9]\n[rods]\ncount = 9\nlength = 1\n[time]\nstep = 0.1\nproduction = 1"),
                    "");
    CHECK(back.box.volume_fraction == 0.1);
    CHECK(back.time.rms_step == 0.02);
    CHECK_FALSE(back.time.step.has_value());
}

TEST_CASE("errors about a key that was set name --set") {
    CHECK(starts_with(message({"box.volume_fraction=0.95"}), "--set: box.volume_fraction = 0.95: cannot be packed"));
    CHECK(starts_with(message({"rods.count=many"}), "--set: rods.count = \"many\": is a text, the wrong type"));
    CHECK(starts_with(message({"rods.count=3 # few"}), "--set: rods.count = \"3 # few\": is a text"));
    CHECK(starts_with(message({"rods.count=3", "rods.count=4"}), "--set: rods.count = 4: is set twice"));
    CHECK(starts_with(message({"rods.count="}), "--set: rods.count: has no value"));
    CHECK(starts_with(message({"rods.count"}), "--set = rods.count: is not of the form KEY=VALUE"));
    CHECK(starts_with(message({"=3"}), "--set = =3: is not of the form KEY=VALUE"));
    const std::string misspelt = message({"box.volume_fracton=0.3"});
    CHECK(starts_with(misspelt, "--set: box.volume_fracton = 0.3: is an unknown key"));
    CHECK(misspelt.ends_with("Did you mean \"volume_fraction\"?"));
    CHECK(message({"volume_fraction=0.3"}).ends_with("Did you mean \"box.volume_fraction\"?"));
    CHECK(message({"bx.volume_fraction=0.3"}).ends_with("Did you mean \"box.volume_fraction\"?"));
    CHECK(message({"box=0.3"}).find("is an unknown key") != std::string::npos);
}

TEST_CASE("errors about the file name its places") {
    CHECK(starts_with(message({"seed=1"}, "[box]\nvolume_fracton = 0.2\n"), "rods.toml:2:1: box.volume_fracton"));
    CHECK(starts_with(message({"seed=1"}, "[box\n"), "rods.toml:1"));
}

TEST_CASE("a table [sweep] is for the command of that name") {
    const Scene made = parse_scene(scene + "\n[sweep]\nbox.volume_fraction = [0.1, 0.2]\nreplicas = 2\n", "");
    CHECK(made.box.volume_fraction == 0.2);
    CHECK_THROWS_AS(parse_scene("sweep = 3\n" + scene, ""), InputError);
}
