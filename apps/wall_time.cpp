#include "wall_time.hpp"

#include <charconv>
#include <cmath>
#include <string_view>
#include <vector>

namespace {

constexpr double seconds_a_minute = 60.0, seconds_an_hour = 3600.0, seconds_a_day = 86400.0;
constexpr double longest = 1e9;  // seconds, some thirty years

std::optional<int> whole(std::string_view digits) {
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool sound = error == std::errc{} && end == digits.data() + digits.size() && digits.front() != '-';
    return sound && digits.size() <= 5 ? std::optional(value) : std::nullopt;
}

/// Of "H:MM" or "H:MM:SS"; with days before it "HH", "HH:MM" or "HH:MM:SS".
std::optional<double> of_clock(std::string_view text, bool with_days) {
    std::vector<int> parts;
    for (;;) {
        const std::size_t colon = text.find(':');
        const std::string_view digits = text.substr(0, colon);
        const auto value = digits.empty() ? std::nullopt : whole(digits);
        if (!value || (!parts.empty() && (*value > 59 || digits.size() > 2))) return std::nullopt;
        parts.push_back(*value);
        if (colon == std::string_view::npos) break;
        text.remove_prefix(colon + 1);
    }
    if (parts.size() > 3 || (parts.size() == 1 && !with_days) || (with_days && parts[0] > 23)) return std::nullopt;
    parts.resize(3);
    return seconds_an_hour * parts[0] + seconds_a_minute * parts[1] + parts[2];
}

std::optional<double> seconds_a_unit(std::string_view unit) {
    if (unit == "d" || unit == "day" || unit == "days") return seconds_a_day;
    if (unit == "h" || unit == "hour" || unit == "hours") return seconds_an_hour;
    if (unit == "min" || unit == "m" || unit == "minutes") return seconds_a_minute;
    if (unit == "s" || unit == "seconds") return 1.0;
    return std::nullopt;
}

/// Of "24h" or "1h 30min": units become smaller.
std::optional<double> of_units(std::string_view text) {
    double sum = 0.0, last = INFINITY;
    while (!text.empty()) {
        double value = 0.0;
        const auto [end, error] =
            std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
        if (error != std::errc{} || !(value >= 0.0) || text.front() == '-') return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (text.starts_with(' ')) text.remove_prefix(1);
        const std::string_view unit = text.substr(0, text.find_first_of(" 0123456789"));
        const auto seconds = seconds_a_unit(unit);
        if (!seconds || !(*seconds < last)) return std::nullopt;
        sum += value * *seconds;
        last = *seconds;
        text.remove_prefix(unit.size());
        if (text.size() > 1 && text.front() == ' ') text.remove_prefix(1);
    }
    return sum;
}

}  // namespace

std::optional<double> seconds_of(const std::string& text) {
    const std::size_t dash = text.find('-');
    std::optional<double> seconds;
    if (text.empty()) return std::nullopt;
    if (dash != std::string::npos) {
        const auto days = dash > 0 ? whole(std::string_view(text).substr(0, dash)) : std::nullopt;
        seconds = of_clock(std::string_view(text).substr(dash + 1), true);
        if (!days || !seconds) return std::nullopt;
        *seconds += seconds_a_day * *days;
    } else {
        seconds = text.find(':') != std::string::npos ? of_clock(text, false) : of_units(text);
    }
    return seconds && *seconds <= longest ? seconds : std::nullopt;
}
