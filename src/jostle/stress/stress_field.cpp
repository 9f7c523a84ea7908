#include "jostle/stress/stress_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "jostle/error/input_error.hpp"
#include "jostle/error/refuse.hpp"
#include "jostle/rods/space_filling_order.hpp"
#include "jostle/stress/orientation_stress.hpp"

namespace jostle {

namespace {

constexpr double max_cells = 1e6;

[[noreturn]] void refuse_spacing(double spacing, std::string problem, std::string allowed) {
    refuse("output.field_spacing", fmt::format("{:.6g}", spacing), std::move(problem), std::move(allowed));
}

/// The two cells along one direction that share a point, in which copy of the box each of them is, and the part of the
/// second.
struct Share {
    std::array<std::size_t, 2> cell{};
    std::array<double, 2> copy{};
    double part = 0.0;
};

Share share_of(double place, double cell_edge, std::size_t cells, bool periodic) {
    if (cell_edge == 0.0) return {};  // of a flat box
    const double place_in_cells = place / cell_edge - 0.5, lower = std::floor(place_in_cells);
    const auto count = static_cast<std::int64_t>(cells), first = static_cast<std::int64_t>(lower);
    Share share;
    share.part = place_in_cells - lower;
    for (const std::int64_t side : {0, 1}) {
        const std::int64_t cell =
            periodic ? ((first + side) % count + count) % count : std::clamp<std::int64_t>(first + side, 0, count - 1);
        share.cell[static_cast<std::size_t>(side)] = static_cast<std::size_t>(cell);
        if (periodic) share.copy[static_cast<std::size_t>(side)] = static_cast<double>((first + side - cell) / count);
    }
    return share;
}

}  // namespace

StressField::StressField(const Box& box, double spacing) : box_(box) {
    if (!(spacing > 0.0) || !std::isfinite(spacing)) refuse_spacing(spacing, "is no distance", "greater than 0");
    double total = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double count = std::max(1.0, std::floor(box.edges()[k] / spacing * (1.0 + 1e-12)));
        total *= count;
        if (total > max_cells)
            refuse_spacing(spacing, "makes too many cells", fmt::format("at most {:.0f} cells in all", max_cells));
        cells_[static_cast<std::size_t>(k)] = static_cast<std::size_t>(count);
        edges_[k] = box.edges()[k] / count;
    }
    content_.resize(static_cast<std::size_t>(total));
}

StressField::Content& StressField::Content::add(double weight, const Content& other) {
    number_density += weight * other.number_density;
    collision += weight * other.collision;
    orientation += weight * other.orientation;
    return *this;
}

void StressField::add(const CollisionMoments& moments, const Rods& rods, double kT) {
    steps_ += 1.0;
    // In the order of ids, on one thread: cells are shared, and the same bits for any number of threads are worth more.
    for (const CollisionMoments::Pair& pair : moments.pairs) spread(pair);
    for (const CollisionMoments::Body& body : moments.bodies)
        deposit(body.centre, [&](Content& cell, double weight) { cell.collision += weight * body.geometric; });
    for (const std::uint32_t i : id_order(rods)) {
        const Mat3 orientation =
            orientation_stress_of_rod(rods.axis[i], rods.length[i], rods.diameter[i], kT, box_.dimensions());
        deposit(rods.centre[i], [&](Content& cell, double weight) {
            cell.number_density += weight;
            cell.orientation += weight * orientation;
        });
    }
}

// The weights of a point are a product of three functions that are linear between the planes through the cells' centres
// and edges. Between these planes they are cubic along a line, and two points of Gauss integrate a cubic exactly.
void StressField::spread(const CollisionMoments::Pair& pair) {
    const Vec3 begin = pair.middle - 0.5 * pair.separation;
    breaks_.assign({0.0, 1.0});
    for (int k = 0; k < 3; ++k) {
        if (edges_[k] == 0.0) continue;
        const double half_edge = 0.5 * edges_[k], length = pair.separation[k];
        const auto break_at_planes = [&](double displaced) {
            const double start = begin[k] - displaced, from = start / half_edge, to = (start + length) / half_edge;
            for (double plane = std::ceil(std::min(from, to)); plane < std::max(from, to); plane += 1.0)
                breaks_.push_back(std::clamp((plane * half_edge - start) / length, 0.0, 1.0));
        };
        if (k != 0 || box_.offset() == 0.0) {
            break_at_planes(0.0);
            continue;
        }
        // Across x: of all copies, displaced along it, into which the pair reaches.
        const double ends[2] = {begin.y, begin.y + pair.separation.y}, reach = 0.5 * edges_.y;
        const double lowest = std::floor((std::min(ends[0], ends[1]) - reach) / box_.edges().y);
        const double highest = std::floor((std::max(ends[0], ends[1]) + reach) / box_.edges().y);
        for (double copy = lowest; copy <= highest; copy += 1.0) break_at_planes(copy * box_.offset());
    }
    std::sort(breaks_.begin(), breaks_.end());
    const Mat3 moment = pair.moment();
    for (std::size_t piece = 0; piece + 1 < breaks_.size(); ++piece) {
        const double half = 0.5 * (breaks_[piece + 1] - breaks_[piece]);
        if (half == 0.0) continue;
        for (const double side : {-1.0, 1.0}) {
            const double place = breaks_[piece] + half + side * half * std::numbers::inv_sqrt3;
            deposit(begin + place * pair.separation,
                    [&](Content& cell, double weight) { cell.collision += (weight * half) * moment; });
        }
    }
}

// Calls add(content, weight) for each of the eight cells around a point. Copies of the box above are displaced along x
// where it is sheared.
template <class Add>
void StressField::deposit(const Vec3& point, Add&& add) {
    for (int k = 0; k < 3; ++k)
        if (!box_.periodic()[static_cast<std::size_t>(k)] && !(point[k] >= 0.0 && point[k] <= box_.edges()[k])) {
            add(outside_, 1.0);
            return;
        }
    const auto share = [&](std::size_t k, double place) {
        return share_of(place, edges_[static_cast<int>(k)], cells_[k], box_.periodic()[k]);
    };
    const auto part_of = [](const Share& one, unsigned side) { return side == 1 ? one.part : 1.0 - one.part; };
    const Share along_y = share(1, point.y), along_z = share(2, point.z);
    const std::array<Share, 2> along_x = {share(0, point.x - along_y.copy[0] * box_.offset()),
                                          share(0, point.x - along_y.copy[1] * box_.offset())};
    for (unsigned corner = 0; corner < 8; ++corner) {
        const unsigned x = corner & 1u, y = corner >> 1 & 1u, z = corner >> 2;
        const double weight = part_of(along_x[y], x) * part_of(along_y, y) * part_of(along_z, z);
        add(content_[(along_x[y].cell[x] * cells_[1] + along_y.cell[y]) * cells_[2] + along_z.cell[z]], weight);
    }
}

void StressField::fit(const Box& box) {
    const double before = cell_volume();
    box_ = box;
    for (int k = 0; k < 3; ++k) edges_[k] = box.edges()[k] / static_cast<double>(cells_[static_cast<std::size_t>(k)]);
    const double ratio = cell_volume() / before;
    if (ratio == 1.0) return;
    for (Content& content : content_) content = Content{}.add(ratio, content);
    outside_ = Content{}.add(ratio, outside_);
}

void StressField::clear() {
    steps_ = 0.0;
    std::fill(content_.begin(), content_.end(), Content{});
    outside_ = {};
}

Vec3 StressField::centre(std::size_t cell) const {
    const std::size_t c = cell % cells_[2], b = cell / cells_[2] % cells_[1], a = cell / cells_[2] / cells_[1];
    const auto middle = [](std::size_t k, double edge) { return (static_cast<double>(k) + 0.5) * edge; };
    return {middle(a, edges_.x), middle(b, edges_.y), middle(c, edges_.z)};
}

NamedNumbers StressField::to_named() const {
    NamedNumbers numbers;
    numbers["edges"] = {box_.edges().x, box_.edges().y, box_.edges().z};
    numbers["periodic"].assign(box_.periodic().begin(), box_.periodic().end());
    numbers["cells"].assign(cells_.begin(), cells_.end());
    numbers["steps"] = {steps_};
    auto &density = numbers["number_density"], &collision = numbers["collision"], &orientation = numbers["orientation"];
    const auto append = [&](const Content& content) {  // all that lies outside, then cell by cell
        density.push_back(content.number_density);
        collision.insert(collision.end(), content.collision.m.begin(), content.collision.m.end());
        orientation.insert(orientation.end(), content.orientation.m.begin(), content.orientation.m.end());
    };
    append(outside_);
    for (const Content& cell : content_) append(cell);
    return numbers;
}

StressField StressField::from_named(const NamedNumbers& numbers) {
    const auto require = [](bool sound) {
        if (!sound)
            throw InputError({.key = "checkpoint",
                              .problem = "the sums of the stress field are not whole",
                              .suggestion = "Start anew with --fresh"});
    };
    const auto values = [&](const char* name, std::size_t count) -> const std::vector<double>& {
        const auto found = numbers.find(name);
        require(found != numbers.end() && found->second.size() == count);
        return found->second;
    };
    const auto &edges = values("edges", 3), &periodic = values("periodic", 3), &counts = values("cells", 3);
    const Box box{{edges[0], edges[1], edges[2]}, {periodic[0] != 0.0, periodic[1] != 0.0, periodic[2] != 0.0}};
    StressField field(box, box.longest_edge());  // one cell or few, made anew below
    double total = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double count = counts[static_cast<std::size_t>(k)];
        require(count >= 1.0 && count == std::floor(count) && (total *= count) <= max_cells);
        field.cells_[static_cast<std::size_t>(k)] = static_cast<std::size_t>(count);
        field.edges_[k] = box.edges()[k] / count;
    }
    field.steps_ = values("steps", 1)[0];
    const auto cells = static_cast<std::size_t>(total);
    const auto &density = values("number_density", 1 + cells), &collision = values("collision", 9 * (1 + cells)),
               &orientation = values("orientation", 9 * (1 + cells));
    const auto take = [&](Content& content, std::size_t place) {
        content.number_density = density[place];
        const auto first = static_cast<std::ptrdiff_t>(9 * place);
        std::copy_n(collision.begin() + first, 9, content.collision.m.begin());
        std::copy_n(orientation.begin() + first, 9, content.orientation.m.begin());
    };
    take(field.outside_, 0);
    field.content_.resize(cells);
    for (std::size_t cell = 0; cell < cells; ++cell) take(field.content_[cell], 1 + cell);
    return field;
}

}  // namespace jostle
