#include "jostle/error/input_error.hpp"

#include <limits>

#include "jostle/error/one_line.hpp"

namespace jostle {

namespace {

constexpr std::size_t longest_value = 200;  // bytes; who quotes a cell or a word cuts it sooner

/// A sentence of ours, as long as it is. It may quote what others wrote.
std::string shown(std::string_view sentence) {
    return on_one_line(sentence, std::numeric_limits<std::size_t>::max());
}

/// A line for every problem (RowProblems).
std::string lines(std::string_view problems) {
    std::string text;
    for (std::size_t end = problems.find('\n'); end != std::string_view::npos; end = problems.find('\n')) {
        text += shown(problems.substr(0, end)) + '\n';
        problems.remove_prefix(end + 1);
    }
    return text + shown(problems);
}

}  // namespace

InputError InputError::with_place(const Place& place) const {
    Parts parts = parts_;
    parts.place = place;
    for (Parts& other : parts.others)
        if (other.place.file.empty()) other.place = place;
    return InputError(std::move(parts));
}

InputError InputError::with_others(const std::vector<InputError>& others) const {
    Parts parts = parts_;
    for (const InputError& other : others) parts.others.push_back(other.parts());
    return InputError(std::move(parts));
}

std::string InputError::message(const Parts& parts) {
    std::string text;
    if (!parts.place.file.empty()) {
        text += on_one_line(parts.place.file, longest_file_name);
        if (parts.place.line > 0) text += ":" + std::to_string(parts.place.line);
        if (parts.place.line > 0 && parts.place.column > 0) text += ":" + std::to_string(parts.place.column);
        text += ": ";
    }
    const std::string key = on_one_line(parts.key, longest_value), value = on_one_line(parts.value, longest_value);
    if (!key.empty()) {
        text += key;
        if (!value.empty()) text += " = " + value;
        text += ": ";
    } else if (!value.empty()) {
        text += value + ": ";
    }
    text += lines(parts.problem);
    if (!parts.allowed.empty()) text += " (allowed: " + shown(parts.allowed) + ")";
    if (!parts.suggestion.empty()) text += ". " + shown(parts.suggestion);
    for (const Parts& other : parts.others) text += "\n" + message(other);
    return text;
}

}  // namespace jostle
