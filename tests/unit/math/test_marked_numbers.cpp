#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

#include "jostle/math/marked_numbers.hpp"

using namespace jostle;

namespace {

constexpr std::size_t room_for = 64;

std::vector<std::uint16_t> found(const std::vector<std::uint8_t>& marked) {
    MarkedNumbers<room_for> numbers;
    std::fill(numbers.marks(), numbers.marks() + room_for, std::uint8_t{1});  // what follows the marks does not count
    std::copy(marked.begin(), marked.end(), numbers.marks());
    const auto all = numbers.find(marked.size());
    return {all.begin(), all.end()};
}

}  // namespace

TEST_CASE("numbers of marked ones are found in order, for any count and any marks") {
    for (std::uint64_t trial = 0; trial < 2000; ++trial) {
        std::vector<std::uint8_t> marked(trial % (room_for + 1));
        std::vector<std::uint16_t> expected;
        for (std::size_t k = 0; k < marked.size(); ++k) {
            const std::uint64_t often = 1 + trial % 7;
            marked[k] = (trial * 0x9E3779B97F4A7C15U >> (k % 61)) % often == 0 ? 1 : 0;
            if (marked[k] == 1) expected.push_back(static_cast<std::uint16_t>(k));
        }
        CAPTURE(trial);
        CHECK(found(marked) == expected);
    }
}

TEST_CASE("no marks and all marks") {
    CHECK(found({}).empty());
    CHECK(found(std::vector<std::uint8_t>(room_for, 0)).empty());
    CHECK(found(std::vector<std::uint8_t>(room_for, 1)).size() == room_for);
}
