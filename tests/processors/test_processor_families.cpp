// The same bits from the instructions that the program chooses on this processor, AVX-512 where there are any, and from
// those for older ones (decision 0014).

#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

namespace {

struct Output {
    std::string text;
    int status = -1;
};

Output output_of(const std::string& program) {
    Output output;
    std::FILE* pipe = ::popen((std::string(JOSTLE_PROGRAMS) + "/" + program).c_str(), "r");
    REQUIRE(pipe != nullptr);
    std::array<char, 4096> block{};
    while (const std::size_t size = std::fread(block.data(), 1, block.size(), pipe))
        output.text.append(block.data(), size);
    output.status = ::pclose(pipe);
    return output;
}

}  // namespace

TEST_CASE("the instructions for older processors give the same bits") {
    const Output chosen = output_of("steps_of_this_processor");
    REQUIRE(chosen.status == 0);
    REQUIRE(chosen.text.size() > 300 * 2 * 40);  // a line of three numbers for the centre and the axis of each rod
    const auto same = [&](const char* program) {
        const Output output = output_of(program);
        CAPTURE(program);
        CHECK(output.status == 0);
        CHECK(output.text == chosen.text);
    };
    same("steps_sse2");
    if (__builtin_cpu_supports("avx2")) same("steps_avx2");
}
