#include "jostle/error/nearest_word.hpp"

#include <algorithm>
#include <cstddef>

#include "jostle/error/one_line.hpp"

namespace jostle {

namespace {

std::string lower_case(std::string_view word) {
    std::string lower(word);
    for (char& letter : lower)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return lower;
}

/// Number of edits between two words, by rows of the usual table: row i holds the distances of a[0, i) to b[0, j).
std::size_t edit_distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> before_last, last, row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        before_last = last;
        last = row;
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace

std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates) {
    constexpr std::size_t longest = 64;  // nothing that long is a misspelt word of ours
    if (word.size() > longest) return "";
    std::string nearest;
    std::size_t least = longest;
    for (const std::string& candidate : candidates) {
        const std::size_t distance = edit_distance(lower_case(word), lower_case(candidate));
        const std::size_t near = std::max<std::size_t>(1, std::max(word.size(), candidate.size()) / 3);
        if (distance > near || distance >= least) continue;
        least = distance;
        nearest = candidate;
    }
    return nearest;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
    const std::string nearest = nearest_word(word, candidates);
    return nearest.empty() ? "" : "Did you mean \"" + nearest + "\"?";
}

std::string quoted_list(const std::vector<std::string>& words) {
    constexpr std::size_t most = 40;
    std::string list;
    for (std::size_t k = 0; k < std::min(words.size(), most); ++k)
        list += (k == 0 ? "\"" : ", \"") + on_one_line(words[k]) + "\"";
    if (words.size() > most) list += " and " + std::to_string(words.size() - most) + " more";
    return list;
}

}  // namespace jostle
