#include "jostle/domain/partition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace jostle {

namespace {

/// A cut is sought in so many bins, of which the one that holds it is divided anew, so many times.
constexpr std::size_t bins = 64;
constexpr int refinements = 3;
/// Weights are added up as whole numbers, so that all ranks find the same cut; the largest of all is this many.
constexpr double largest_in_units = 1 << 20;

std::vector<std::int64_t> in_units(const Ranks& ranks, std::span<const float> weight) {
    const double own = weight.empty() ? 0.0 : static_cast<double>(*std::max_element(weight.begin(), weight.end()));
    const double largest = ranks.largest(own);
    std::vector<std::int64_t> whole;
    whole.reserve(weight.size());
    for (const float one : weight)
        whole.push_back(largest > 0.0 ? std::llround(static_cast<double>(one) / largest * largest_in_units) : 0);
    return whole;
}

}  // namespace

/// The parts of one level of the tree, all cut together.
class Partition::Level {
public:
    Level(std::vector<Part> parts, std::vector<Cut>& cuts) : parts_(std::move(parts)), cuts_(cuts) {}

    /// `part_of`: (rods) the number of each rod's part here, or `none` if that is one rank's.
    void cut(const Ranks& ranks, const Box& box, std::span<const Vec3> centre, std::span<const std::int64_t> weight,
             std::span<const std::size_t> part_of) {
        choose_directions(ranks, box, centre, part_of);
        below_.assign(parts_.size(), 0);
        all_.assign(parts_.size(), 0);
        for (std::size_t i = 0; i < centre.size(); ++i)
            if (part_of[i] != none) all_[part_of[i]] += weight[i];
        ranks.add_up(all_);
        for (int k = 0; k < refinements; ++k) refine(ranks, centre, weight, part_of);
        for (std::size_t p = 0; p < parts_.size(); ++p) cuts_[parts_[p].cut].place = 0.5 * (low_[p] + high_[p]);
    }

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

private:
    /// And the stretches of these that cuts are sought in.
    void choose_directions(const Ranks& ranks, const Box& box, std::span<const Vec3> centre,
                           std::span<const std::size_t> part_of) {
        std::vector<double> extents(6 * parts_.size(), -INFINITY);  // of each part: the largest of -x, x, -y, ...
        for (std::size_t i = 0; i < centre.size(); ++i) {
            if (part_of[i] == none) continue;
            double* const of_part = &extents[6 * part_of[i]];
            for (int k = 0; k < 3; ++k) {
                of_part[2 * k] = std::max(of_part[2 * k], -centre[i][k]);
                of_part[2 * k + 1] = std::max(of_part[2 * k + 1], centre[i][k]);
            }
        }
        ranks.largest(extents);
        low_.resize(parts_.size());
        high_.resize(parts_.size());
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const auto stretch = [&](int k) -> std::array<double, 2> {
                const double* const of_part = &extents[6 * p + 2 * static_cast<std::size_t>(k)];
                if (!std::isfinite(of_part[0])) return {0.0, box.edges()[k]};  // a part without rods
                return {-of_part[0], of_part[1]};
            };
            Cut& cut = cuts_[parts_[p].cut];
            if (cut.direction < 0) {
                cut.direction = 0;
                for (int k = 1; k < 3; ++k)
                    if (stretch(k)[1] - stretch(k)[0] > stretch(cut.direction)[1] - stretch(cut.direction)[0])
                        cut.direction = k;
            }
            low_[p] = stretch(cut.direction)[0];
            high_[p] = stretch(cut.direction)[1];
        }
    }

    /// Finds the bin that holds the cut, and makes it the stretch.
    void refine(const Ranks& ranks, std::span<const Vec3> centre, std::span<const std::int64_t> weight,
                std::span<const std::size_t> part_of) {
        std::vector<std::int64_t> in_bin(bins * parts_.size(), 0);
        for (std::size_t i = 0; i < centre.size(); ++i) {
            const std::size_t p = part_of[i];
            if (p == none) continue;
            const double x = centre[i][cuts_[parts_[p].cut].direction];
            if (x < low_[p] || x >= high_[p] || !(high_[p] > low_[p])) continue;
            const double bin = (x - low_[p]) / (high_[p] - low_[p]) * static_cast<double>(bins);
            in_bin[bins * p + std::min(static_cast<std::size_t>(bin), bins - 1)] += weight[i];
        }
        ranks.add_up(in_bin);
        for (std::size_t p = 0; p < parts_.size(); ++p) {
            const double width = (high_[p] - low_[p]) / static_cast<double>(bins);
            const std::int64_t wanted = all_[p] / parts_[p].count * parts_[p].below();
            std::size_t bin = 0;
            while (bin + 1 < bins && below_[p] + in_bin[bins * p + bin] < wanted) below_[p] += in_bin[bins * p + bin++];
            high_[p] = low_[p] + width * static_cast<double>(bin + 1);
            low_[p] += width * static_cast<double>(bin);
        }
    }

    std::vector<Part> parts_;
    std::vector<Cut>& cuts_;
    std::vector<double> low_, high_;         ///< (parts) the cut is between
    std::vector<std::int64_t> below_, all_;  ///< (parts) weight below `low_`, and in all
};

void Partition::balance(const Ranks& ranks, const Box& box, std::span<const Vec3> centre,
                        std::span<const float> weight) {
    count_ = ranks.count();
    const std::vector<std::int64_t> whole = in_units(ranks, weight);
    std::vector<Part> of_rod(centre.size(), Part{0, 0, count_});
    std::vector<Part> parts = {{0, 0, count_}};
    while (true) {
        std::erase_if(parts, [](const Part& part) { return part.count == 1; });
        if (parts.empty()) return;
        const std::size_t max_cuts = parts.back().cut + 1;  // the last of a level has the largest number
        if (cuts_.size() < max_cuts) cuts_.resize(max_cuts);
        std::vector<std::size_t> number(max_cuts, Level::none), part_of(centre.size(), Level::none);
        for (std::size_t p = 0; p < parts.size(); ++p) number[parts[p].cut] = p;
        for (std::size_t i = 0; i < centre.size(); ++i)
            if (of_rod[i].count > 1) part_of[i] = number[of_rod[i].cut];
        Level(parts, cuts_).cut(ranks, box, centre, whole, part_of);
        for (std::size_t i = 0; i < centre.size(); ++i) {
            if (of_rod[i].count == 1) continue;
            const auto& [direction, place] = cuts_[of_rod[i].cut];
            of_rod[i] = centre[i][direction] < place ? of_rod[i].lower() : of_rod[i].upper();
        }
        std::vector<Part> halves;
        for (const Part& part : parts) {
            halves.push_back(part.lower());
            halves.push_back(part.upper());
        }
        parts = std::move(halves);
    }
}

int Partition::rank_of(const Vec3& centre) const {
    Part part{0, 0, count_};
    while (part.count > 1) {
        const auto& [direction, place] = cuts_[part.cut];
        part = centre[direction] < place ? part.lower() : part.upper();
    }
    return part.first;
}

}  // namespace jostle
