#include "jostle/scene/validate_fluid.hpp"

#include <fmt/core.h>

#include "jostle/error/refuse.hpp"
#include "jostle/hydrodynamics/hydrodynamic_mobility.hpp"
#include "jostle/hydrodynamics/rod_blobs.hpp"
#include "jostle/scene/key_values.hpp"
#include "jostle/scene/mistakes.hpp"
#include "jostle/scene/number_text.hpp"
#include "jostle/scene/rod_size.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "jostle/scene/schedule.hpp"

namespace jostle {

namespace {

constexpr const char* with_fluid = "with mobility.model = \"hydrodynamic\"";
constexpr const char* without_fluid = "Use mobility.model = \"capsule\"";
/// In diameters: what pairs of rods within a larger cutoff cost is never worth it.
constexpr double least_cutoff = 1.0, largest_cutoff = 20.0;
/// In diameters: rounding of flows to floats, 1e-7 of what rods move in a step, leaves nothing finer.
constexpr double finest_overlap = 1e-8;

void check_sizes(const Scene& scene) {
    if (scene.rods.diameter_deviation > 0.0)
        refuse("rods.diameter_deviation", text(scene.rods.diameter_deviation),
               fmt::format("{} all rods have one diameter", with_fluid), "0", without_fluid);
    if (rods_are_given(scene)) return;
    const double aspect_ratio = largest_length(scene) / scene.rods.diameter;
    if (aspect_ratio > longest_line_of_blobs)
        refuse("rods.length", text(scene.rods.length),
               fmt::format("{} rods of L/D = {} are not known", with_fluid, rounded(aspect_ratio)),
               fmt::format("L/D at most {}", longest_line_of_blobs), without_fluid);
}

void check_box_of_fluid(const Scene& scene) {
    if (dimensions_of(scene) == 2) return;  // refused anyhow
    const auto [x, y, z] = scene.box.periodic;
    if (x != y || y != z)
        refuse(
            "box.periodic", fmt::format("[{}, {}, {}]", x, y, z),
            fmt::format("{} flows are known in a box that is periodic along all directions, or along none", with_fluid),
            "all true, or all false", "");
    if (!x && scene.rods.count > max_rods_in_open_box)
        refuse("rods.count", fmt::format("{}", scene.rods.count),
               fmt::format("{} every pair of rods is summed in an open box", with_fluid),
               fmt::format("at most {}", max_rods_in_open_box), "Make the box periodic");
    const std::optional<double>& cutoff = scene.mobility.cutoff;
    const double diameter = scene.rods.diameter;
    if (cutoff && !(*cutoff >= least_cutoff * diameter && *cutoff <= largest_cutoff * diameter))
        refuse("mobility.cutoff", text(*cutoff), "is no reasonable range of sums in real space",
               fmt::format("{} to {}", rounded(least_cutoff * diameter), rounded(largest_cutoff * diameter)),
               "Use \"auto\"");
}

void check_overlap_left(const Scene& scene) {
    const Scene::Solver& solver = scene.solver;
    if (solver.residual == ResidualKind::length && solver.tolerance < finest_overlap)
        refuse("solver.tolerance", text(solver.tolerance),
               fmt::format("{} flows are rounded more coarsely", with_fluid),
               fmt::format("at least {}", finest_overlap), "1e-4 is enough");
}

void check_motions(const Scene& scene) {
    if (has_schedule(scene))
        refuse(names_of_schedule(scene), "",
               fmt::format(
                   "{} the fluid would have to flow with a box that is squeezed, and other ramps have not been tried",
                   with_fluid),
               "no [schedule]", without_fluid);
    if (grows(scene))
        refuse("growth.rate", text(scene.growth.rate),
               fmt::format("{} what grows drives the fluid away, and this flow is not known", with_fluid), "0",
               without_fluid);
    if (!scene.springs.file.empty())
        refuse("springs.file", scene.springs.file,
               fmt::format("{} rods that move together are moved more easily than each alone, and how short a "
                           "step springs need then is not known",
                           with_fluid),
               "no springs", without_fluid);
    if (scene.contact.model == ContactModel::wca)
        refuse("contact.model", "\"wca\"", fmt::format("{} soft rods have not been tried", with_fluid), "\"hard\"",
               without_fluid);
    if (scene.solver.method == SolverMethod::projected_sor)
        refuse("solver.method", "\"projected_sor\"",
               fmt::format("{} every rod moves every other, and this method moves two at a time", with_fluid),
               "\"auto\", \"adaptive_bb\", \"bbpgd\", \"apgd\" or \"minimum_map_newton\"", "Use \"auto\"");
}

}  // namespace

void validate_fluid(const Scene& scene) {
    if (scene.mobility.model != MobilityModel::hydrodynamic) return;
    Mistakes mistakes;
    for (const auto check : {check_sizes, check_box_of_fluid, check_overlap_left, check_motions})
        mistakes.look([&] { check(scene); });
    mistakes.refuse_any();
}

}  // namespace jostle
