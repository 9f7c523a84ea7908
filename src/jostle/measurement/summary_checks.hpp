#pragma once

#include <nlohmann/json.hpp>

#include "jostle/measurement/summarised_run.hpp"

namespace jostle {

/// What a run measures twice, or theory says: each is an entry of "checks" in summary.json.
nlohmann::ordered_json summary_checks(const SummarisedRun& run);

}  // namespace jostle
