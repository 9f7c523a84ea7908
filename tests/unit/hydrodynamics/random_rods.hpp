#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "jostle/mobility/mobility.hpp"

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

inline bool same_bits(const Velocities& a, const Velocities& b) {
    return std::equal(a.linear.begin(), a.linear.end(), b.linear.begin()) &&
           std::equal(a.angular.begin(), a.angular.end(), b.angular.begin());
}

}  // namespace jostle
