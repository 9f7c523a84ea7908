#include "jostle/motion/motion.hpp"

#include <cassert>
#include <utility>

#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

std::optional<Forces> sum_of_forces(std::span<const std::unique_ptr<Motion>> motions, const Rods& rods,
                                    const StepContext& context) {
    std::optional<Forces> sum;
    for (const auto& motion : motions) {
        std::optional<Forces> own = motion->forces(rods, context);
        if (!own) continue;
        assert(own->size() == rods.size());
        if (!sum) {
            sum = std::move(own);
            continue;
        }
        parallel_for(rods.size(), [&](std::size_t i) {
            sum->force[i] += own->force[i];
            sum->torque[i] += own->torque[i];
        });
    }
    return sum;
}

AxialStresslets sum_of_stresslets(std::span<const std::unique_ptr<Motion>> motions, const Rods& rods,
                                  const StepContext& context) {
    AxialStresslets sum;
    for (const auto& motion : motions) {
        AxialStresslets own = motion->stresslets(rods, context);
        sum.kT += own.kT;
        if (own.dipole.empty()) continue;
        assert(own.dipole.size() == rods.size());
        if (sum.dipole.empty()) sum.dipole.resize(rods.size());
        for (std::size_t i = 0; i < rods.size(); ++i) sum.dipole[i] += own.dipole[i];
    }
    return sum;
}

}  // namespace jostle
