#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "jostle/parallel/parallel_for.hpp"
#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// The sum of term(k) over [0, count) of all ranks together: exact and rounded once, so that it has the same bits
/// however many ranks there are, and whichever has a term. T as that of `parallel_sum`.
template <class T, class Term>
T sum_over_ranks(const Ranks& ranks, std::size_t count, Term&& term) {
    UnroundedSum<T> total = unrounded_sum<T>(count, term);
    if (ranks.alone()) return rounded_sum<T>(total);
    if constexpr (std::is_integral_v<T>) {
        return static_cast<T>(ranks.sum(static_cast<std::int64_t>(total[0])));
    } else {
        constexpr std::size_t words = ExactSum::words;
        std::array<std::int64_t, numbers_in<T> * words> numbers;
        for (std::size_t n = 0; n < total.size(); ++n) {
            const auto of_sum = total[n].in_words();
            std::copy(of_sum.begin(), of_sum.end(), numbers.begin() + static_cast<std::ptrdiff_t>(n * words));
        }
        ranks.add_up(numbers);
        for (std::size_t n = 0; n < total.size(); ++n)
            total[n] = ExactSum::of_words(std::span(numbers).subspan(n * words).template first<words>());
        return rounded_sum<T>(total);
    }
}

}  // namespace jostle
