#pragma once

#include <cstdint>
#include <span>

namespace jostle {

// A side of a contact is a body: a rod, named by its row, or a body that contact forces do not move (a wall), named by
// its number. Rows are below 2^31 (scene key rods.count), numbers of fixed bodies above.

inline constexpr std::uint32_t first_fixed_body = 0x80000000;

constexpr bool is_fixed(std::uint32_t body) {
    return body >= first_fixed_body;
}
constexpr std::uint32_t fixed_body(std::uint32_t number) {
    return first_fixed_body + number;
}
constexpr std::uint32_t number_of_fixed(std::uint32_t body) {
    return body - first_fixed_body;
}

/// What a body is called wherever rows do not matter: a rod by its id, which is below 2^53, fixed bodies after all
/// rods.
inline std::uint64_t id_of_body(std::uint32_t body, std::span<const std::uint64_t> ids) {
    return is_fixed(body) ? 0xFFFFFFFF00000000 | body : ids[body];
}

constexpr bool is_id_of_fixed(std::uint64_t id) {
    return id >= (0xFFFFFFFF00000000 | first_fixed_body);
}

}  // namespace jostle
