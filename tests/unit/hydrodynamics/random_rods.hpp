#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "jostle/math/random.hpp"
#include "jostle/mobility/mobility.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle {

/// Random numbers of one seed, and rods and forces made of them.
class Chance {
public:
    explicit Chance(std::uint64_t seed) : generator_(seed) {}
    Vec3 vector() { return {normal_(generator_), normal_(generator_), normal_(generator_)}; }
    double uniform() { return uniform_(generator_); }
    /// Rods anywhere: they may overlap.
    Rods rods(std::size_t count, double length, const Vec3& edges) {
        Rods rods;
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 axis = normalised(vector());  // before the centre, whatever the compiler
            const Vec3 centre{edges.x * uniform(), edges.y * uniform(), edges.z * uniform()};
            rods.push_back(i, centre, axis, length, 1.0);
        }
        return rods;
    }
    Forces forces(const Rods& rods) {
        Forces forces(rods.size());
        for (std::size_t i = 0; i < rods.size(); ++i) {
            forces.force[i] = vector();
            const Vec3 torque = vector();
            forces.torque[i] = torque - dot(torque, rods.axis[i]) * rods.axis[i];
        }
        return forces;
    }

private:
    std::mt19937_64 generator_;
    std::normal_distribution<double> normal_;
    std::uniform_real_distribution<double> uniform_;
};

inline Velocities moved(const Mobility& mobility, const Rods& rods, const Box& box, const Forces& forces) {
    Velocities velocities;
    mobility.at(rods, box)->apply(forces, velocities);
    return velocities;
}

inline double power(const Velocities& velocities, const Forces& forces) {
    double sum = 0.0;
    for (std::size_t i = 0; i < forces.size(); ++i)
        sum += dot(velocities.linear[i], forces.force[i]) + dot(velocities.angular[i], forces.torque[i]);
    return sum;
}

/// Root of the mean squares of the differences over that of the velocities; of angular velocities as well.
inline std::array<double, 2> errors(const Velocities& found, const Velocities& exact) {
    std::array<double, 2> wrong{}, all{};
    for (std::size_t i = 0; i < exact.size(); ++i) {
        wrong[0] += squared_norm(found.linear[i] - exact.linear[i]);
        wrong[1] += squared_norm(found.angular[i] - exact.angular[i]);
        all[0] += squared_norm(exact.linear[i]);
        all[1] += squared_norm(exact.angular[i]);
    }
    return {std::sqrt(wrong[0] / all[0]), std::sqrt(wrong[1] / all[1])};
}

/// How far noise is from having the covariance M, <(y.U)^2> = y.M y with the forces y: of the deviations in standard
/// errors the mean of the squares, and the mean.
struct NoiseDeviation {
    double chi_squared = 0.0, mean = 0.0;
};

inline NoiseDeviation deviation_of_noise(const MobilityOperator& mobility, std::span<const Forces> forces, int samples,
                                         std::uint64_t seed) {
    const auto vectors = static_cast<double>(forces.size());
    std::vector<double> expected, squares(forces.size(), 0.0);
    for (const Forces& vector : forces) {
        Velocities u;
        mobility.apply(vector, u);
        expected.push_back(4.0 * power(u, vector));
    }
    for (int step = 0; step < samples; ++step) {
        Velocities u(forces.front().size());
        mobility.add_square_root({seed, static_cast<std::uint64_t>(step), Stream::brownian, 0}, 2.0, u);
        for (std::size_t k = 0; k < forces.size(); ++k) squares[k] += std::pow(power(u, forces[k]), 2.0) / samples;
    }
    NoiseDeviation found;
    for (std::size_t k = 0; k < forces.size(); ++k) {
        const double deviation = (squares[k] / expected[k] - 1.0) / std::sqrt(2.0 / samples);
        found.chi_squared += deviation * deviation / vectors;
        found.mean += deviation / vectors;
    }
    return found;
}

inline bool same_bits(const Velocities& a, const Velocities& b) {
    return std::equal(a.linear.begin(), a.linear.end(), b.linear.begin()) &&
           std::equal(a.angular.begin(), a.angular.end(), b.angular.begin());
}

/// Whether motion(rods, forces, threads), velocities of all rods, has the same bits for any number of threads and any
/// order of rows. The number of rods is no multiple of 7.
template <class Motion>
bool has_same_bits_always(const Rods& rods, const Forces& forces, Motion&& motion) {
    std::vector<std::uint32_t> shuffled(rods.size());
    for (std::uint32_t k = 0; k < shuffled.size(); ++k)
        shuffled[k] = (k * 7 + 3) % static_cast<std::uint32_t>(shuffled.size());
    const Rods other = reordered(rods, shuffled);
    Forces other_forces(rods.size());
    for (std::size_t k = 0; k < rods.size(); ++k) {
        other_forces.force[k] = forces.force[shuffled[k]];
        other_forces.torque[k] = forces.torque[shuffled[k]];
    }
    const Velocities expected = motion(rods, forces, 1);
    bool same = same_bits(motion(rods, forces, 3), expected);
    for (const int threads : {1, 2}) {
        const Velocities found = motion(other, other_forces, threads);
        Velocities in_order(rods.size());
        for (std::size_t k = 0; k < rods.size(); ++k) {
            in_order.linear[shuffled[k]] = found.linear[k];
            in_order.angular[shuffled[k]] = found.angular[k];
        }
        same = same && same_bits(in_order, expected);
    }
    return same;
}

}  // namespace jostle
