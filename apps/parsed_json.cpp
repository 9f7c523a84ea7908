#include "parsed_json.hpp"

using Json = nlohmann::ordered_json;

Json parsed_json(const std::string& text) {
    constexpr int deepest = 8;
    const auto keep = [](int depth, Json::parse_event_t, const Json&) { return depth <= deepest; };
    return Json::parse(text, keep, false);
}
