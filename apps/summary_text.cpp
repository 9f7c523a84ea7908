#include "summary_text.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "jostle/scene/scene_walls.hpp"
#include "jostle/scene/units.hpp"

using Json = nlohmann::ordered_json;

namespace {

/// Checks of one ratio, by their keys, each with the name of its line.
struct Checks {
    const char *ratio, *before, *after;  ///< what the name stands between in a warning
    const char* where;
    std::vector<std::pair<const char*, const char*>> lines;
};
const Checks all_checks[] = {{"stress ratio along/across the director",
                              "the ",
                              " along/across the director",
                              "equilibrium",
                              {{"total_stress_ratio", "total stress"}, {"collision_stress_ratio", "collision stress"}}},
                             {"wall pressure over the total stress along the walls' normal",
                              "the pressure over the stress at the ",
                              "",
                              "equilibrium",
                              {{"wall_pressure_ratio", "container"},
                               {"wall_pressure_x_ratio", "planes across x"},
                               {"wall_pressure_y_ratio", "planes across y"},
                               {"wall_pressure_z_ratio", "planes across z"}}},
                             {"pressure of the rods over that of the bath",
                              "the ratio of pressures, ",
                              ",",
                              "equilibrium",
                              {{"bath_pressure_ratio", "rods over bath"}}},
                             {"stress of torques over what the flow turns the axes by",
                              "the ratio of stress and turning, ",
                              ",",
                              "a steady flow",
                              {{"torque_ratio", "element xy"}}}};

jostle::ReadableUnit unit_in(const Json& entry, const jostle::Scene& scene) {
    return jostle::readable_unit(scene, entry.value("unit", ""));
}

std::string mean_text(const Json& entry, const jostle::Scene& scene) {
    if (entry["mean"].is_null()) return "not defined";
    const auto [factor, unit] = unit_in(entry, scene);
    std::string text = fmt::format("{:.5g}", factor * entry["mean"].get<double>());
    if (!entry["standard_error"].is_null())
        text += fmt::format(" +- {:.2g}", factor * entry["standard_error"].get<double>());
    return unit.empty() ? text : text + " " + unit;
}

/// What the standard error rests on, or why there is none; `withheld`: from all, for one reason.
std::string support_text(const Json& entry, bool withheld) {
    if (withheld) return "(no error bar)";
    if (!entry["standard_error"].is_null()) return fmt::format("(n_eff {:.0f})", entry["n_eff"].get<double>());
    return fmt::format("(no error bar: {})", entry.value("no_standard_error_because", "not defined"));
}

std::string principal_text(const Json& principal, const jostle::Scene& scene) {
    const auto [factor, unit] = unit_in(principal, scene);
    std::string text;
    for (std::size_t k = 0; k < principal["mean"].size(); ++k) {
        text += fmt::format("{}{:.5g}", k > 0 ? ", " : "", factor * principal["mean"][k].get<double>());
        if (const Json& error = principal["standard_error"][k]; !error.is_null())
            text += fmt::format(" +- {:.2g}", factor * error.get<double>());
    }
    return text + " " + unit;
}

std::string line(const char* name, const std::string& value) {
    return fmt::format("{:20} = {}\n", name, value);
}

/// A number, or the two that it may lie between.
std::string range_text(const Json& range) {
    if (range["from"].is_null() || range["to"].is_null()) return "not defined";
    const std::string from = fmt::format("{:.5g}", range["from"].get<double>());
    const std::string to = fmt::format("{:.5g}", range["to"].get<double>());
    return from == to ? from : from + " to " + to;
}

std::string text_of_checks(const Checks& checks, const Json& of_summary, const jostle::Scene& scene, bool withheld) {
    std::string text;
    for (const auto& [key, name] : checks.lines) {
        if (!of_summary.contains(key)) continue;
        const Json& check = of_summary[key];
        const std::string verdict = check["agree"].is_null()     ? ""
                                    : check["agree"].get<bool>() ? ": agrees"
                                                                 : ": disagrees";
        text +=
            line(fmt::format("  {}", name).c_str(),
                 fmt::format("{}, in {} {}{}  {}", mean_text(check["measured"], scene), checks.where,
                             range_text(check["in_equilibrium"]), verdict, support_text(check["measured"], withheld)));
    }
    return text.empty() ? "" : fmt::format("{}, measured and in {}\n{}", checks.ratio, checks.where, text);
}

/// Also of a run that is not in equilibrium, but then without an error.
std::string warnings_of_checks(const Checks& checks, const Json& of_summary, bool withheld) {
    std::string text;
    for (const auto& [key, name] : checks.lines) {
        if (!of_summary.contains(key) || of_summary[key]["agree"] != Json(false)) continue;
        const std::string error =
            withheld ? "" : fmt::format(" +- {:.2g}", of_summary[key]["standard_error"].get<double>());
        text += fmt::format(
            "WARNING: {}{}{} differs from that of {} by {:.3g}{}: the run "
            "may be too short, its steps too long, or the box a bad fit to layers of rods, or no wider than a rod\n",
            checks.before, name, checks.after, checks.where, of_summary[key]["difference"].get<double>(), error);
    }
    return text;
}

/// What a flow tells of the rods.
std::string text_of_flow(const Json& flow, const jostle::Scene& scene, bool withheld) {
    constexpr std::pair<const char*, const char*> averages[] = {{"viscosity", "viscosity"},
                                                                {"viscosity_of_turning", "  of turning"},
                                                                {"N1", "N1"},
                                                                {"N2", "N2"},
                                                                {"storage_modulus", "storage modulus G'"},
                                                                {"loss_modulus", "loss modulus G''"}};
    std::string text;
    for (const auto& [key, name] : averages)
        if (flow.contains(key))
            text += line(name, mean_text(flow[key], scene) + "  " + support_text(flow[key], withheld));
    const char* main = flow.contains("viscosity") ? "viscosity" : "storage_modulus";
    return text + "  " + flow[main]["definition"].get<std::string>() + "\n";
}

/// Where the box came to rest, or not yet.
std::string text_of_compression(const Json& last) {
    const auto number = [&](const char* key, int digits) {
        return fmt::format("{:.{}g}", last[key].get<double>(), digits);
    };
    return line("volume fraction", number("volume_fraction", 5) + "  (in the end)") +
           line("pressure", number("pressure_over_external", 4) + " of that of the bath  (in the end)") +
           line("contacts", number("contacts_per_rod", 4) + " of a rod  (in the end)");
}

/// Forces that would move the box by more in a step bring it to its pressure, but not with the fluctuations it has
/// there.
std::string warning_of_held_back(const Json& control) {
    const double part = control.value("held_back", 0.0);
    if (part == 0.0) return "";
    return fmt::format(
        "WARNING: the box was held back in {:.2g} % of the steps of production, where forces would have "
        "moved it too far: lengthen pressure.relaxation_time, or shorten the steps\n",
        100.0 * part);
}

/// Between walls these are no pressures (theory, section 6).
bool is_third_of_trace(std::string_view key) {
    return key == "pressure" || key == "pressure_collision";
}

}  // namespace

std::string summary_text(const Json& summary, const jostle::Scene& scene) {
    constexpr std::pair<const char*, const char*> averages[] = {{"Z", "Z"},
                                                                {"wall_pressure", "wall pressure"},
                                                                {"wall_pressure_x", "wall pressure x"},
                                                                {"wall_pressure_y", "wall pressure y"},
                                                                {"wall_pressure_z", "wall pressure z"},
                                                                {"pressure", "pressure"},
                                                                {"pressure_collision", "collision pressure"},
                                                                {"pressure_springs", "pressure of springs"},
                                                                {"pressure_active", "active pressure"},
                                                                {"nematic_order", "nematic order S"},
                                                                {"anisotropy", "stress anisotropy"},
                                                                {"anisotropy_collision", "  of collisions"}};
    const Json& equilibrium = summary["equilibrium"];
    const bool withheld = equilibrium["verdict"] == "not reached" || equilibrium["verdict"] == "too short to tell";
    std::string text;
    const bool walls = jostle::scene_walls(scene).any();
    for (const auto& [key, name] : averages)
        if (summary.contains(key) && !(walls && is_third_of_trace(key)))
            text += line(name, mean_text(summary[key], scene) + "  " + support_text(summary[key], withheld));
    if (summary.contains("flow")) text += text_of_flow(summary["flow"], scene, withheld);
    if (summary.contains("viscosity_at_rest") && !summary["viscosity_at_rest"]["mean"].is_null()) {
        const Json& viscosity = summary["viscosity_at_rest"];
        text += line("viscosity at rest", mean_text(viscosity, scene) + "  " + support_text(viscosity, withheld));
    }
    if (summary.contains("pressure_control")) {
        const Json& control = summary["pressure_control"];
        for (const auto& [key, name] : {std::pair{"volume_fraction", "volume fraction"}, {"Z", "Z = P V/(N kT)"}})
            if (control.contains(key) && !control.contains("last"))
                text += line(name, mean_text(control[key], scene) + "  " + support_text(control[key], withheld));
        if (control.contains("last")) text += text_of_compression(control["last"]);
        if (control.value("limit_reached", false)) text += line("ended at", "pressure.limit_volume_fraction");
    }
    for (const Checks& checks : all_checks) text += text_of_checks(checks, summary["checks"], scene, withheld);
    text += line("principal stresses", principal_text(summary["principal_stresses"], scene) + "  (total)");
    text += line("principal stresses",
                 principal_text(summary["principal_stresses_collision"], scene) + "  (of collisions)");
    text += line("equilibration time", fmt::format("{:.4g}", summary["equilibration_time"].get<double>()));
    text += line("equilibrium", (withheld ? "WARNING: " : "") + equilibrium["in_words"].get<std::string>());
    text += line("largest overlap", fmt::format("{:.2e} D", summary["max_overlap"].get<double>()));
    for (const Checks& checks : all_checks) text += warnings_of_checks(checks, summary["checks"], withheld);
    if (summary.contains("pressure_control")) text += warning_of_held_back(summary["pressure_control"]);
    return text;
}
