#pragma once

#include <nlohmann/json.hpp>

#include "jostle/io/series_file.hpp"
#include "jostle/math/mat3.hpp"
#include "jostle/rods/rods.hpp"
#include "summary_entries.hpp"

/// A stress tensor of nine means, by rows.
jostle::Mat3 stress_of(std::span<const double> means);

struct MeanDirector {
    jostle::Vec3 direction;  ///< which end of it is the head is arbitrary
    double order;            ///< S of the mean order tensor
};

/// Largest eigenvalue of the mean order tensor, and its eigenvector. `order`: the six columns of the order tensor.
MeanDirector mean_director(const Columns& order);

/// The collision stress along the mean director over that across it, measured, and as in equilibrium it follows from Z
/// and the order tensor alone (theory, eq. 1.8). `stress`: the nine columns of the collision stress from row `first`.
nlohmann::ordered_json anisotropy_oracle(const jostle::SeriesTable& series, std::size_t first, const jostle::Rods& rods,
                                         const Columns& stress);
