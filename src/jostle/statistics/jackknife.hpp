#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jostle {

/// A number found from averages, and how well it is known.
struct Estimate {
    double value = 0.0;
    std::optional<double> standard_error;  ///< empty where it cannot be given
    double effective_samples = 0.0;        ///< at most the number of blocks, 2047
    std::string no_error_reason;           ///< one sentence where standard_error is empty
};

/// Value and standard error of a function of the means of several series, such as an eigenvalue ratio of a mean tensor.
///
/// The rows are averaged to m <= 2047 blocks; leaving out block k gives the pseudo-value p_k = m f - (m - 1) f_k
/// (Quenouille, Tukey; Efron & Stein, Ann. Stat. 9, 586 (1981)). Departure: blocks are not made long enough to be
/// independent; the p_k are treated as any other time series, whose `average` corrects for what correlation is left and
/// refuses what it must. `value` is f of the plain means over all rows, not corrected for bias. `columns` (quantities,
/// rows): all of one length. `function`: means (quantities) -> number. Throws InputError if there is no column, or
/// lengths differ.
Estimate jackknife(std::span<const std::vector<double>> columns,
                   const std::function<double(std::span<const double>)>& function);

}  // namespace jostle
