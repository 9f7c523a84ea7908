#pragma once

#include <array>
#include <span>
#include <vector>

#include "jostle/math/named_numbers.hpp"
#include "jostle/stress/collision_moments.hpp"

namespace jostle {

/// Collision stress, orientation stress and number density of rods as fields on a grid: means over steps (theory, eq.
/// 1.18).
///
/// The force moment of a contact is spread evenly along the line between the two centres of mass (Irving and Kirkwood
/// 1950; Hardy 1982), geometric and orientation stress of a rod stand at its centre, and all are weighted to the cells
/// by a hat of one cell edge to either side in each direction ("cloud in cell"). The weights of a point sum to 1, and
/// so does their integral along a line, which is taken exactly: sums over cells times the cell volume are V Sigma_col,
/// V Sigma_ori and N, to rounding. Periodic directions wrap. Along open ones the grid spans the box: within half a cell
/// of an edge all goes to the last cell, and what lies beyond the edge is counted apart, as `outside`.
class StressField {
public:
    /// A grid over `box` with as many cells as fit with edges of at least `spacing`. Throws InputError
    /// (output.field_spacing) if that is not positive, or makes more than a million cells.
    StressField(const Box& box, double spacing);

    /// One step: its moments, and the rods after it, which turn with the temperature kT.
    void add(const CollisionMoments& moments, const Rods& rods, double kT);

    /// To be told the box as it is now, before each step is added where it changes: as many cells, of other size. What
    /// steps before have left in them, per volume, stays.
    void fit(const Box& box);

    /// Forgets all steps.
    void clear();

    /// Along x, y, z. Cell (a, b, c) has the number (a n_y + b) n_z + c.
    const std::array<std::size_t, 3>& cells() const { return cells_; }
    std::size_t size() const { return content_.size(); }
    Vec3 centre(std::size_t cell) const;
    double cell_volume() const { return volume_of(edges_); }
    bool has_outside() const { return !box_.is_periodic(); }

    /// What is in a cell: rods per volume, and stress, force/length^2.
    struct Content {
        double number_density = 0.0;
        Mat3 collision, orientation;

        Content& add(double weight, const Content& other);
    };
    /// Means over the steps. Not numbers before the first step.
    Content mean(std::size_t cell) const { return mean_of(content_[cell]); }
    /// The same of all that lies outside, as if it were in one more cell.
    Content outside_mean() const { return mean_of(outside_); }

    /// For checkpoints.
    NamedNumbers to_named() const;
    /// Errors: InputError if they are not whole.
    static StressField from_named(const NamedNumbers& numbers);

private:
    Content mean_of(const Content& sum) const { return Content{}.add(1.0 / (steps_ * cell_volume()), sum); }
    void spread(const CollisionMoments::Pair& pair);
    template <class Add>
    void deposit(const Vec3& point, Add&& add);

    Box box_;
    std::array<std::size_t, 3> cells_;
    Vec3 edges_;  ///< of a cell
    double steps_ = 0.0;
    std::vector<Content> content_;  ///< (cells) summed over the steps, times the volume of a cell
    Content outside_;
    std::vector<double> breaks_;  ///< scratch
};

}  // namespace jostle
