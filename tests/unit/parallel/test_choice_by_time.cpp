// A number chosen by the times of steps, which are made up: of threads.

#include <doctest/doctest.h>

#include <functional>
#include <map>

#include "jostle/parallel/choice_by_time.hpp"

using jostle::ChoiceByTime;

namespace {

/// Steps with times told by seconds(threads, step); how many steps were made with each number of threads.
std::map<int, int> counted(ChoiceByTime& choice, int most, int first, int last,
                           const std::function<double(int, int)>& seconds) {
    std::map<int, int> steps;
    for (int step = first; step < last; ++step) {
        const int threads = choice.next(most);
        REQUIRE(threads >= 1);
        REQUIRE(threads <= most);
        ++steps[threads];
        choice.took(seconds(threads, step));
    }
    return steps;
}

double alone(int threads, int) {
    return 1.0 / threads;
}
/// Other programs keep all processors but one busy.
double crowded(int threads, int) {
    return threads == 1 ? 1.0 : 2.0 * threads;
}

}  // namespace

TEST_CASE("a run alone takes as many threads as are worth it, and tries fewer seldom") {
    ChoiceByTime choice;
    const auto steps = counted(choice, 2, 0, 2000, alone);
    CHECK(steps.at(2) > 1960);
    CHECK(steps.at(1) >= 1);
}

TEST_CASE("beside other programs a run takes one thread") {
    ChoiceByTime choice;
    const auto steps = counted(choice, 2, 0, 1000, crowded);
    CHECK(steps.at(1) > 950);
}

TEST_CASE("the number follows what other programs do") {
    ChoiceByTime choice;
    counted(choice, 2, 0, 500, alone);
    CHECK(counted(choice, 2, 500, 1000, crowded).at(1) > 440);  // longer steps are noticed, and not by patience alone
    CHECK(counted(choice, 2, 1000, 2000, alone).at(2) > 750);
}

TEST_CASE("a number between is found where it is best") {
    ChoiceByTime choice;
    const auto four_free = [](int threads, int) { return threads <= 4 ? 1.0 / threads : threads / 16.0; };
    counted(choice, 16, 0, 100, four_free);
    CHECK(counted(choice, 16, 100, 1100, four_free).at(4) > 970);
}

TEST_CASE("single long steps, in which neighbour lists are built, change nothing") {
    ChoiceByTime choice;
    const auto steps =
        counted(choice, 2, 0, 2000, [](int threads, int step) { return (step % 10 == 7 ? 4.0 : 1.0) / threads; });
    CHECK(steps.at(2) > 1950);
}

TEST_CASE("the number follows a crowd that grows, and never leaves what is asked for") {
    ChoiceByTime choice;
    CHECK(counted(choice, 1, 0, 500, alone).at(1) == 500);
    CHECK(counted(choice, 4, 500, 1000, alone).at(4) > 470);
    CHECK(counted(choice, 2, 1000, 1500, alone).at(2) > 470);
}
