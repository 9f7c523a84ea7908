#include "jostle/stress/stress_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/error/input_error.hpp"

namespace jostle {

namespace {

constexpr double most_cells = 1e6;
constexpr std::size_t head_count = 11, each = 10;  // numbers in a checkpoint: of the grid and outside, of a cell

[[noreturn]] void refuse_spacing(double spacing, std::string problem, std::string allowed) {
    throw InputError({.key = "output.field_spacing",
                      .value = fmt::format("{:.6g}", spacing),
                      .problem = std::move(problem),
                      .allowed = std::move(allowed),
                      .suggestion = {},
                      .place = {}});
}

/// The two cells along one direction that share a point, and the part of the second.
struct Share {
    std::size_t first, second;
    double part;
};

Share share_of(double place, double cell_edge, std::size_t cells, bool periodic) {
    const double place_in_cells = place / cell_edge - 0.5, lower = std::floor(place_in_cells);
    const auto count = static_cast<std::int64_t>(cells), first = static_cast<std::int64_t>(lower);
    const auto cell = [&](std::int64_t k) {
        return static_cast<std::size_t>(periodic ? (k % count + count) % count
                                                 : std::clamp<std::int64_t>(k, 0, count - 1));
    };
    return {cell(first), cell(first + 1), place_in_cells - lower};
}

}  // namespace

StressField::StressField(const Box& box, double spacing) : box_(box) {
    if (!(spacing > 0.0) || !std::isfinite(spacing)) refuse_spacing(spacing, "is no distance", "greater than 0");
    double total = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double count = std::max(1.0, std::floor(box.edges[k] / spacing * (1.0 + 1e-12)));
        total *= count;
        if (total > most_cells)
            refuse_spacing(spacing, "makes too many cells", fmt::format("at most {:.0f} cells in all", most_cells));
        cells_[static_cast<std::size_t>(k)] = static_cast<std::size_t>(count);
        edges_[k] = box.edges[k] / count;
    }
    virial_.resize(static_cast<std::size_t>(total));
    count_.resize(virial_.size());
}

void StressField::add(const CollisionMoments& moments, std::span<const Vec3> centres) {
    steps_ += 1.0;
    // In order, on one thread: cells are shared, and the same bits for any number of threads are worth more.
    for (const CollisionMoments::Pair& pair : moments.pairs) spread(pair);
    for (const CollisionMoments::Body& body : moments.bodies)
        deposit(body.centre, body.geometric, virial_, outside_virial_);
    for (const Vec3& centre : centres) deposit(centre, 1.0, count_, outside_count_);
}

// The weights of a point are a product of three functions that are linear between the planes through the cells' centres
// and edges. Between these planes they are cubic along a line, and two points of Gauss integrate a cubic exactly.
void StressField::spread(const CollisionMoments::Pair& pair) {
    const Vec3 begin = pair.middle - 0.5 * pair.separation;
    breaks_.assign({0.0, 1.0});
    for (int k = 0; k < 3; ++k) {
        const double half_edge = 0.5 * edges_[k], length = pair.separation[k];
        const double from = begin[k] / half_edge, to = (begin[k] + length) / half_edge;
        for (double plane = std::ceil(std::min(from, to)); plane < std::max(from, to); plane += 1.0)
            breaks_.push_back(std::clamp((plane * half_edge - begin[k]) / length, 0.0, 1.0));
    }
    std::sort(breaks_.begin(), breaks_.end());
    const Mat3 moment = pair.moment();
    for (std::size_t piece = 0; piece + 1 < breaks_.size(); ++piece) {
        const double half = 0.5 * (breaks_[piece + 1] - breaks_[piece]);
        if (half == 0.0) continue;
        for (const double side : {-1.0, 1.0}) {
            const double place = breaks_[piece] + half + side * half * std::numbers::inv_sqrt3;
            deposit(begin + place * pair.separation, half * moment, virial_, outside_virial_);
        }
    }
}

template <class Value>
void StressField::deposit(const Vec3& point, const Value& value, std::vector<Value>& field, Value& outside) const {
    std::array<Share, 3> share;
    for (std::size_t k = 0; k < 3; ++k) {
        const int direction = static_cast<int>(k);
        const double place = point[direction];
        if (!box_.periodic[k] && !(place >= 0.0 && place <= box_.edges[direction])) {
            outside += value;
            return;
        }
        share[k] = share_of(place, edges_[direction], cells_[k], box_.periodic[k]);
    }
    for (unsigned corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::size_t cell = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const bool second = (corner >> k & 1u) != 0;
            weight *= second ? share[k].part : 1.0 - share[k].part;
            cell = cell * cells_[k] + (second ? share[k].second : share[k].first);
        }
        field[cell] += weight * value;
    }
}

void StressField::clear() {
    steps_ = 0.0;
    std::fill(virial_.begin(), virial_.end(), Mat3{});
    std::fill(count_.begin(), count_.end(), 0.0);
    outside_virial_ = {};
    outside_count_ = 0.0;
}

Vec3 StressField::centre(std::size_t cell) const {
    const std::size_t c = cell % cells_[2], b = cell / cells_[2] % cells_[1], a = cell / cells_[2] / cells_[1];
    const auto middle = [](std::size_t k, double edge) { return (static_cast<double>(k) + 0.5) * edge; };
    return {middle(a, edges_.x), middle(b, edges_.y), middle(c, edges_.z)};
}

std::vector<double> StressField::to_numbers() const {
    std::vector<double> numbers = {box_.edges.x, box_.edges.y, box_.edges.z};
    for (const bool periodic : box_.periodic) numbers.push_back(periodic ? 1.0 : 0.0);
    for (const std::size_t count : cells_) numbers.push_back(static_cast<double>(count));
    numbers.insert(numbers.end(), {steps_, outside_count_});
    numbers.insert(numbers.end(), outside_virial_.m.begin(), outside_virial_.m.end());
    for (std::size_t cell = 0; cell < size(); ++cell) {
        numbers.push_back(count_[cell]);
        numbers.insert(numbers.end(), virial_[cell].m.begin(), virial_[cell].m.end());
    }
    return numbers;
}

StressField StressField::from_numbers(std::span<const double> numbers) {
    const auto require = [](bool sound) {
        if (!sound)
            throw InputError({.key = "checkpoint",
                              .problem = "the sums of the stress field are not whole",
                              .suggestion = "Start anew with --fresh"});
    };
    require(numbers.size() >= head_count + 9);
    Box box{{numbers[0], numbers[1], numbers[2]}, {numbers[3] != 0.0, numbers[4] != 0.0, numbers[5] != 0.0}};
    StressField field(box, std::max({box.edges.x, box.edges.y, box.edges.z}));  // one cell or few, made anew below
    double total = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double count = numbers[6 + static_cast<std::size_t>(k)];
        require(count >= 1.0 && (total *= count) <= most_cells);
        field.cells_[static_cast<std::size_t>(k)] = static_cast<std::size_t>(count);
        field.edges_[k] = box.edges[k] / count;
    }
    const auto cells = static_cast<std::size_t>(total);
    require(numbers.size() == head_count + 9 + each * cells);
    field.steps_ = numbers[9];
    field.outside_count_ = numbers[10];
    const auto matrix = [&](std::size_t first) {
        Mat3 value;
        std::copy_n(numbers.begin() + static_cast<std::ptrdiff_t>(first), 9, value.m.begin());
        return value;
    };
    field.outside_virial_ = matrix(head_count);
    field.virial_.resize(cells);
    field.count_.resize(cells);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        const std::size_t first = head_count + 9 + each * cell;
        field.count_[cell] = numbers[first];
        field.virial_[cell] = matrix(first + 1);
    }
    return field;
}

}  // namespace jostle
