#include "jostle/statistics/student_t.hpp"

#include <algorithm>

namespace jostle {

namespace {

constexpr double two_sided_95 = 1.959964;  // of a normal distribution

}  // namespace

double widening(double degrees_of_freedom) {
    const double z = two_sided_95, z2 = z * z, inverse = 1.0 / std::max(1.0, degrees_of_freedom);
    const double terms[4] = {(z2 + 1.0) / 4.0, ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0,
                             (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0,
                             ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0};
    return 1.0 + inverse * (terms[0] + inverse * (terms[1] + inverse * (terms[2] + inverse * terms[3])));
}

}  // namespace jostle
