#include <doctest/doctest.h>

#include <algorithm>

#include "jostle/error/input_error.hpp"
#include "jostle/error/one_line.hpp"

using namespace jostle;
using namespace std::string_literals;

TEST_CASE("what a terminal would obey is shown instead") {
    CHECK(on_one_line("") == "");
    CHECK(on_one_line("plain, \xc3\xa9 \xe2\x82\xac \xf0\x9d\x84\x9e \\") ==
          "plain, \xc3\xa9 \xe2\x82\xac \xf0\x9d\x84\x9e \\");
    CHECK(on_one_line("a\nb\tc\rd"s + '\0' + "e\x1b[31m\x7f") == "a\\nb\\tc\\rd\\x00e\\x1b[31m\\x7f");
    CHECK(on_one_line("\xc2\x9b") == "\\u009b");      // a control character of two bytes
    CHECK(on_one_line("\xe2\x80\xa8") == "\\u2028");  // ends a line
    CHECK(on_one_line("\xe2\x80\xae") == "\\u202e");  // turns the direction of writing
}

TEST_CASE("bytes that are no UTF-8 are shown by their numbers") {
    CHECK(on_one_line("caf\xe9") == "caf\\xe9");
    CHECK(on_one_line("\xe2\x82") == "\\xe2\\x82");                    // cut short
    CHECK(on_one_line("\xc0\xaf") == "\\xc0\\xaf");                    // longer than need be
    CHECK(on_one_line("\xe0\x80\xaf") == "\\xe0\\x80\\xaf");           // the same
    CHECK(on_one_line("\xed\xa0\x80") == "\\xed\\xa0\\x80");           // half of a pair of UTF-16
    CHECK(on_one_line("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");  // beyond the last character
}

TEST_CASE("a long text is cut between two characters") {
    CHECK(on_one_line("123456", 6) == "123456");
    CHECK(on_one_line("1234567", 6) == "123456...");
    CHECK(on_one_line("12345\xc3\xa9", 6) == "12345...");
    CHECK(on_one_line("12345\n", 6) == "12345...");
    CHECK(on_one_line(std::string(5000, 'x')).size() == longest_quotation + 3);
}

TEST_CASE("no part of a message reaches the terminal as it is") {
    const std::string hostile = "\x1b[2J\0\n\xff"s;
    const InputError error({hostile, hostile, hostile, hostile, hostile, {hostile, 3, 1}});
    const std::string shown = error.what();
    CHECK(shown.find_first_of("\x1b\xff\0"s) == std::string::npos);
    CHECK(std::count(shown.begin(), shown.end(), '\n') == 1);  // of the problem, which may have a line for each row
    CHECK(error.parts().key == hostile);                       // who asks for it has it
    CHECK(std::string(InputError({.problem = "there is no such file", .place = {"\0"s}}).what()) ==
          "\\x00: there is no such file");
}
