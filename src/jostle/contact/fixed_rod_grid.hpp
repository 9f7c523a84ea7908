#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "jostle/contact/pair_contacts.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/wall.hpp"

namespace jostle {

/// Fixed rods of a box are bodies with numbers after those of walls.
constexpr std::uint32_t body_of_fixed_rod(std::uint32_t number) {
    return fixed_body(max_walls + number);
}
constexpr bool is_fixed_rod(std::uint32_t body) {
    return is_fixed(body) && number_of_fixed(body) >= max_walls;
}
constexpr std::uint32_t number_of_fixed_rod(std::uint32_t body) {
    return number_of_fixed(body) - max_walls;
}

/// A fixed rod, or its copy displaced by -image * edges: the fixed rod is i of a contact, and a rod j in `image` meets
/// it.
struct FixedCopy {
    std::uint32_t number;  ///< of the fixed rod
    Image image;
    Vec3 centre;  ///< of the copy
};

/// The one that a contact is with.
FixedCopy copy_of(const Contact& contact, const Image& image, const Box& box);

/// A fixed rod and rod `row` with this centre and axis.
PairGeometry pair_with(const Rods& fixed, const FixedCopy& copy, const Rods& rods, std::size_t row, const Vec3& centre,
                       const Vec3& axis);

/// Which fixed rods are near a place: they do not move, so a grid of cells lists them once.
class FixedRodGrid {
public:
    /// Makes the grid that tells all copies whose axes come within `range` of a point; keeps the old one if that does.
    void fit(const Box& box, double range);

    bool empty() const { return !fixed_; }
    double range() const { return range_; }
    const Rods& fixed() const { return *fixed_; }

    /// Copies whose axes may come within `range` of the point, in the order of their numbers and images.
    std::span<const FixedCopy> near(const Vec3& point) const;

    /// A fixed rod and rod `row` with this centre and axis.
    PairGeometry pair(const FixedCopy& copy, const Rods& rods, std::size_t row, const Vec3& centre,
                      const Vec3& axis) const;

private:
    void list_copies(const Box& box);
    void set_cells(const Box& box);
    void add_copy(const FixedCopy& copy, double within, std::vector<std::vector<FixedCopy>>& cells) const;

    std::shared_ptr<const Rods> fixed_;
    Vec3 edges_{};
    double range_ = 0.0;
    Vec3 corner_{}, spacing_{1, 1, 1};
    std::array<std::size_t, 3> cells_{1, 1, 1};
    std::vector<std::size_t> begin_;   ///< (cells + 1)
    std::vector<FixedCopy> in_cells_;  ///< cell by cell
};

/// The grid for what touches rods of these sizes.
FixedRodGrid grid_of_fixed_rods(const Box& box, const Rods& rods);

/// The farthest that a point of a rod, or of a fixed rod that it touches, is from its centre: half its length, its
/// radius, and how far it may come.
double range_from_centre(const Rods& rods, const Rods& fixed, std::span<const double> range);

}  // namespace jostle
