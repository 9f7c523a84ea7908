#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "jostle/measurement/summarised_run.hpp"

namespace jostle {

/// Of a box under pressure: mean volume fraction and volume, the edges, and where the bath moves all of the box, Z = P
/// V/(N kT) and the compressibility. Without thermal motion what the last row has.
nlohmann::ordered_json pressure_control_entry(const SummarisedRun& run);

/// The measured pressure over that of the bath.
nlohmann::ordered_json bath_pressure_check(const SummarisedRun& run);

}  // namespace jostle
