#pragma once

#include <optional>
#include <string>

/// Seconds of a time as people and batch programs write it: "H:MM", "H:MM:SS", "D-HH", "D-HH:MM", "D-HH:MM:SS", or
/// numbers with units d, h, min or m, s, as "24h", "1h30min", "1.5 h". An empty optional if the text is no such time.
std::optional<double> seconds_of(const std::string& text);
