#include "jostle/error/input_error.hpp"

namespace jostle {

std::string InputError::message(const Parts& parts) {
    std::string text;
    if (!parts.place.file.empty()) {
        text += parts.place.file;
        if (parts.place.line > 0) text += ":" + std::to_string(parts.place.line);
        if (parts.place.line > 0 && parts.place.column > 0) text += ":" + std::to_string(parts.place.column);
        text += ": ";
    }
    if (!parts.key.empty()) {
        text += parts.key;
        if (!parts.value.empty()) text += " = " + parts.value;
        text += ": ";
    } else if (!parts.value.empty()) {
        text += parts.value + ": ";
    }
    text += parts.problem;
    if (!parts.allowed.empty()) text += " (allowed: " + parts.allowed + ")";
    if (!parts.suggestion.empty()) text += ". " + parts.suggestion;
    return text;
}

}  // namespace jostle
