#pragma once

#include <nlohmann/json.hpp>
#include <string>

/// A JSON object as the text of a file, with "checksum" as its last entry: the XXH3 checksum of the text without it, as
/// 16 hexadecimal digits. Bytes that are no UTF-8 become signs that say so.
std::string sealed_json(nlohmann::ordered_json object);

/// Whether a text is, byte for byte, what sealed_json made of some object.
bool is_sealed_json(const std::string& text);
