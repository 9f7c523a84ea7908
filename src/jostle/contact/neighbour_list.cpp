#include "jostle/contact/neighbour_list.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "jostle/contact/cell_list.hpp"
#include "jostle/contact/segment_separation.hpp"
#include "jostle/error/input_error.hpp"
#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

constexpr std::size_t cells_per_block = 16;

/// Gaps are computed in float, from places relative to a rod near by. Their error, in units of the range of the search,
/// is far below this; nearly parallel rods have the largest, some 3e-5.
constexpr double float_error = 2e-4;
/// Rods are near by within so many ranges.
constexpr double near = 8.0;

/// Gaps in the list are counted in these; the widest fits 16 bits.
constexpr float units_per_list_range = 65535.0F;

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

/// The images up to `farthest` to both sides of 0, numbered in ascending order.
class ImageNumbers {
public:
    explicit ImageNumbers(const Image& farthest) : farthest_(farthest) {
        double count = 1.0;
        for (const int images : farthest) count *= 2.0 * images + 1.0;
        if (count > 65536.0)
            throw InputError({.key = "box.edges",
                              .problem = "are so short that a rod meets the others in more than 65536 periodic images",
                              .suggestion = "Enlarge the box"});
    }

    std::uint16_t of(const Image& image) const {
        const auto place = [&](std::size_t k) { return image[k] + farthest_[k]; };
        return static_cast<std::uint16_t>((place(0) * (2 * farthest_[1] + 1) + place(1)) * (2 * farthest_[2] + 1) +
                                          place(2));
    }

    std::vector<Image> all() const {
        std::vector<Image> images;
        for (int x = -farthest_[0]; x <= farthest_[0]; ++x)
            for (int y = -farthest_[1]; y <= farthest_[1]; ++y)
                for (int z = -farthest_[2]; z <= farthest_[2]; ++z) images.push_back({x, y, z});
        return images;
    }

private:
    Image farthest_;
};

class Builder {
public:
    Builder(const Rods& rods, const Box& box, const CellList& cells, const ImageNumbers& images, double range,
            double list_range, double units_per_length, std::size_t own)
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

    /// Appends the pairs (i, j >= i, image) with a gap below the range of the list, of all i in a cell; in order for
    /// each i. Fills in how many there are of each.
    void append_pairs_of(std::size_t home, Surroundings& around, NewPairs& pairs,
                         std::vector<std::size_t>& count) const {
        const auto in_cell = cells_.rods_in(home);
        // Pairs are those of the smaller row; the first rows are the own ones.
        const auto homes =
            in_cell.first(static_cast<std::size_t>(std::ranges::lower_bound(in_cell, own_) - in_cell.begin()));
        if (are_near_each_other(homes)) return append_pairs_of(home, homes, around, pairs, count);
        for (std::size_t k = 0; k < homes.size(); ++k) append_pairs_of(home, homes.subspan(k, 1), around, pairs, count);
    }

private:
    /// Not so in the outermost cells of an open direction, which have no end.
    bool are_near_each_other(std::span<const std::uint32_t> homes) const {
        return std::all_of(homes.begin(), homes.end(), [&](std::uint32_t i) {
            return squared_norm(rods_.centre[i] - rods_.centre[homes.front()]) < near * near * squared_range_;
        });
    }

    void append_pairs_of(std::size_t home, std::span<const std::uint32_t> homes, Surroundings& around, NewPairs& pairs,
                         std::vector<std::size_t>& count) const {
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
                      {single(centre.x), single(centre.y), single(centre.z), single(axis.x), single(axis.y),
                       single(axis.z), single(0.5 * rods_.length[i]), single(0.5 * rods_.diameter[i])},
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

    std::uint16_t in_units(float gap) const {
        return static_cast<std::uint16_t>(std::clamp((gap - error_) * units_per_length_, 0.0F, units_per_list_range));
    }

    /// The rods within range of the box that encloses the centres of `homes`.
    void gather(std::size_t home, std::span<const std::uint32_t> homes, const Vec3& origin,
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

    const Rods& rods_;
    std::size_t own_;
    const Box& box_;
    const CellList& cells_;
    const ImageNumbers& images_;
    std::uint16_t zero_;
    double squared_range_;
    float error_, list_range_, units_per_length_;
};

JOSTLE_VECTORISED void extents_less_gaps(std::size_t count, const std::uint32_t* j, const std::uint16_t* gap,
                                         const std::int32_t* extent, std::int32_t* extent_i) {
    for (std::size_t k = 0; k < count; ++k) extent_i[k] += extent[j[k]] - gap[k];
}

}  // namespace

void NeighbourList::widen(const Rods& rods, const Box& box, std::span<const double> ranges,
                          std::span<const BeyondRange> farther) {
    if (extent_within_.empty())
        extent_within_ = extent_;
    else
        extent_ = extent_within_;
    bool is_too_far = built_while_widened_;
    for (const auto& [row, beyond] : farther) {
        extent_[row] += in_units(beyond);
        is_too_far = is_too_far || extent_[row] >= in_units(0.5 * list_range_);  // both rounded up
    }
    if (!is_too_far) return;
    std::vector<double> needed(ranges.begin(), ranges.end());
    for (const auto& [row, beyond] : farther) needed[row] += beyond;
    if (is_of_own_rods_) {
        lacking_range_ = *std::ranges::max_element(needed);
        return;
    }
    built_while_widened_ = refresh(rods, box, needed) || built_while_widened_;
}

// A stretch e moves two centres less than `centre_range_` apart by e centre_range_ against each other at most; and
// farther ones, whose gap was above the range of the list, stay beyond centre_range_ (1 - e).
void NeighbourList::stretch(const Vec3& by) {
    double strain = 0.0;
    for (int k = 0; k < 3; ++k) strain = std::max(strain, std::fabs(by[k] - 1.0));
    squeezed_ += strain * centre_range_;
    parallel_for(reference_.centre.size(), [&](std::size_t i) {
        for (int k = 0; k < 3; ++k) reference_.centre[i][k] *= by[k];
    });
}

// Nearest points m apart, of rods whose centres are m + a apart, where a is at most one length: a strain e brings them
// nearer by e |m_y + a_y| |m_x|/|m| at most, which is e (|m|/2 + length).
void NeighbourList::shear(double strain) {
    squeezed_ += std::fabs(strain) * 0.5 * (centre_range_ + longest_);
    parallel_for(reference_.centre.size(),
                 [&](std::size_t i) { reference_.centre[i].x += strain * reference_.centre[i].y; });
}

bool NeighbourList::refresh(const Rods& rods, const Box& box, std::span<const double> ranges) {
    if (covers(rods, box, ranges) || is_of_own_rods_) return false;
    const double largest_range = parallel_max(rods.size(), 0.0, [&](std::size_t i) { return ranges[i]; });
    build(rods, box, 2.0 * (largest_range + skin_), rods.size());
    parallel_for(rods.size(), [&](std::size_t i) { extent_[i] = in_units(ranges[i]); });
    return true;
}

void NeighbourList::build_of_own(const Rods& rods, const Box& box, double list_range, std::size_t own) {
    is_of_own_rods_ = true;
    crossed_.resize(rods.size());
    build(rods, box, list_range, own);
}

std::vector<std::uint32_t> NeighbourList::rows_with_pairs(std::size_t own) const {
    std::vector<std::uint8_t> has_pair(reference_.centre.size(), 0);
    for (const std::uint32_t j : j_) has_pair[j] = 1;
    std::vector<std::uint32_t> rows;
    for (std::uint32_t row = 0; row < has_pair.size(); ++row)
        if (row < own || has_pair[row] == 1) rows.push_back(row);
    return rows;
}

void NeighbourList::keep(std::span<const std::uint32_t> rows) {
    std::vector<std::uint32_t> new_row(reference_.centre.size(), 0);
    const auto take = [&](auto& values) {
        for (std::size_t k = 0; k < rows.size(); ++k) values[k] = values[rows[k]];
        values.resize(rows.size());
    };
    for (std::uint32_t k = 0; k < rows.size(); ++k) new_row[rows[k]] = k;
    take(reference_.centre);
    take(reference_.axis);
    take(reference_.image);
    take(reference_.length);
    take(crossed_);
    parallel_for(j_.size(), [&](std::size_t pair) { j_[pair] = new_row[j_[pair]]; });
    for (std::size_t k = 0; k < rows.size(); ++k) begin_[k] = begin_[rows[k]];  // rows without pairs between
    begin_.resize(rows.size());
    begin_.push_back(j_.size());
}

/// Fills in d_i + range_i, and returns the largest.
double NeighbourList::find_extents(const Rods& rods, const Box& box, std::span<const double> ranges) {
    return parallel_max(rods.size(), 0.0, [&](std::size_t i) {
        Vec3 moved = rods.centre[i] - reference_.centre[i];
        crossed_[i] = {};
        if (rods.image[i] != reference_.image[i]) {
            Image crossed;
            for (std::size_t k = 0; k < 3; ++k) crossed[k] = rods.image[i][k] - reference_.image[i][k];
            moved += box.displacement(crossed);
            for (std::size_t k = 0; k < 3; ++k) crossed_[i][k] = static_cast<std::int16_t>(crossed[k]);
        }
        // A rod that was turned round is the same body: what counts is how far its points are from any of before.
        const Vec3 &axis = rods.axis[i], &before = reference_.axis[i];
        const Vec3 turned = dot(axis, before) < 0.0 ? axis + before : axis - before;
        const double extent = farthest_displacement(moved, turned, 0.5 * reference_.length[i]) +
                              0.5 * std::max(0.0, rods.length[i] - reference_.length[i]) + 0.5 * squeezed_ + ranges[i];
        extent_[i] = in_units(extent);
        return extent;
    });
}

/// Rounded up; far beyond the range of the list, all are alike.
std::int32_t NeighbourList::in_units(double extent) const {
    return 1 + static_cast<std::int32_t>(std::min(extent * units_per_length_, 4.0 * units_per_list_range));
}

/// The rows that pairs belong to, and by how much their extents exceed their gaps.
void NeighbourList::find_closeness(std::size_t begin, std::size_t end, std::uint32_t* i,
                                   std::int32_t* closeness) const {
    auto next = std::upper_bound(begin_.begin(), begin_.end(), begin);
    for (std::size_t pair = begin; pair < end; ++next) {
        const auto row = static_cast<std::uint32_t>(next - begin_.begin() - 1);
        const std::size_t last = std::min(*next, end);
        std::fill(i + (pair - begin), i + (last - begin), row);
        std::fill(closeness + (pair - begin), closeness + (last - begin), extent_[row]);
        pair = last;
    }
    extents_less_gaps(end - begin, j_.data() + begin, gap_.data() + begin, extent_.data(), closeness);
}

void NeighbourList::build(const Rods& rods, const Box& box, double list_range, std::size_t own) {
    list_range_ = list_range;
    reference_.centre.resize(rods.size());
    reference_.axis.resize(rods.size());
    reference_.image.resize(rods.size());
    reference_.length.resize(rods.size());
    parallel_for(rods.size(), [&](std::size_t i) {
        reference_.centre[i] = rods.centre[i];
        reference_.axis[i] = rods.axis[i];
        reference_.image[i] = rods.image[i];
        reference_.length[i] = rods.length[i];
        crossed_[i] = {};
    });
    const double longest =
        parallel_max(rods.size(), 0.0, [&](std::size_t i) { return rods.length[i] + rods.diameter[i]; });
    const double range = centre_range_ = longest + list_range;
    longest_ = parallel_max(rods.size(), 0.0, [&](std::size_t i) { return rods.length[i]; });
    squeezed_ = 0.0;
    const CellList cells(rods, box, range);
    const ImageNumbers images(cells.farthest_image());
    images_ = images.all();
    units_per_length_ = list_range > 0.0 ? units_per_list_range / list_range : 0.0;
    const Builder builder(rods, box, cells, images, range, list_range, units_per_length_, own);
    std::vector<NewPairs> blocks((cells.size() + cells_per_block - 1) / cells_per_block);
    begin_.assign(rods.size() + 1, 0);
    parallel_for_blocks(cells.size(), cells_per_block, [&](std::size_t block, std::size_t first, std::size_t last) {
        thread_local Surroundings around;
        thread_local NewPairs pairs;
        pairs.i.clear();
        pairs.partners.clear();
        for (std::size_t cell = first; cell < last; ++cell) builder.append_pairs_of(cell, around, pairs, begin_);
        blocks[block] = pairs;  // no larger than need be
    });
    std::exclusive_scan(begin_.begin(), begin_.end(), begin_.begin(), std::size_t{0});
    const std::size_t count = begin_.back();
    j_.resize(count);
    gap_.resize(count);
    image_.resize(count);
    parallel_for_parts(blocks.size(), [&](std::size_t block) {
        const NewPairs& pairs = blocks[block];
        auto partner = pairs.partners.begin();
        for (const std::uint32_t i : pairs.i) {
            for (std::size_t place = begin_[i]; place < begin_[i + 1]; ++place, ++partner) {
                j_[place] = partner->j;
                gap_[place] = partner->gap;
                image_[place] = partner->image;
            }
        }
    });
}

}  // namespace jostle
