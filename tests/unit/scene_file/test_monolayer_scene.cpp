// Scenes of two dimensions: vectors of two numbers, an area fraction, and refusals of what only three dimensions have.

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "jostle/error/input_error.hpp"
#include "jostle/rods/wall.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/schedule.hpp"
#include "jostle/scene/units.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/scene_file/scene_reader.hpp"
#include "jostle/scene_file/scene_settings.hpp"
#include "jostle/scene_file/scene_writer.hpp"
#include "support/temporary_folder.hpp"

using namespace jostle;

namespace {

const std::string head = "rods = {count = 100, length = 5.0}\ntime.production = 5.0\n";

std::string refusal(const std::string& text) {
    try {
        parse_scene(text, "flat.toml");
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a monolayer has an area fraction, and vectors of two numbers") {
    const Scene scene =
        parse_scene("box = {dimensions = 2, area_fraction = 0.4, shape = [1, 2]}\n" + head, "flat.toml");
    const double area = 100.0 * (5.0 + std::numbers::pi / 4.0);
    const Vec3 edges = box_edges(scene);
    CHECK(edges.z == 0.0);
    CHECK(edges.y == doctest::Approx(2.0 * edges.x));
    CHECK(edges.x * edges.y == doctest::Approx(area / 0.4));
    const Box box = box_of(scene, std::nullopt);
    CHECK(box.dimensions() == 2);
    CHECK(box.volume() == doctest::Approx(area / 0.4));
    CHECK(box.is_periodic());
    CHECK_FALSE(box.periodic()[2]);
    CHECK(volume_fraction(scene) == 0.4);
    CHECK(unit_of_stress(scene) == "kT D-2");
    CHECK(unit_of_number_density(scene) == "D-2");

    const Scene given = parse_scene(
        "box = {dimensions = 2, edges = [40, 50.0], periodic = [true, false]}\nschedule.area_fraction = [[2, 0.4]]\n" +
            head + "walls.faces = [false, true]\n",
        "flat.toml");
    CHECK(volume_fraction(given) == doctest::Approx(area / 2000.0));
    CHECK(ramp_of_edges(given, area)[0].value.z == 0.0);
    CHECK(area / volume_of(ramp_of_edges(given, area)[0].value) == doctest::Approx(0.4));
    for (const Scene& each : {scene, given}) CHECK(parse_scene(to_toml(each), "again.toml") == each);
    const std::string written = to_toml(given);
    CHECK(has(written, "edges = [40.0, 50.0]"));
    CHECK(has(written, "periodic = [true, false]"));
    CHECK(has(written, "faces = [false, true]"));
    CHECK_FALSE(has(written, "volume_fraction"));
    CHECK_FALSE(has(to_toml(parse_scene("box.volume_fraction = 0.2\n" + head, "")), "area_fraction"));
}

TEST_CASE("a disc: the tube of the plane") {
    const Scene scene = parse_scene(
        "box = {dimensions = 2, area_fraction = 0.3, periodic = [false, false]}\nwalls.container = \"tube\"\n" + head,
        "disc.toml");
    const Box box = box_of(scene, std::nullopt);
    CHECK(box.volume() == doctest::Approx(100.0 * (5.0 + std::numbers::pi / 4.0) / 0.3));
    CHECK(box.volume() == doctest::Approx(std::numbers::pi / 4.0 * box.edges().x * box.edges().x));
    const std::vector<Wall> walls = walls_of(box);
    REQUIRE(walls.size() == 1);
    CHECK(area_of(walls[0], box) == doctest::Approx(std::numbers::pi * box.edges().x));
    CHECK(walls[0].inwards(0.5 * box.edges()).z == 0.0);
    const Box slit = {{20, 30, 0}, {true, false, false}, {.faces = {false, true, false}}};
    CHECK(area_of(walls_of(slit)[0], slit) == 20.0);
}

TEST_CASE("what only three dimensions have, or two, is refused with a reason") {
    const std::string flat = "box = {dimensions = 2, area_fraction = 0.4";
    const std::vector<std::array<std::string, 3>> cases = {
        {"box = {dimensions = 4, area_fraction = 0.4}\n" + head, "box.dimensions = 4", "at most 3"},
        {"box = {dimensions = 2, volume_fraction = 0.4}\n" + head, "box.volume_fraction = 0.4", "Write area_fraction"},
        {"box = {area_fraction = 0.4}\n" + head, "box.area_fraction = 0.4", "set box.dimensions = 2"},
        {"box = {dimensions = 2}\n" + head, "box.area_fraction", "Add area_fraction = 0.2 under [box]"},
        {flat + ", edges = [9, 9]}\n" + head, "box.edges = [9, 9]", "beside box.area_fraction"},
        {"box = {dimensions = 2, edges = [40, 40, 40]}\n" + head, "box.edges = [40, 40, 40]", "two elements"},
        {flat + ", shape = [1, 1, 1]}\n" + head, "box.shape = [1, 1, 1]", "two elements"},
        {flat + ", shape = [1, 0]}\n" + head, "box.shape = [1, 0]", "is zero"},
        {flat + ", periodic = [true, true, false]}\n" + head, "box.periodic", "two elements"},
        {flat + "}\nwalls.faces = [false, false, true]\n" + head, "walls.faces", "two elements"},
        {flat + ", periodic = [false, false]}\nwalls.container = \"sphere\"\n" + head, "walls.container",
         "is a disc in the plane"},
        {flat + ", periodic = [false, false]}\nwalls = {container = \"tube\", axis = \"x\"}\n" + head, "walls.axis",
         "a tube is a disc"},
        {flat + "}\nmobility.model = \"hydrodynamic\"\n" + head, "mobility.model", "in a film is not known"},
        {flat + "}\nflow.shear_rate = 1.0\n" + head, "flow.shear_rate", "have not been tried"},
        {flat + "}\nrods = {count = 9, length = 5, fixed = \"a.csv\"}\ntime.production = 5.0\n", "rods.fixed",
         "have not been tried"},
        {flat + "}\nrods = {count = 9, length = 5, start = \"aligned\", axis = [1, 0, 0]}\ntime.production = 5\n",
         "rods.axis", "two elements"},
        {flat + "}\nschedule.volume_fraction = [[1, 0.5]]\n" + head, "schedule.volume_fraction", "Write area_fraction"},
        {flat + "}\nschedule.edges = [[1, [9, 9, 9]]]\n" + head, "schedule.edges", "two elements"},
        {"box.volume_fraction = 0.2\nschedule.area_fraction = [[1, 0.5]]\n" + head, "schedule.area_fraction",
         "set box.dimensions = 2"},
        {"box = {dimensions = 2, area_fraction = 0.99}\n" + head, "box.area_fraction = 0.99",
         "an area fraction of at most 0.9863"},
        {"box = {dimensions = 2, area_fraction = 0.65}\n" + head, "too dense for a random start",
         "lower area fraction"},
        {"box = {dimensions = 2, edges = [9, 9]}\n" + head, "box.edges = [9, 9]", "area fraction"},
    };
    for (const auto& [text, what, why] : cases) {
        const std::string message = refusal(text);
        CAPTURE(text);
        CAPTURE(message);
        CHECK(has(message, what));
        CHECK(has(message, why));
    }
}

TEST_CASE("settings take the place of one another in the plane, too") {
    const std::string scene =
        "[box]\ndimensions = 2\nedges = [40.0, 40.0]\n[rods]\ncount = 100\nlength = 5.0\n[time]\nproduction = 5.0\n";
    const Scene made = parse_scene(with_settings(scene, "", parse_settings({"box.area_fraction=0.3"})), "");
    CHECK(made.box.area_fraction == 0.3);
    CHECK_FALSE(made.box.edges.has_value());
}

TEST_CASE("rods files of the plane: z and nz may be left out, and are 0") {
    const TemporaryFolder folder;
    const auto beginning = [&](const std::string& rows) {
        std::ofstream(folder.path() + "/rods.csv") << rows;
        std::ofstream(folder.path() + "/scene.toml") << "box = {dimensions = 2, edges = [20, 20]}\nrods = {length = "
                                                        "2.0, start = \"file\", file = \"rods.csv\"}\n"
                                                        "time.production = 5.0\n";
        return beginning_of(read_scene(folder.path() + "/scene.toml"), folder.path() + "/scene.toml").state.rods;
    };
    const auto refused = [&](const std::string& rows) {
        try {
            beginning(rows);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    for (const char* rows : {"x,y,nx,ny\n1,2,3,4\n5,6,0,-1\n", "x,y,z,nx,ny,nz\n1,2,0,3,4,-0\n5,6,0,0,-1,0\n"}) {
        const Rods rods = beginning(rows);
        REQUIRE(rods.size() == 2);
        CHECK(rods.centre[1].y == 6.0);
        CHECK(rods.axis[0].x == doctest::Approx(0.6));
        for (const Vec3& vector : {rods.centre[0], rods.centre[1], rods.axis[0], rods.axis[1]}) {
            CHECK(vector.z == 0.0);
            CHECK_FALSE(std::signbit(vector.z));
        }
    }
    CHECK(has(refused("x,y,z,nx,ny,nz\n1,2,0,3,4,0\n5,6,0.5,0,-1,0\n"), "rods.csv:3: z = 0.5 lies out of the plane"));
    CHECK(has(refused("x,y,nx,ny,nz\n1,2,3,4,0.1\n"), "rods.csv:2: nz = 0.1 lies out of the plane"));
    CHECK(has(refused("x,y,nx\n1,2,3\n"), "x,y,nx,ny"));

    Rods rods;
    rods.push_back(0, {1, 1, 0}, {1, 0, 0}, 2.0, 1.0);
    rods.push_back(1, {9, 9, 0.2}, {1, 0, 0}, 2.0, 1.0);
    Scene scene = parse_scene(
        "box = {dimensions = 2, edges = [20, 20]}\nrods = {count = 2, length = 2.0}\n"
        "time.production = 5.0\n",
        "");
    scene.rods.start = StartKind::file;
    CHECK_THROWS_WITH_AS(beginning_of(scene, rods), doctest::Contains("rod 1: lies out of the plane"), InputError);
}
