#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace jostle {

inline constexpr std::size_t longest_quotation = 60;    ///< bytes of a cell, a name, a word
inline constexpr std::size_t longest_file_name = 4096;  ///< bytes, as long as the system's own limit

/// Text from outside, as a message may show it on one line of a terminal: control characters, line ends, marks that
/// turn the direction of writing, and bytes that are no UTF-8 become \n, \t, \r, \x1b or \u202e; what is longer than
/// `longest` bytes is cut between two characters and ends in "...".
std::string on_one_line(std::string_view text, std::size_t longest = longest_quotation);

}  // namespace jostle
