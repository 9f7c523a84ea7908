#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

// Lines of CSV, whoever wrote them.

namespace jostle {

/// Without blanks at both ends.
inline std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The next line of `rest`, trimmed; `rest` is what follows it.
inline std::string_view next_line(std::string_view& rest) {
    const auto end = rest.find('\n');
    const std::string_view line = trimmed(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end + 1);
    return line;
}

/// Cells between commas, trimmed, and without the quotes that may stand around them. `cells` is filled anew.
inline void split_cells(std::string_view line, std::vector<std::string_view>& cells) {
    const auto unquoted = [](std::string_view text) {
        const bool quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
        return quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
    };
    cells.clear();
    for (std::size_t begin = 0;;) {
        const auto end = line.find(',', begin);
        cells.push_back(unquoted(trimmed(line.substr(begin, end - begin))));
        if (end == std::string_view::npos) return;
        begin = end + 1;
    }
}

/// A header as NumPy's savetxt writes it, "# x,y,z", without its sign.
inline std::string_view without_sign(std::string_view header) {
    return header.starts_with('#') ? trimmed(header.substr(1)) : header;
}

/// The finite number that a cell holds, and nothing else.
inline std::optional<double> number_of_cell(std::string_view cell) {
    const std::string_view digits = cell.size() > 1 && cell.front() == '+' ? cell.substr(1) : cell;
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace jostle
