#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "jostle/math/vec3.hpp"

namespace jostle {

/// How many box edges along x, y, z lie between a rod (or a contact partner) and its wrapped copy.
using Image = std::array<std::int32_t, 3>;

/// Where a rod that grows stands between its birth and its division (src/jostle/growth).
struct CellCycle {
    double growth_rate = 0.0;      ///< of its length when nothing presses on it (length/time)
    double division_at = 0.0;      ///< the length, or with a timer the age, at which it divides
    std::uint64_t birth_step = 0;  ///< the step after which it was born
    std::uint64_t divisions = 0;   ///< in its line of mothers since the start
    double share = 1.0;            ///< of its rate that it grows by: 1 less its mean compression over the stall force
};

/// The rods of an assembly: a structure of arrays, one row a rod.
///
/// A rod is a spherocylinder: the points within diameter/2 of the segment centre +- (length/2) axis.
/// A sphere is a rod of length 0; it still has an axis (the direction it swims in).
struct Rods {
    std::vector<Vec3> centre;       ///< (N) inside the box along periodic directions
    std::vector<Vec3> axis;         ///< (N) unit vectors
    std::vector<double> length;     ///< (N) of the cylinder part, >= 0
    std::vector<double> diameter;   ///< (N) > 0
    std::vector<std::uint64_t> id;  ///< (N) permanent, never reused
    std::vector<Image> image;       ///< (N) box edges crossed since the start: unwrapped = centre + image * edges
    std::vector<CellCycle> cycle;   ///< (N), or empty where rods do not grow
    int founder_bits = 0;           ///< where they do: ids at the start were below 2^founder_bits
    std::vector<double>
        speed;  ///< (N) own speeds of swimmers, or empty where a law gives them (motion/self_propulsion)

    std::size_t size() const { return centre.size(); }

    void push_back(std::uint64_t new_id, const Vec3& new_centre, const Vec3& new_axis, double new_length,
                   double new_diameter) {
        centre.push_back(new_centre);
        axis.push_back(new_axis);
        length.push_back(new_length);
        diameter.push_back(new_diameter);
        id.push_back(new_id);
        image.push_back({0, 0, 0});
    }
};

/// How far any point of a rod moves at most: its centre moves by `centre`, its axis, a unit vector, changes by `axis`.
///
/// A point at s along the axis moves by centre + s axis, |s| <= half_length; the farthest is an end.
inline double farthest_displacement(const Vec3& centre, const Vec3& axis, double half_length) {
    return std::sqrt(squared_norm(centre) +
                     half_length * (half_length * squared_norm(axis) + 2.0 * std::fabs(dot(centre, axis))));
}

/// Volume of a spherocylinder, pi (L D^2/4 + D^3/6). In two dimensions the area of it that the plane cuts, L D + pi
/// D^2/4.
double rod_volume(double length, double diameter, int dimensions = 3);

/// Sum of the rods' volumes, or areas.
double total_volume(const Rods& rods, int dimensions = 3);

/// Whether all have one length and one diameter.
bool all_alike(const Rods& rods);

/// Mean of L/D; nan without rods.
double mean_aspect_ratio(const Rods& rods);

}  // namespace jostle
