#pragma once

#include <cmath>
#include <vector>

namespace jostle::test {

/// Mean and standard error of independent numbers.
struct Sample {
    double mean = 0.0, error = 0.0;
    explicit Sample(const std::vector<double>& values) {
        const auto count = static_cast<double>(values.size());
        for (const double value : values) mean += value / count;
        double squares = 0.0;
        for (const double value : values) squares += (value - mean) * (value - mean);
        error = std::sqrt(squares / (count * (count - 1.0)));
    }
    /// Within four standard errors: false alarm 6e-5.
    bool agrees_with(double exact) const { return std::fabs(mean - exact) < 4.0 * error; }
};

}  // namespace jostle::test
