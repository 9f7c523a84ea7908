#include "post_mortem.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "jostle/disk/durable_file.hpp"
#include "jostle/scene/scene_box.hpp"
#include "jostle/scene/scene_motion.hpp"
#include "sealed_json.hpp"

using namespace jostle;
using Json = nlohmann::ordered_json;

namespace {

constexpr std::size_t contacts_told = 10;

/// The contacts for which `rank` is largest.
template <class Rank>
Json worst_contacts(const Simulation& simulation, Rank&& rank) {
    const Contacts& contacts = simulation.contacts();
    const auto& gamma = simulation.contact_solution().gamma;
    std::vector<std::size_t> order(contacts.size());
    for (std::size_t l = 0; l < order.size(); ++l) order[l] = l;
    const std::size_t count = std::min(contacts_told, order.size());
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end(),
                      [&](std::size_t a, std::size_t b) { return rank(a) > rank(b); });
    Json list = Json::array();
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t l = order[k];
        const Contact& contact = contacts.contact[l];
        list.push_back({{"id_i", id_of_body(contact.i, simulation.contact_ids())},
                        {"id_j", simulation.contact_ids()[contact.j]},
                        {"image", contacts.image[l]},
                        {"gap", contact.gap},
                        {"force", l < gamma.size() ? gamma[l] : 0.0}});
    }
    return list;
}

}  // namespace

std::string advice(const StepReport& report, const Scene& scene, const Simulation& simulation) {
    if (report.lacking_edge > 0.0) return "";
    const double filled = total_volume(simulation.rods(), simulation.box().dimensions()) / simulation.box().volume();
    if (grows(scene) && simulation.box().is_periodic() && filled > crowded(dimensions_of(scene)))
        return fmt::format(
            "  cells fill {:.0f} % of the box: end the run earlier, or give them a larger box or a "
            "growth.stall_force\n",
            100.0 * filled);
    const std::string shorter = scene.time.rms_step ? "time.rms_step" : "time.step";
    if (scene.contact.model == ContactModel::wca)
        return "  try a smaller " + shorter +
               ", by which rods that meet are thrown less far; if they still push through the potential, a larger "
               "contact.energy, which takes a smaller step yet\n";
    switch (report.status) {
        case LcpStatus::iteration_limit:
            return "  try a smaller " + shorter + ", or a larger solver.max_iterations or tolerance\n" +
                   (grows(scene) ? "  long files of cells that push each other need solver.method = \"apgd\" and "
                                   "solver.tolerance = 1e-3\n"
                                 : "");
        case LcpStatus::infeasible:
            return fmt::format("  use a lower {}; this one cannot be reached with this start\n", fraction_words(scene));
        case LcpStatus::not_finite:
            return "  try a much smaller " + shorter + "\n";
        case LcpStatus::converged:
        case LcpStatus::interrupted:
            return "  try a smaller " + shorter + "\n";
    }
    return "";
}

void write_post_mortem(const std::string& path, const Simulation& simulation, const StepReport& report,
                       const std::string& failure) {
    const auto& contacts = simulation.contacts().contact;
    const auto& gamma = simulation.contact_solution().gamma;
    const int dimensions = simulation.box().dimensions();
    const Json record = {
        {"failure", failure},
        {"step", report.step},
        {"time", report.time},
        {"time_step", simulation.settings().time_step},
        {dimensions == 2 ? "area_fraction" : "volume_fraction",
         total_volume(simulation.rods(), dimensions) / simulation.box().volume()},
        {"residual", report.residual},
        {"tolerance", simulation.settings().lcp.tolerance},
        {"iterations", report.iterations},
        {"max_iterations", simulation.settings().lcp.max_iterations},
        {"contacts", report.contacts},
        {"max_overlap", report.max_overlap},
        {"deepest_contacts", worst_contacts(simulation, [&](std::size_t l) { return -contacts[l].gap; })},
        {"strongest_contacts",
         worst_contacts(simulation, [&](std::size_t l) { return l < gamma.size() ? gamma[l] : 0.0; })}};
    replace_file(path, sealed_json(record));
}
