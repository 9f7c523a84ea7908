#include "summary_text.hpp"

#include <fmt/format.h>

using Json = nlohmann::ordered_json;

std::string summary_text(const Json& summary) {
    std::string text;
    const auto line = [&](const Json& entry, const char* name) {
        if (entry.is_null()) return;
        const std::string unit = entry.value("unit", "");
        const std::string mean =
            entry["mean"].is_null() ? "not defined" : fmt::format("{:.5g}", entry["mean"].get<double>());
        if (entry["standard_error"].is_null())
            text += fmt::format("{:20} = {} {} (no error bar: {})\n", name, mean, unit,
                                entry.value("no_standard_error_because", "not defined"));
        else
            text += fmt::format("{:20} = {} +- {:.2g} {} (n_eff {:.0f})\n", name, mean,
                                entry["standard_error"].get<double>(), unit, entry["n_eff"].get<double>());
    };
    const auto entry = [&](const char* key) { return summary.value(key, Json()); };
    line(entry("Z"), "Z");
    line(entry("pressure"), "pressure");
    line(entry("pressure_collision"), "collision pressure");
    line(entry("pressure_springs"), "pressure of springs");
    line(entry("pressure_active"), "active pressure");
    line(entry("nematic_order"), "nematic order S");
    line(entry("anisotropy"), "stress anisotropy");
    if (summary["oracles"].contains("anisotropy")) {
        line(summary["oracles"]["anisotropy"]["measured"], "  along over across");
        line(summary["oracles"]["anisotropy"]["predicted"], "  as equilibrium has");
    }
    text +=
        fmt::format("{:20} = {:.4g}{}\n", "equilibration time", summary["equilibration_time"].get<double>(),
                    summary["equilibrated"].get<bool>() ? "" : "   WARNING: equilibrium was not reached; run longer");
    text += fmt::format("{:20} = {:.2e} D\n", "largest overlap", summary["max_overlap"].get<double>());
    if (summary["oracles"].contains("anisotropy")) {
        const Json& oracle = summary["oracles"]["anisotropy"];
        if (oracle["agree"] == Json(false))
            text += fmt::format(
                "WARNING: the stress anisotropy differs from that of equilibrium by {:.3g} +- {:.2g}: the run may be "
                "too short, its steps too long, or the box a bad fit to layers of rods\n",
                oracle["difference"].get<double>(), oracle["standard_error"].get<double>());
    }
    return text;
}
