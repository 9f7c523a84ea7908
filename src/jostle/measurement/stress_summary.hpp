#pragma once

#include <nlohmann/json.hpp>

#include "jostle/measurement/summarised_run.hpp"

namespace jostle {

/// Z, pressures, the whole stress and its parts.
void add_stresses(const SummarisedRun& run, nlohmann::ordered_json& summary);

/// Eigenvalues of the mean stress, the other conventions of the collision stress, if asked for, nematic order and
/// anisotropy.
void add_principal_stresses(const SummarisedRun& run, nlohmann::ordered_json& summary);

}  // namespace jostle
