#include "jostle/statistics/order_parameter.hpp"

#include <cmath>

#include "jostle/error/refuse.hpp"
#include "jostle/math/symmetric_eigen.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

Vec3 with_largest_component_positive(const Vec3& v) {
    int largest = 0;
    for (int k = 1; k < 3; ++k)
        if (std::fabs(v[k]) > std::fabs(v[largest])) largest = k;
    return v[largest] < 0.0 ? -v : v;
}

}  // namespace

NematicOrder nematic_order(std::span<const Vec3> axes, int dimensions) {
    return nematic_order(parallel_sum<Mat3>(axes.size(), [&](std::size_t i) { return outer(axes[i], axes[i]); }),
                         axes.size(), dimensions);
}

NematicOrder nematic_order(const Mat3& sum, std::size_t count, int dimensions) {
    if (count == 0) {
        refuse("axes", "none", "no rods, no order", "at least one axis");
    }
    const double others = dimensions - 1;
    const Mat3 tensor =
        (dimensions / others / static_cast<double>(count)) * sum - (1.0 / others) * identity(dimensions);
    const SymmetricEigen eigen = symmetric_eigen(tensor);
    return {tensor, eigen.values[2], with_largest_component_positive(eigen.vectors[2])};
}

}  // namespace jostle
