#include "jostle/mobility/drag_mobility.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

void apply_to_rod(const RodMobility& mobility, const Vec3& axis, const Vec3& force, const Vec3& torque, Vec3& linear,
                  Vec3& angular) {
    const double more_along = (mobility.parallel - mobility.perpendicular) * dot(axis, force);
    linear = mobility.perpendicular * force + more_along * axis;
    angular = mobility.rotational * (torque - dot(axis, torque) * axis);
}

/// Compares memory: much faster than number by number, and at most too strict (of 0 and -0).
bool same_bytes(const std::vector<double>& now, const std::vector<double>& before) {
    constexpr std::size_t block = 4096;
    return parallel_max_of_blocks((now.size() + block - 1) / block, now.size(), [&](std::size_t number) {
               const std::size_t begin = number * block, count = std::min(block, now.size() - begin);
               return std::memcmp(&now[begin], &before[begin], count * sizeof(double)) == 0 ? 0.0 : 1.0;
           }) == 0.0;
}

}  // namespace

/// The coefficients of all rods. Equal neighbours are common (all rods alike, synchronous growth): they share one kind.
struct DragCoefficients {
    /// Rods of one length and diameter.
    struct Kind {
        double length, diameter;
        RodMobility own, root;  ///< the coefficients and their square roots
    };

    std::vector<std::uint32_t> kind_of;    ///< (N)
    std::vector<double> length, diameter;  ///< (N) they were found for
    std::vector<Kind> kinds;

    DragCoefficients(const Rods& rods, const DragLaw& law);

    const Kind& of(std::size_t i) const { return kinds[kind_of[i]]; }

    bool fit(const Rods& rods) const {
        return kind_of.size() == rods.size() && same_bytes(rods.length, length) && same_bytes(rods.diameter, diameter);
    }
};

DragCoefficients::DragCoefficients(const Rods& rods, const DragLaw& law)
    : kind_of(rods.size()), length(rods.length), diameter(rods.diameter) {
    for (std::size_t i = 0; i < rods.size(); ++i) {
        const bool same = i > 0 && rods.length[i] == rods.length[i - 1] && rods.diameter[i] == rods.diameter[i - 1];
        if (!same) kinds.push_back({rods.length[i], rods.diameter[i], {}, {}});
        kind_of[i] = static_cast<std::uint32_t>(kinds.size() - 1);
    }
    const auto ask = [&](std::size_t k) {
        const RodMobility own = law(kinds[k].length, kinds[k].diameter);
        kinds[k].own = own;
        kinds[k].root = {std::sqrt(own.parallel), std::sqrt(own.perpendicular), std::sqrt(own.rotational)};
    };
    try {
        parallel_for(kinds.size(), ask);
    } catch (const InputError&) {  // of the first rod that the law refuses, whichever thread came first
        for (std::size_t k = 0; k < kinds.size(); ++k) ask(k);
    }
}

namespace {

class DragOperator final : public MobilityOperator {
public:
    DragOperator(const Rods& rods, std::shared_ptr<const DragCoefficients> coefficients)
        : MobilityOperator(rods), coefficients_(std::move(coefficients)) {}

    void apply(const Forces& forces, Velocities& velocities) const override {
        assert(coefficients_->kind_of.size() == rods().size() && forces.size() == rods().size());
        velocities.resize(rods().size());
        parallel_for(rods().size(), [&](std::size_t i) {
            apply_to_rod(coefficients_->of(i).own, rods().axis[i], forces.force[i], forces.torque[i],
                         velocities.linear[i], velocities.angular[i]);
        });
    }

    /// xi are six numbers per rod, three for force and three for torque.
    void add_square_root(const RandomKey& key, double scale, Velocities& velocities) const override {
        assert(coefficients_->kind_of.size() == rods().size() && velocities.size() == rods().size());
        parallel_for_blocks(rods().size(), normals_at_a_time, [&](std::size_t, std::size_t begin, std::size_t end) {
            std::array<Normals, normals_at_a_time> normals;
            fill_normals(key, {rods().id.data() + begin, end - begin}, {normals.data(), end - begin});
            for (std::size_t i = begin; i < end; ++i) {
                const Normals& xi = normals[i - begin];
                Vec3 linear, angular;
                apply_to_rod(coefficients_->of(i).root, rods().axis[i], {xi[0], xi[1], xi[2]}, {xi[3], xi[4], xi[5]},
                             linear, angular);
                velocities.linear[i] += scale * linear;
                velocities.angular[i] += scale * angular;
            }
        });
    }

    bool couples_rods() const override { return false; }
    RodMobility of_rod(std::size_t i) const override { return coefficients_->of(i).own; }

private:
    std::shared_ptr<const DragCoefficients> coefficients_;
};

}  // namespace

DragMobility::DragMobility(DragLaw law) : law_(std::move(law)) {}

std::unique_ptr<const MobilityOperator> DragMobility::at(const Rods& rods, const Box& /*box*/) const {
    std::shared_ptr<const DragCoefficients> coefficients;
    {
        const std::lock_guard guard(lock_);
        coefficients = last_;
    }
    if (!coefficients || !coefficients->fit(rods)) {
        coefficients = std::make_shared<const DragCoefficients>(rods, law_);
        const std::lock_guard guard(lock_);
        last_ = coefficients;
    }
    return std::make_unique<DragOperator>(rods, std::move(coefficients));
}

}  // namespace jostle
