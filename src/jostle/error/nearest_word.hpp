#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace jostle {

/// The candidate nearest to a misspelt word, or "" if none is near: what "did you mean" asks.
///
/// Near means that at most a third of the letters (at least one) are inserted, left out, replaced or swapped with their
/// neighbour (Damerau 1964, optimal string alignment); upper and lower case count as the same letter.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

/// `Did you mean "X"?` with the nearest candidate, or "" if none is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

/// The words in quotes, parted by commas, each on_one_line; of more than forty, how many more there are.
std::string quoted_list(const std::vector<std::string>& words);

}  // namespace jostle
