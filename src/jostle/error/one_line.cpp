#include "jostle/error/one_line.hpp"

#include <array>
#include <cstdint>

namespace jostle {

namespace {

struct Character {
    std::size_t bytes = 1;
    std::uint32_t code = 0;
    bool is_sound = false;  ///< of UTF-8, in its shortest form
};

/// The first character of a text that is not empty (RFC 3629).
Character first_of(std::string_view text) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    Character character{1, byte(0), byte(0) < 0x80};
    if (byte(0) < 0xc2 || byte(0) > 0xf4) return character;
    const std::size_t bytes = byte(0) < 0xe0 ? 2 : byte(0) < 0xf0 ? 3 : 4;
    if (text.size() < bytes) return character;
    std::uint32_t code = byte(0) & (0xffu >> (bytes + 1));
    for (std::size_t k = 1; k < bytes; ++k) {
        if ((byte(k) & 0xc0) != 0x80) return character;
        code = code << 6 | (byte(k) & 0x3fu);
    }
    constexpr std::array<std::uint32_t, 5> least = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < least[bytes] || code > 0x10ffff || surrogate) return character;
    return {bytes, code, true};
}

bool may_be_shown(std::uint32_t code) {
    const bool control = code < 0x20 || (code >= 0x7f && code < 0xa0);
    const bool ends_line = code == 0x2028 || code == 0x2029;
    const bool turns = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
    return !control && !ends_line && !turns;
}

std::string escaped(const Character& character) {
    if (character.code == '\n') return "\\n";
    if (character.code == '\r') return "\\r";
    if (character.code == '\t') return "\\t";
    std::string text = character.bytes > 1 ? "\\u" : "\\x";
    for (int shift = character.bytes > 1 ? 12 : 4; shift >= 0; shift -= 4)
        text += "0123456789abcdef"[character.code >> shift & 0xf];
    return text;
}

}  // namespace

std::string on_one_line(std::string_view text, std::size_t longest) {
    std::string line;
    while (!text.empty()) {
        const Character character = first_of(text);
        const bool as_it_is = character.is_sound && may_be_shown(character.code);
        const std::string shown = as_it_is ? std::string(text.substr(0, character.bytes)) : escaped(character);
        if (line.size() + shown.size() > longest) return line + "...";
        line += shown;
        text.remove_prefix(character.bytes);
    }
    return line;
}

}  // namespace jostle
