#pragma once

#include <array>
#include <span>
#include <vector>

#include "jostle/stress/collision_moments.hpp"

namespace jostle {

/// The collision stress, and the number density of rods, as fields on a grid: means over steps (theory, eq. 1.18).
///
/// The force moment of a contact is spread evenly along the line between the two centres of mass (Irving and Kirkwood
/// 1950; Hardy 1982), the geometric stress of a rod stands at its centre, and both are weighted to the cells by a hat
/// of one cell edge to either side in each direction ("cloud in cell"). The weights of a point sum to 1, and so does
/// their integral along a line, which is taken exactly: sums over cells times the cell volume are V Sigma_col and N, to
/// rounding. Periodic directions wrap. Along open ones the grid spans the box: within half a cell of an edge all goes
/// to the last cell, and what lies beyond the edge is counted apart, as `outside`.
class StressField {
public:
    /// A grid over `box` with as many cells as fit with edges of at least `spacing`. Throws InputError
    /// (output.field_spacing) if that is not positive, or makes more than a million cells.
    StressField(const Box& box, double spacing);

    /// One step: its moments, and where the rods are (N).
    void add(const CollisionMoments& moments, std::span<const Vec3> centres);

    /// Forgets all steps.
    void clear();

    /// Along x, y, z. Cell (a, b, c) has the number (a n_y + b) n_z + c.
    const std::array<std::size_t, 3>& cells() const { return cells_; }
    std::size_t size() const { return virial_.size(); }
    Vec3 centre(std::size_t cell) const;
    double cell_volume() const { return edges_.x * edges_.y * edges_.z; }
    bool has_outside() const { return !box_.is_periodic(); }

    /// Means over the steps, in a cell: stress (force/length^2), and rods per volume. Not numbers before the first
    /// step.
    Mat3 stress(std::size_t cell) const { return per_step_and_volume() * virial_[cell]; }
    double number_density(std::size_t cell) const { return per_step_and_volume() * count_[cell]; }
    /// The same of all that lies outside, as if it were in one more cell.
    Mat3 outside_stress() const { return per_step_and_volume() * outside_virial_; }
    double outside_number_density() const { return per_step_and_volume() * outside_count_; }

    /// For checkpoints.
    std::vector<double> to_numbers() const;
    static StressField from_numbers(std::span<const double> numbers);

private:
    double per_step_and_volume() const { return 1.0 / (steps_ * cell_volume()); }
    void spread(const CollisionMoments::Pair& pair);
    template <class Value>
    void deposit(const Vec3& point, const Value& value, std::vector<Value>& field, Value& outside) const;

    Box box_;
    std::array<std::size_t, 3> cells_;
    Vec3 edges_;  ///< of a cell
    double steps_ = 0.0;
    std::vector<Mat3> virial_;   ///< (cells) summed over the steps
    std::vector<double> count_;  ///< (cells) the same of rods
    Mat3 outside_virial_;
    double outside_count_ = 0.0;
    std::vector<double> breaks_;  ///< scratch
};

}  // namespace jostle
