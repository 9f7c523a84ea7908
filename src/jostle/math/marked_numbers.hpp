#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace jostle {

namespace eight_marks {

/// Of eight marks, as the bits of a number: the places of those that are set come first, and how many there are.
struct SetPlaces {
    std::array<std::array<std::uint8_t, 8>, 256> places{};
    std::array<std::uint8_t, 256> count{};
};

constexpr SetPlaces list_set_places() {
    SetPlaces all;
    for (std::size_t bits = 0; bits < 256; ++bits)
        for (std::uint8_t place = 0; place < 8; ++place)
            if ((bits >> place & 1U) != 0) all.places[bits][all.count[bits]++] = place;
    return all;
}
inline constexpr SetPlaces set_places = list_set_places();

/// Eight bytes of 0 or 1 as bits, the first one lowest.
inline std::size_t as_bits(const std::uint8_t* eight) {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, eight, sizeof bytes);
    return bytes * 0x0102'0408'1020'4080U >> 56U;  // byte k is moved to bit 56 + k; no two products meet
}

}  // namespace eight_marks

/// Marks, 0 or 1, of up to `size`, and the numbers of those that are set.
template <std::size_t size>
class MarkedNumbers {
public:
    std::uint8_t* marks() { return marks_.data(); }

    /// The numbers k < count with marks()[k] = 1, ascending. Eight at a time and without a jump, which processors would
    /// guess badly. Marks from `count` on may be overwritten.
    std::span<const std::uint16_t> find(std::size_t count) {
        std::fill(marks() + count, marks() + (count + 7) / 8 * 8, std::uint8_t{0});
        std::size_t found = 0;
        for (std::size_t first = 0; first < count; first += 8) {
            const std::size_t bits = eight_marks::as_bits(marks() + first);
            const auto& places = eight_marks::set_places.places[bits];
            for (std::size_t n = 0; n < 8; ++n) numbers_[found + n] = static_cast<std::uint16_t>(first + places[n]);
            found += eight_marks::set_places.count[bits];
        }
        return std::span(numbers_).first(found);
    }

private:
    static_assert(size % 8 == 0 && size <= 65536);
    std::array<std::uint8_t, size> marks_;
    std::array<std::uint16_t, size + 8> numbers_;  // eight are written where up to eight are found
};

}  // namespace jostle
