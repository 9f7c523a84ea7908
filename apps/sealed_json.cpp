#include "sealed_json.hpp"

#include <fmt/format.h>

#include "jostle/disk/checksum.hpp"
#include "parsed_json.hpp"

using Json = nlohmann::ordered_json;

std::string sealed_json(Json object) {
    const auto text = [&] { return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; };
    object["checksum"] = fmt::format("{:016x}", jostle::checksum(text()));
    return text();
}

bool is_sealed_json(const std::string& text) {
    Json object = parsed_json(text);
    return object.is_object() && object.erase("checksum") == 1 && sealed_json(object) == text;
}
