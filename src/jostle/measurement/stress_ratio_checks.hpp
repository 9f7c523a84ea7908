#pragma once

#include <nlohmann/json.hpp>

#include "jostle/math/mat3.hpp"
#include "jostle/measurement/summary_entries.hpp"
#include "jostle/rods/rods.hpp"
#include "jostle/run_files/series_file.hpp"

namespace jostle {

struct MeanDirector {
    Vec3 direction;  ///< which end of it is the head is arbitrary
    double order;    ///< S of the mean order tensor
};

/// Largest eigenvalue of the mean order tensor, and its eigenvector. `order`: the six columns of the order tensor.
MeanDirector mean_director(const Columns& order);

/// A ratio beside what it is in equilibrium, 1.
nlohmann::ordered_json check_of_one(const std::string& definition, const Estimate& measured);

/// The whole stress along the mean director over that across it, and what equilibrium has: 1 (theory, eq. 1.21).
/// `stress`, `order`: columns of the whole stress and of the order tensor. In two dimensions both lie in the plane
/// (theory, eq. 9.5).
nlohmann::ordered_json total_stress_ratio_check(const Columns& stress, const Columns& order, int dimensions);

/// The same of the collision stress, and as in equilibrium it follows from Z and the order tensor alone (theory, eq.
/// 1.8), of equal rods of the aspect ratio L/D. `Z`: its column.
nlohmann::ordered_json collision_stress_ratio_check(const Columns& stress, const Columns& order,
                                                    const std::vector<double>& Z, double aspect_ratio, int dimensions);

}  // namespace jostle
