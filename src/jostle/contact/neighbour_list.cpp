#include "jostle/contact/neighbour_list.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

#include "jostle/contact/cell_list.hpp"
#include "jostle/contact/neighbour_pairs.hpp"
#include "jostle/math/vectorised.hpp"

namespace jostle {

namespace {

constexpr std::size_t cells_per_block = 16;

/// Marks the pairs whose rods' extents are not less than their gap.
JOSTLE_VECTORISED void mark_close(std::size_t count, const std::uint32_t* i, const std::uint32_t* j,
                                  const std::uint16_t* gap, const std::int32_t* extent, std::uint8_t* marks) {
    for (std::size_t k = 0; k < count; ++k) marks[k] = extent[i[k]] + extent[j[k]] >= gap[k] ? 1 : 0;
}

/// Takes the marks off those.
JOSTLE_VECTORISED void unmark_close(std::size_t count, const std::uint32_t* i, const std::uint32_t* j,
                                    const std::uint16_t* gap, const std::int32_t* extent, std::uint8_t* marks) {
    for (std::size_t k = 0; k < count; ++k) marks[k] &= extent[i[k]] + extent[j[k]] < gap[k] ? 1 : 0;
}

}  // namespace

bool NeighbourList::widen(std::span<const Widening> farther) {
    if (built_while_widened_) return false;
    former_extent_ = extent_;
    bool reaches = true;
    for (const auto& [row, by] : farther) {
        extent_[row] += in_units(by);
        reaches = reaches && extent_[row] < farthest_extent();
    }
    is_widened_ = true;
    if (partner_begin_.empty()) list_partners();
    return reaches;
}

void NeighbourList::widen_to(const Rods& rods, const Box& box, std::span<const double> ranges) {
    if (is_of_own_rods_) {
        lacking_range_ = *std::ranges::max_element(ranges);
    } else if (refresh(rods, box, ranges)) {
        built_while_widened_ = true;
        is_widened_ = false;
    }
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
void NeighbourList::shear(double strain, std::int32_t copies) {
    squeezed_ += std::fabs(strain) * 0.5 * (centre_range_ + longest_);
    parallel_for(reference_.centre.size(),
                 [&](std::size_t i) { reference_.centre[i].x += strain * reference_.centre[i].y; });
    if (copies != 0) renumber_copies(copies);
}

/// Pairs of the same two rods stay in the order of their images.
void NeighbourList::renumber_copies(std::int32_t copies) {
    for (Image& image : reference_.image) image[0] += copies * image[1];
    for (Image& image : images_) image[0] += copies * image[1];
    parallel_for(reference_.image.size(), [&](std::size_t i) {
        for (std::size_t first = begin_[i], last = first; first < begin_[i + 1]; first = last) {
            while (last < begin_[i + 1] && j_[last] == j_[first]) ++last;
            if (last == first + 1) continue;
            std::vector<std::pair<std::uint16_t, std::uint16_t>> same_rods;
            for (std::size_t pair = first; pair < last; ++pair) same_rods.emplace_back(image_[pair], gap_[pair]);
            std::sort(same_rods.begin(), same_rods.end(),
                      [&](const auto& a, const auto& b) { return images_[a.first] < images_[b.first]; });
            for (std::size_t pair = first; pair < last; ++pair)
                std::tie(image_[pair], gap_[pair]) = same_rods[pair - first];
        }
    });
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

/// Their numbers in the block.
std::span<const std::uint16_t> NeighbourList::find_close_pairs(std::size_t block, InBlock& pairs) const {
    const std::size_t begin = block * block_size, end = std::min(begin + block_size, size());
    auto next = std::upper_bound(begin_.begin(), begin_.end(), begin);
    for (std::size_t pair = begin; pair < end; ++next) {
        const std::size_t last = std::min(*next, end);
        std::fill(pairs.i.data() + (pair - begin), pairs.i.data() + (last - begin),
                  static_cast<std::uint32_t>(next - begin_.begin() - 1));
        pair = last;
    }
    const auto mark = [&](auto&& marking, const std::vector<std::int32_t>& extent) {
        marking(end - begin, pairs.i.data(), j_.data() + begin, gap_.data() + begin, extent.data(),
                pairs.close.marks());
    };
    mark(mark_close, extent_);
    if (is_widened_) mark(unmark_close, former_extent_);
    return pairs.close.find(end - begin);
}

/// In no order of those of a row.
void NeighbourList::list_partners() {
    const auto place = [this](std::uint32_t row) { return std::atomic_ref(partner_begin_[row]); };
    partner_begin_.assign(begin_.size(), 0);
    parallel_for(size(), [&](std::size_t pair) { place(j_[pair]).fetch_add(1, std::memory_order_relaxed); });
    std::inclusive_scan(partner_begin_.begin(), partner_begin_.end(), partner_begin_.begin());
    partner_of_.resize(size());
    parallel_for(begin_.size() - 1, [&](std::size_t i) {
        for (std::size_t pair = begin_[i]; pair < begin_[i + 1]; ++pair)
            partner_of_[place(j_[pair]).fetch_sub(1, std::memory_order_relaxed) - 1] = {
                static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(pair - begin_[i])};
    });
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
    partner_begin_.clear();
    const CellList cells(rods, box, range);
    const ImageNumbers images(cells.farthest_image());
    images_ = images.all();
    units_per_length_ = list_range > 0.0 ? units_per_list_range / list_range : 0.0;
    const NeighbourPairs finder(rods, box, cells, images, range, list_range, units_per_length_, own);
    std::vector<NewPairs> blocks((cells.size() + cells_per_block - 1) / cells_per_block);
    begin_.assign(rods.size() + 1, 0);
    parallel_for_blocks(cells.size(), cells_per_block, [&](std::size_t block, std::size_t first, std::size_t last) {
        thread_local Surroundings around;
        thread_local NewPairs pairs;
        pairs.i.clear();
        pairs.partners.clear();
        for (std::size_t cell = first; cell < last; ++cell) finder.append_pairs_of(cell, around, pairs, begin_);
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
