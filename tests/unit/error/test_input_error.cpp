#include <doctest/doctest.h>

#include "jostle/error/input_error.hpp"

using namespace jostle;

TEST_CASE("a message has place, key, value, problem, range and suggestion, and leaves out what is not known") {
    const InputError error({.key = "box.volume_fraction",
                            .value = "1.2",
                            .problem = "rods cannot be packed as densely",
                            .allowed = "0 < phi < 0.88",
                            .suggestion = "Use a lower one"});
    CHECK(std::string(error.what()) ==
          "box.volume_fraction = 1.2: rods cannot be packed as densely (allowed: 0 < phi < 0.88). Use a lower one");
    CHECK(std::string(error.with_place({"a.toml", 3, 7}).what()).rfind("a.toml:3:7: box.volume_fraction = 1.2: ", 0) ==
          0);
    CHECK(std::string(error.with_place({"a.toml", 3, 0}).what()).rfind("a.toml:3: ", 0) == 0);
    CHECK(std::string(InputError({.problem = "nothing is right"}).what()) == "nothing is right");
    CHECK(std::string(InputError({.value = "x", .problem = "wrong", .place = {"f"}}).what()) == "f: x: wrong");
}
