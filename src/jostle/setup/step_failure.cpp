#include "jostle/setup/step_failure.hpp"

#include <fmt/format.h>

#include "jostle/scene/rod_size.hpp"

namespace jostle {

std::string description(LcpStatus status) {
    switch (status) {
        case LcpStatus::converged:
            return "converged";
        case LcpStatus::iteration_limit:
            return "the contact problem was not solved within solver.max_iterations";
        case LcpStatus::infeasible:
            return "the contact problem has no solution: the rods are packed too densely to be moved apart";
        case LcpStatus::not_finite:
            return "the contact problem holds numbers that are not finite";
        case LcpStatus::interrupted:
            return "it was interrupted before the contact problem was solved";
    }
    return "";
}

std::optional<std::string> step_failure(const StepReport& report, const Scene& scene, double thinnest) {
    if (report.lacking_edge > 0.0)
        return fmt::format(
            "an edge of the box has become {:.3g} shorter than rods need to turn between their own images{}",
            report.lacking_edge,
            scene.pressure.coupling == StrainCoupling::orthogonal
                ? ": edges of a fluid wander apart, and coupling = \"isotropic\" keeps their ratio"
                : "");
    if (report.status != LcpStatus::converged) return description(report.status);
    if (report.max_overlap == 0.0) return std::nullopt;
    const double limit = scene.contact.overlap_limit * thinnest;
    if (report.max_overlap > limit)
        return fmt::format("rods overlap by {:.3g}, more than contact.overlap_limit allows ({:.3g})",
                           report.max_overlap, limit);
    return std::nullopt;
}

std::optional<std::string> step_failure(const StepReport& report, const Scene& scene, const Rods& rods) {
    return step_failure(report, scene, smallest_diameter(scene, rods));
}

}  // namespace jostle
