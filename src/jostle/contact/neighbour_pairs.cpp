#include "jostle/contact/neighbour_pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "jostle/contact/segment_separation.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

/// Gaps are computed in float, from places relative to a rod near by. Their error, in units of the range of the search,
/// is far below this; nearly parallel rods have the largest, some 3e-5.
constexpr double float_error = 2e-4;
/// Rods are near by within so many ranges.
constexpr double near = 8.0;

/// The gaps of one rod and many.
JOSTLE_VECTORISED void find_gaps(std::size_t count, const float* x, const float* y, const float* z, const float* axis_x,
                                 const float* axis_y, const float* axis_z, const float* half_length,
                                 const float* radius, const std::array<float, 8>& one, float* gap) {
    const auto [x_i, y_i, z_i, ux, uy, uz, half_i, radius_i] = one;
    for (std::size_t k = 0; k < count; ++k) {
        const auto [ex, ey, ez] = segment_separation({x[k] - x_i, y[k] - y_i, z[k] - z_i}, {ux, uy, uz}, half_i,
                                                     {axis_x[k], axis_y[k], axis_z[k]}, half_length[k]);
        gap[k] = std::sqrt(ex * ex + ey * ey + ez * ez) - radius[k] - radius_i;
    }
}

}  // namespace

ImageNumbers::ImageNumbers(const Image& farthest) : farthest_(farthest) {
    double count = 1.0;
    for (const int images : farthest) count *= 2.0 * images + 1.0;
    if (count > 65536.0)
        throw InputError({.key = "box.edges",
                          .problem = "are so short that a rod meets the others in more than 65536 periodic images",
                          .suggestion = "Enlarge the box"});
}

std::uint16_t ImageNumbers::of(const Image& image) const {
    const auto place = [&](std::size_t k) { return image[k] + farthest_[k]; };
    return static_cast<std::uint16_t>((place(0) * (2 * farthest_[1] + 1) + place(1)) * (2 * farthest_[2] + 1) +
                                      place(2));
}

std::vector<Image> ImageNumbers::all() const {
    std::vector<Image> images;
    for (int x = -farthest_[0]; x <= farthest_[0]; ++x)
        for (int y = -farthest_[1]; y <= farthest_[1]; ++y)
            for (int z = -farthest_[2]; z <= farthest_[2]; ++z) images.push_back({x, y, z});
    return images;
}

NeighbourPairs::NeighbourPairs(const Rods& rods, const Box& box, const CellList& cells, const ImageNumbers& images,
                               double range, double list_range, double units_per_length, std::size_t own)
    : rods_(rods),
      own_(own),
      box_(box),
      cells_(cells),
      images_(images),
      zero_(images.of({0, 0, 0})),
      squared_range_(range * range),
      error_(static_cast<float>(float_error * range)),
      list_range_(static_cast<float>(list_range) + error_),
      units_per_length_(static_cast<float>(units_per_length)) {}

void NeighbourPairs::append_pairs_of(std::size_t home, Surroundings& around, NewPairs& pairs,
                                     std::vector<std::size_t>& count) const {
    const auto in_cell = cells_.rods_in(home);
    // Pairs are those of the smaller row; the first rows are the own ones.
    const auto homes =
        in_cell.first(static_cast<std::size_t>(std::ranges::lower_bound(in_cell, own_) - in_cell.begin()));
    if (are_near_each_other(homes)) return append_pairs_of(home, homes, around, pairs, count);
    for (std::size_t k = 0; k < homes.size(); ++k) append_pairs_of(home, homes.subspan(k, 1), around, pairs, count);
}

/// Not so in the outermost cells of an open direction, which have no end.
bool NeighbourPairs::are_near_each_other(std::span<const std::uint32_t> homes) const {
    return std::all_of(homes.begin(), homes.end(), [&](std::uint32_t i) {
        return squared_norm(rods_.centre[i] - rods_.centre[homes.front()]) < near * near * squared_range_;
    });
}

void NeighbourPairs::append_pairs_of(std::size_t home, std::span<const std::uint32_t> homes, Surroundings& around,
                                     NewPairs& pairs, std::vector<std::size_t>& count) const {
    if (homes.empty()) return;
    const Vec3 origin = rods_.centre[homes.front()];
    gather(home, homes, origin, around);
    around.gap.resize(around.size());
    for (const std::uint32_t i : homes) {
        const std::size_t first = pairs.partners.size();
        const auto single = [](double value) { return static_cast<float>(value); };
        const Vec3 centre = rods_.centre[i] - origin, &axis = rods_.axis[i];
        find_gaps(around.size(), around.x.data(), around.y.data(), around.z.data(), around.axis_x.data(),
                  around.axis_y.data(), around.axis_z.data(), around.half_length.data(), around.radius.data(),
                  {single(centre.x), single(centre.y), single(centre.z), single(axis.x), single(axis.y), single(axis.z),
                   single(0.5 * rods_.length[i]), single(0.5 * rods_.diameter[i])},
                  around.gap.data());
        for (std::size_t k = 0; k < around.size(); ++k) {
            const std::uint32_t j = around.row[k];
            // A rod and its own image are met twice, in opposite images; the one above 0 stands for both.
            if (around.gap[k] >= list_range_ || j < i || (j == i && around.image[k] <= zero_)) continue;
            pairs.partners.push_back({j, around.image[k], in_units(around.gap[k])});
        }
        pairs.i.push_back(i);
        count[i] = pairs.partners.size() - first;
        std::sort(pairs.partners.begin() + static_cast<std::ptrdiff_t>(first), pairs.partners.end(),
                  [](const auto& a, const auto& b) { return std::tie(a.j, a.image) < std::tie(b.j, b.image); });
    }
}

std::uint16_t NeighbourPairs::in_units(float gap) const {
    return static_cast<std::uint16_t>(std::clamp((gap - error_) * units_per_length_, 0.0F, units_per_list_range));
}

/// The rods within range of the box that encloses the centres of `homes`.
void NeighbourPairs::gather(std::size_t home, std::span<const std::uint32_t> homes, const Vec3& origin,
                            Surroundings& around) const {
    Vec3 low, high;
    for (const std::uint32_t i : homes)
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], rods_.centre[i][k] - origin[k]);
            high[k] = std::max(high[k], rods_.centre[i][k] - origin[k]);
        }
    around.clear();
    cells_.visit(home, [&](std::span<const std::uint32_t> others, const Image& image) {
        const Vec3 displacement = box_.displacement(image) - origin;
        const std::uint16_t number = images_.of(image);
        for (const std::uint32_t j : others) {
            if (j < homes.front()) continue;  // all such pairs are those of the other cell
            const Vec3 centre = rods_.centre[j] + displacement;
            double squared = 0.0;
            for (int k = 0; k < 3; ++k) {
                const double outside = std::max({low[k] - centre[k], centre[k] - high[k], 0.0});
                squared += outside * outside;
            }
            if (squared < squared_range_) around.push_back(rods_, j, centre, number);
        }
    });
}

}  // namespace jostle
