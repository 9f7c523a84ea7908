#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "jostle/contact/cell_list.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// Gaps in a neighbour list are counted in these; the widest fits 16 bits.
inline constexpr float units_per_list_range = 65535.0F;

/// Pairs (i, j, image) of some rods i, one rod after the other; gap and image as the list holds them.
struct NewPairs {
    struct Partner {
        std::uint32_t j;
        std::uint16_t image, gap;
    };
    std::vector<std::uint32_t> i;
    std::vector<Partner> partners;
};

/// Rods around a cell, images apart, in arrays for vector instructions.
struct Surroundings {
    std::vector<float> x, y, z, axis_x, axis_y, axis_z, half_length, radius, gap;
    std::vector<std::uint32_t> row;
    std::vector<std::uint16_t> image;

    void clear() {
        for (auto* values : {&x, &y, &z, &axis_x, &axis_y, &axis_z, &half_length, &radius}) values->clear();
        row.clear();
        image.clear();
    }
    void push_back(const Rods& rods, std::uint32_t j, const Vec3& relative_centre, std::uint16_t new_image) {
        const auto single = [](double value) { return static_cast<float>(value); };
        x.push_back(single(relative_centre.x));
        y.push_back(single(relative_centre.y));
        z.push_back(single(relative_centre.z));
        axis_x.push_back(single(rods.axis[j].x));
        axis_y.push_back(single(rods.axis[j].y));
        axis_z.push_back(single(rods.axis[j].z));
        half_length.push_back(single(0.5 * rods.length[j]));
        radius.push_back(single(0.5 * rods.diameter[j]));
        row.push_back(j);
        image.push_back(new_image);
    }
    std::size_t size() const { return row.size(); }
};

/// The images up to `farthest` to both sides of 0, numbered in ascending order.
class ImageNumbers {
public:
    /// Errors: InputError for more than 16 bits can number.
    explicit ImageNumbers(const Image& farthest);

    std::uint16_t of(const Image& image) const;
    std::vector<Image> all() const;

private:
    Image farthest_;
};

/// Finds the pairs of a neighbour list, cell by cell: of rods whose gap is below the range of the list. Holds
/// references.
class NeighbourPairs {
public:
    /// `range`: of centres, within which pairs are looked for. `own`: so many of the first rows have pairs.
    NeighbourPairs(const Rods& rods, const Box& box, const CellList& cells, const ImageNumbers& images, double range,
                   double list_range, double units_per_length, std::size_t own);

    /// Appends the pairs (i, j >= i, image) with a gap below the range of the list, of all i in a cell; in order for
    /// each i. Fills in how many there are of each.
    void append_pairs_of(std::size_t home, Surroundings& around, NewPairs& pairs,
                         std::vector<std::size_t>& count) const;

private:
    bool are_near_each_other(std::span<const std::uint32_t> homes) const;
    void append_pairs_of(std::size_t home, std::span<const std::uint32_t> homes, Surroundings& around, NewPairs& pairs,
                         std::vector<std::size_t>& count) const;
    std::uint16_t in_units(float gap) const;
    void gather(std::size_t home, std::span<const std::uint32_t> homes, const Vec3& origin, Surroundings& around) const;

    const Rods& rods_;
    std::size_t own_;
    const Box& box_;
    const CellList& cells_;
    const ImageNumbers& images_;
    std::uint16_t zero_;
    double squared_range_;
    float error_, list_range_, units_per_length_;
};

}  // namespace jostle
