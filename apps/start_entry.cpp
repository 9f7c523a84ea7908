#include "start_entry.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "jostle/scene/scene_keys.hpp"
#include "jostle/setup/start.hpp"

using namespace jostle;
using Json = nlohmann::ordered_json;

namespace {

std::string in_words(const Annealing& annealing) {
    if (!annealing.was_needed()) return "random, each rod drawn anew until it overlapped no other";
    const std::string sweeps =
        annealing.sweeps > 0 ? fmt::format("{} Monte Carlo sweeps of rods that may overlap and ", annealing.sweeps)
                             : "";
    const std::string state = fmt::format("Z = {:.3g} and S = {:.2g}", annealing.Z, annealing.order);
    return fmt::format("random, annealed by {}{} large Brownian steps: {}{}", sweeps, annealing.steps, state,
                       annealing.settled ? ", without a drift over the last half of the steps"
                                         : ", still drifting at the limit of steps: equilibrium may be far");
}

std::string kind_of(StartKind kind) {
    const auto all = words(kind);
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& word) { return word.second == kind; });
    return std::string(found->first);
}

}  // namespace

Json start_entry(const Scene& scene, const Beginning& beginning) {
    Json entry = {{"kind", kind_of(scene.rods.start)}};
    if (scene.rods.start == StartKind::random) {
        const Annealing& annealing = beginning.annealing;
        entry["in_words"] = in_words(annealing);
        entry["annealed"] = annealing.was_needed();
        if (annealing.was_needed()) {
            entry["sweeps"] = annealing.sweeps;
            entry["steps"] = annealing.steps;
            entry["settled"] = annealing.settled;
            entry["Z"] = annealing.Z;
            entry["nematic_order"] = annealing.order;
        }
    }
    if (const std::string warning = start_warning(
            scene, total_volume(beginning.state.rods, beginning.state.box.dimensions()) / beginning.state.box.volume());
        !warning.empty())
        entry["warning"] = warning;
    return entry;
}

std::string start_text(const Json& entry, double seconds) {
    std::string text;
    if (entry.value("annealed", false))
        text = fmt::format("jostle: start in {:.1f} s: {}\n", seconds, entry["in_words"].get<std::string>());
    if (entry.contains("warning")) text += fmt::format("jostle: WARNING: {}\n", entry["warning"].get<std::string>());
    return text;
}
