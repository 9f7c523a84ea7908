#include <doctest/doctest.h>

#include <cmath>

#include "jostle/error/input_error.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/validate_scene.hpp"
#include "jostle/setup/largest_overlap.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;

namespace {

Scene many_sizes(std::uint64_t count) {
    Scene scene;
    scene.rods.count = count;
    scene.rods.length = 4.0;
    scene.rods.length_deviation = 0.8;
    scene.rods.diameter_deviation = 0.1;
    scene.box.volume_fraction = 0.3;
    scene.time.rms_step = 0.03;
    scene.time.production = 1.0;
    return scene;
}

/// Mean and standard deviation of value(id).
template <class Value>
std::pair<double, double> moments(std::uint64_t count, Value&& value) {
    double sum = 0.0, squares = 0.0;
    for (std::uint64_t id = 0; id < count; ++id) sum += value(id);
    const double mean = sum / static_cast<double>(count);
    for (std::uint64_t id = 0; id < count; ++id) squares += (value(id) - mean) * (value(id) - mean);
    return {mean, std::sqrt(squares / static_cast<double>(count))};
}

std::string refused_key(const Scene& scene) {
    try {
        validate(scene);
    } catch (const InputError& error) {
        return error.parts().key;
    }
    return "";
}

}  // namespace

TEST_CASE("lengths and diameters have the mean and deviation of the scene, and no wild values") {
    constexpr std::uint64_t count = 20000;
    const Scene scene = many_sizes(count);
    // Cut at three deviations, a normal number has a standard deviation of 0.98658.
    const double cut = 0.98658, error = 1.0 / std::sqrt(static_cast<double>(count));
    const std::vector<RodSize> sizes = rod_sizes(scene);
    const auto [length, length_deviation] = moments(count, [&](std::uint64_t id) { return sizes[id].length; });
    CHECK(std::fabs(length - 4.0) < 5.0 * 0.8 * error);
    CHECK(std::fabs(length_deviation - cut * 0.8) < 5.0 * 0.8 * error);
    const auto [diameter, diameter_deviation] = moments(count, [&](std::uint64_t id) { return sizes[id].diameter; });
    CHECK(std::fabs(diameter - 1.0) < 5.0 * 0.1 * error);
    CHECK(std::fabs(diameter_deviation - cut * 0.1) < 5.0 * 0.1 * error);
    for (const RodSize& size : sizes) {
        CHECK(std::fabs(size.length - 4.0) <= 2.4);
        CHECK(std::fabs(size.diameter - 1.0) <= 0.3);
    }
}

TEST_CASE("a rod's size is a function of seed and id: not of how many there are") {
    const std::vector<RodSize> few = rod_sizes(many_sizes(1000)), many = rod_sizes(many_sizes(5000));
    for (std::size_t id = 0; id < few.size(); ++id) CHECK(few[id].length == many[id].length);
}

TEST_CASE("a start holds these rods at the volume fraction of the scene, without overlap") {
    const Scene scene = many_sizes(300);
    const Box box{box_edges(scene), {true, true, true}};
    const Rods rods = make_start(scene, box);
    const std::vector<RodSize> sizes = rod_sizes(scene);
    for (std::size_t i = 0; i < rods.size(); ++i) {
        CHECK(rods.length[i] == sizes[rods.id[i]].length);
        CHECK(rods.diameter[i] == sizes[rods.id[i]].diameter);
    }
    CHECK(total_volume(rods) / box.volume() == doctest::Approx(0.3).epsilon(1e-12));
    CHECK(largest_overlap(rods, box) == 0.0);
}

TEST_CASE("deviations that cannot be are refused by key") {
    CHECK(refused_key(many_sizes(300)) == "");
    Scene scene = many_sizes(300);
    scene.rods.length_deviation = 1.01;
    CHECK(refused_key(scene) == "rods.length_deviation");
    scene = many_sizes(300);
    scene.rods.diameter_deviation = 0.26;
    CHECK(refused_key(scene) == "rods.diameter_deviation");
    scene.rods.diameter_deviation = -0.1;
    CHECK(refused_key(scene) == "rods.diameter_deviation");
    scene = many_sizes(300);
    scene.rods.start = StartKind::lattice;
    CHECK(refused_key(scene) == "rods.length_deviation");
    scene.rods.start = StartKind::file;
    scene.rods.file = "rods.csv";
    CHECK(refused_key(scene) == "rods.length_deviation");
    scene = many_sizes(300);
    scene.mobility.model = MobilityModel::slender_body;  // the shortest: (4 - 2.4)/1.3
    CHECK(refused_key(scene) == "");
    scene.rods.length_deviation = 1.0;  // (4 - 3)/1.3 = 0.77
    CHECK(refused_key(scene) == "mobility.model");
}
