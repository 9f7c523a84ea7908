#pragma once

#include <cmath>
#include <random>
#include <vector>

namespace jostle::test {

/// A stationary first-order autoregressive series x_(t+1) = phi x_t + sqrt(1 - phi^2) noise: mean 0, variance 1, C(k) =
/// phi^k, integrated correlation time (1 + phi)/(2 (1 - phi)) rows. phi = 0 is white noise.
inline std::vector<double> autoregressive(std::mt19937_64& generator, std::size_t rows, double phi) {
    std::normal_distribution<double> normal;
    std::vector<double> series(rows);
    double value = normal(generator);
    for (double& row : series) {
        row = value;
        value = phi * value + std::sqrt(1.0 - phi * phi) * normal(generator);
    }
    return series;
}

/// A stationary second-order autoregressive series x_(t+2) = a x_(t+1) + b x_t + noise, of mean 0.
inline std::vector<double> autoregressive_2(std::mt19937_64& generator, std::size_t rows, double a, double b) {
    std::normal_distribution<double> normal;
    std::vector<double> series(rows);
    double last = 0.0, before = 0.0;
    for (std::size_t k = 0; k < rows + 500; ++k) {  // 500 rows to forget the start
        const double value = a * last + b * before + normal(generator);
        before = last;
        last = value;
        if (k >= 500) series[k - 500] = value;
    }
    return series;
}

/// `fast` plus `share` times a series of unit variance and correlation time `time`, in rows.
inline std::vector<double> with_slow_mode(std::mt19937_64& generator, std::vector<double> fast, double share,
                                          double time) {
    const std::vector<double> slow = autoregressive(generator, fast.size(), std::exp(-1.0 / time));
    for (std::size_t k = 0; k < fast.size(); ++k) fast[k] += share * slow[k];
    return fast;
}

/// Exact standard error of the mean of such a series.
inline double exact_standard_error(std::size_t rows, double phi) {
    double sum = 1.0, correlation = 1.0;
    for (std::size_t lag = 1; lag < rows; ++lag) {
        correlation *= phi;
        sum += 2.0 * (1.0 - static_cast<double>(lag) / static_cast<double>(rows)) * correlation;
    }
    return std::sqrt(sum / static_cast<double>(rows));
}

}  // namespace jostle::test
