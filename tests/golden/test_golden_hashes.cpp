// The bits that small scenes leave are those of hashes.txt: a change that is not to change results changes none.
//
// A line a scene of scenes/: its name, the hash of its state after 60 steps, and that of what the steps reported. To
// make the file anew after a change that is to change bits: GOLDEN_HASHES=hashes.txt test_golden_hashes, and say so in
// the commit. Hashes are the same for any number of threads and any x86-64 processor (decision 0014).

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "golden_hash.hpp"
#include "jostle/scene_file/rods_of_scene.hpp"
#include "jostle/setup/assemble.hpp"

using namespace jostle;

namespace {

const std::filesystem::path folder = std::filesystem::path(JOSTLE_TEST_SOURCES) / "golden";
constexpr int steps = 60;

std::string hashes_of(const std::filesystem::path& scene_file) {
    const Scene scene = read_scene(scene_file);
    Simulation simulation = assemble(scene, beginning_of(scene, scene_file).state);
    Hash results;
    std::size_t active_contacts = 0;
    for (int k = 0; k < steps; ++k) {
        const StepReport report = simulation.step();
        REQUIRE(report.status == LcpStatus::converged);
        active_contacts += report.active_contacts;
        add_results(results, report, simulation);
    }
    REQUIRE(active_contacts > steps);  // else nothing collides
    return fmt::format("{:016x} {:016x}", state_hash(simulation), results.value());
}

std::map<std::string, std::string> golden_hashes() {
    std::map<std::string, std::string> hashes;
    std::ifstream file(folder / "hashes.txt");
    for (std::string name, state, results; file >> name >> state >> results;) hashes[name] = state + " " + results;
    return hashes;
}

}  // namespace

TEST_CASE("small scenes leave the bits of hashes.txt") {
    std::map<std::string, std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "scenes"))
        if (entry.path().extension() == ".toml") {
            CAPTURE(entry.path());
            found[entry.path().stem()] = hashes_of(entry.path());
        }
    REQUIRE(found.size() >= 27);
    if (const char* path = std::getenv("GOLDEN_HASHES")) {
        std::ofstream file(path);
        for (const auto& [name, hashes] : found) file << fmt::format("{:26} {}\n", name, hashes);
        return;
    }
    const auto golden = golden_hashes();
    CHECK(found.size() == golden.size());
    for (const auto& [name, hashes] : found) {
        CAPTURE(name);
        const auto expected = golden.find(name);
        REQUIRE(expected != golden.end());
        CHECK(hashes == expected->second);
    }
}
