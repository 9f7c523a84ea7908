#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "jostle/rods/rod_mobility.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// Longer rods are not known: parameters were found for 0 <= L/D <= 20.
inline constexpr double longest_line_of_blobs = 20.0;

/// A rod of one length as the fluid feels it: a line of Gaussian blobs of force (theory, eq. 7.1).
///
/// A force F and a moment l (the torque is n x l) on the rod put the force force_weight F + moment_weight l_perp on
/// each blob; its velocity follows from theirs by the same weights. These are the tractions of the isolated rod, so
/// that the rod's own mobility is that of its line of blobs plus `remainder`.
struct BlobLine {
    double length = 0.0;
    std::vector<double> place;          ///< (blobs) along the axis, from the centre; a length
    std::vector<double> force_weight;   ///< (blobs) add up to 1
    std::vector<double> moment_weight;  ///< (blobs) 1/length; 0 of spheres
    RodMobility own;                    ///< of a spherocylinder alone in an unbounded fluid (theory, eq. 2.19)
    RodMobility remainder;              ///< own less that of the line of blobs, >= 0

    bool is_sphere() const { return place.size() == 1; }
    double half() const { return place.back(); }  ///< from the centre to the last blob
};

/// The blobs of rods of one diameter and of some lengths up to 20 D, all of one width.
struct BlobLines {
    double diameter = 1.0;
    double spread = 0.0;          ///< variance of each blob's Gaussian; length^2
    std::vector<BlobLine> lines;  ///< one a length, ascending

    bool fit(double diameter_of_rods, const std::vector<double>& lengths) const;
};

/// Those of each rod.
struct RodBlobs {
    std::shared_ptr<const BlobLines> kinds;
    std::vector<std::uint32_t> line_of;  ///< (N)

    const BlobLine& of(std::size_t row) const { return kinds->lines[line_of[row]]; }
    const std::vector<BlobLine>& lines() const { return kinds->lines; }
    double spread() const { return kinds->spread; }
    double diameter() const { return kinds->diameter; }
    bool any_sphere() const { return !lines().empty() && lines().front().is_sphere(); }
    std::size_t max_blobs() const;
    double longest_half() const { return lines().empty() ? 0.0 : lines().back().half(); }
};

/// `known`: lines that may fit these rods, and are then taken. Errors: InputError (mobility.model) for rods of
/// different diameters, or longer than `longest_line_of_blobs`.
RodBlobs blobs_of(const Rods& rods, double viscosity, std::shared_ptr<const BlobLines> known = nullptr);

/// Own mobility of a line's blobs in the flow `kernel(squared distance)`, without the remainder.
template <class Kernel>
RodMobility mobility_of_blobs(const BlobLine& line, Kernel&& kernel) {
    RodMobility sum;
    for (std::size_t b = 0; b < line.place.size(); ++b)
        for (std::size_t c = 0; c < line.place.size(); ++c) {
            const double apart = line.place[b] - line.place[c];
            const auto flow = kernel(apart * apart);
            const double weight = line.force_weight[b] * line.force_weight[c];
            sum.parallel += weight * (flow.isotropic + flow.radial * apart * apart);
            sum.perpendicular += weight * flow.isotropic;
            sum.rotational += line.moment_weight[b] * line.moment_weight[c] * flow.isotropic;
        }
    return sum;
}

}  // namespace jostle
