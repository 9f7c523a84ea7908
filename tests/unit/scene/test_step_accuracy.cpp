#include <doctest/doctest.h>

#include "jostle/scene/step_accuracy.hpp"

using namespace jostle;

namespace {

/// So many rods of this length in a cube of edge 10; each sphere fills 0.05 % of it.
StepError error_of(std::size_t count, double length) {
    Rods rods;
    for (std::size_t i = 0; i < count; ++i) rods.push_back(i, {}, {1, 0, 0}, length, 1.0);
    return known_step_error({}, rods, Box({10, 10, 10}));
}

}  // namespace

TEST_CASE("long rods order where they are crowded, others do not") {
    const StepError fluid = error_of(100, 0.0), dilute = error_of(20, 5.0), crowded = error_of(100, 5.0);
    CHECK(dilute.at_reference == fluid.at_reference);  // volume fraction 0.09
    CHECK(crowded.at_reference > fluid.at_reference);  // 0.45, where rods of L/D = 5 are a nematic
    CHECK(error_of(600, 0.0).at_reference == fluid.at_reference);
}

TEST_CASE("errors grow as the square of the rms step; steps beyond what was measured are not taken") {
    const StepError error = {"some", 0.004};
    CHECK(largest_step_error(0.06, error) == doctest::Approx(0.004));
    CHECK(largest_step_error(0.03, error) == doctest::Approx(0.001));
    CHECK(rms_step_of_accuracy(0.001, error) == doctest::Approx(0.03));
    CHECK(largest_step_error(rms_step_of_accuracy(0.007, error), error) == doctest::Approx(0.007));
    CHECK(rms_step_of_accuracy(0.05, error) == 0.1);
}
