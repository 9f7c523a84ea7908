#include "jostle/setup/monte_carlo.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>

#include "jostle/contact/pair_contacts.hpp"
#include "jostle/math/random.hpp"
#include "jostle/math/random_direction.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle {

namespace {

/// The smallest step of a point of a rod, in D. Steps up to D, and half the rod's length, are drawn evenly in their
/// logarithm: then there are some of the right size at any density, and no size has to be found.
constexpr double smallest_step = 0.02;
/// Rods nearer than touching by this part overlap, so that nobody finds an overlap by rounding.
constexpr double rounding = 1e-9;

double longest_of(const Rods& rods) {
    return parallel_max(rods.size(), 0.0, [&](std::size_t i) { return rods.length[i] + rods.diameter[i]; });
}

MonteCarlo::Moves of_all_ranks(const MonteCarlo::Moves& of, const Ranks& ranks) {
    std::array<std::int64_t, 4> numbers{};
    std::ranges::copy(std::array{of.placings, of.placed, of.shifts, of.shifted}, numbers.begin());
    ranks.add_up(numbers);
    const auto sum = [&](std::size_t k) { return static_cast<std::uint64_t>(numbers[k]); };
    return {sum(0), sum(1), sum(2), sum(3)};
}

/// Rods of other domains may be counting it up, too.
void count(std::uint32_t& counter, int change) {
    std::atomic_ref(counter).fetch_add(static_cast<std::uint32_t>(change), std::memory_order_relaxed);
}

}  // namespace

MonteCarlo::Moves& MonteCarlo::Moves::operator+=(const Moves& other) {
    placings += other.placings;
    placed += other.placed;
    shifts += other.shifts;
    shifted += other.shifted;
    return *this;
}

MonteCarlo::MonteCarlo(Rods& rods, const Box& box, std::uint64_t seed, const Ranks& ranks)
    : rods_(rods),
      box_(box),
      seed_(seed),
      ranks_(ranks),
      walls_(walls_of(box)),
      fixed_(grid_of_fixed_rods(box, rods)),
      grid_(rods, box, longest_of(rods)),
      cells_(grid_, box, longest_of(rods)) {
    cells_.fill(rods_);
    count_overlaps();
}

void MonteCarlo::count_overlaps() {
    overlaps_.assign(rods_.size(), 0);
    parallel_for(rods_.size(), [&](std::size_t i) {
        const auto row = static_cast<std::uint32_t>(i);
        std::vector<std::uint32_t> partners;
        find_partners(row, {rods_.centre[i], rods_.axis[i]}, rods_.size(), partners);
        overlaps_[i] = static_cast<std::uint32_t>(partners.size() + own_images(row, rods_.axis[i]));
    });
}

std::size_t MonteCarlo::overlapping_rods() const {
    return static_cast<std::size_t>(
        std::count_if(overlaps_.begin(), overlaps_.end(), [](std::uint32_t overlaps) { return overlaps > 0; }));
}

MonteCarlo::Moves MonteCarlo::sweep(double price, int placings) {
    const auto chance = uniform4({seed_, sweeps_, Stream::monte_carlo, 0}, 0);
    std::array<std::uint64_t, 3> border{};
    for (std::size_t k = 0; k < 3; ++k)
        border[k] = static_cast<std::uint64_t>(chance[k] * static_cast<double>(grid_.cells_along(k)));
    const CellDomains domains(grid_, box_, border);

    std::vector<std::vector<std::uint32_t>> rows(domains.size());
    for (std::size_t i = 0; i < rods_.size(); ++i)
        rows[domains.domain_of(rods_.centre[i])].push_back(static_cast<std::uint32_t>(i));
    const auto count = static_cast<std::size_t>(ranks_.count()), rank = static_cast<std::size_t>(ranks_.rank());
    Moves sum;
    for (int colour = 0; colour < CellDomains::colours; ++colour) {
        std::vector<std::size_t> alike;  // of this rank
        for (std::size_t domain = 0, n = 0; domain < domains.size(); ++domain)
            if (domains.colour()[domain] == colour && n++ % count == rank) alike.push_back(domain);
        std::vector<Changes> changes(alike.size());
        parallel_for_parts(alike.size(), [&](std::size_t k) {
            changes[k] = move_rods_of({domains, alike[k], price, {}, {}}, rows[alike[k]], placings);
        });
        for (const Changes& of_domain : changes) sum += of_domain.moves;
        if (!ranks_.alone()) tell_others(changes);
    }
    ++sweeps_;
    return of_all_ranks(sum, ranks_);
}

/// What has happened on one rank happens on all.
void MonteCarlo::tell_others(std::span<const Changes> changes) {
    std::vector<Moved> moved;
    std::vector<Counted> counted;
    for (const Changes& of_domain : changes) {
        moved.insert(moved.end(), of_domain.moved.begin(), of_domain.moved.end());
        counted.insert(counted.end(), of_domain.counted.begin(), of_domain.counted.end());
    }
    const auto others = [this](const auto& own, auto&& take) {
        const auto of_ranks = ranks_.deal(std::vector(static_cast<std::size_t>(ranks_.count()), own));
        for (std::size_t rank = 0; rank < of_ranks.size(); ++rank)
            if (rank != static_cast<std::size_t>(ranks_.rank()))
                for (const auto& one : of_ranks[rank]) take(one);
    };
    others(moved, [this](const Moved& rod) { put(rod.row, rod.centre, rod.axis); });
    others(counted, [this](const Counted& of) { count(overlaps_[of.row], of.change); });
}

void MonteCarlo::put(std::uint32_t row, const Vec3& centre, const Vec3& axis) {
    cells_.take_out(row, rods_.centre[row]);
    rods_.centre[row] = centre;
    rods_.axis[row] = axis;
    cells_.put_in(row, centre);
}

void MonteCarlo::add_overlaps(std::uint32_t row, std::int32_t change, Site& site) {
    count(overlaps_[row], change);
    if (!ranks_.alone()) site.changes.counted.push_back({row, change});
}

MonteCarlo::Changes MonteCarlo::move_rods_of(Site site, std::span<const std::uint32_t> rows, int placings) {
    Moves& moves = site.changes.moves;
    for (const std::uint32_t row : rows) {
        const RandomKey key{seed_, sweeps_, Stream::monte_carlo, rods_.id[row]};
        std::uint32_t draw = 1;
        for (int k = 0; k < placings; ++k, draw += 2) {
            const double chance = uniform4(key, draw)[3];
            ++moves.placings;
            if (try_out(row, placing(row, draw, site), chance, site)) ++moves.placed;
        }
        const double chance = uniform4(key, draw)[3];
        ++moves.shifts;
        if (try_out(row, shift(row, draw), chance, site)) ++moves.shifted;
    }
    return std::move(site.changes);
}

MonteCarlo::Trial MonteCarlo::placing(std::uint32_t row, std::uint32_t draw, const Site& site) const {
    const RandomKey key{seed_, sweeps_, Stream::monte_carlo, rods_.id[row]};
    const auto place = uniform4(key, draw), direction = uniform4(key, draw + 1);
    return {site.domains.point_in(site.domain, {place[0], place[1], place[2]}),
            random_direction(direction[0], direction[1], box_.dimensions())};
}

// Along any direction, along the axis, or round the middle.
MonteCarlo::Trial MonteCarlo::shift(std::uint32_t row, std::uint32_t draw) const {
    const RandomKey key{seed_, sweeps_, Stream::monte_carlo, rods_.id[row]};
    const auto size = uniform4(key, draw), direction = uniform4(key, draw + 1);
    const double half = 0.5 * rods_.length[row], diameter = rods_.diameter[row];
    const Vec3 anywhere = random_direction(direction[0], direction[1], box_.dimensions());
    const Vec3& axis = rods_.axis[row];
    const auto up_to = [&](double largest) { return largest * std::pow(smallest_step * diameter / largest, size[0]); };
    if (half == 0.0 || size[1] < 1.0 / 3.0) return {rods_.centre[row] + up_to(diameter) * anywhere, axis};
    if (size[1] < 2.0 / 3.0) {
        const double step = up_to(half + 0.5 * diameter);
        return {rods_.centre[row] + (size[2] < 0.5 ? -step : step) * axis, axis};
    }
    const double extent = half + 0.5 * diameter;
    return {rods_.centre[row], normalised(axis + up_to(extent) / extent * anywhere)};
}

/// Whether a rod would leave its domain, or an open box or a wall, or reach into a fixed rod, or get farther away from
/// that.
bool MonteCarlo::leads_out(std::uint32_t row, const Trial& trial, const Site& site) const {
    const Vec3& centre = trial.centre;
    const auto beyond_walls = [&](const Vec3& at, const Vec3& axis) {
        const double length = rods_.length[row], diameter = rods_.diameter[row];
        return std::max({0.0, overlap_with_walls(walls_, box_.walls(), at, axis, length, diameter),
                         overlap_with_fixed_rods(fixed_, at, axis, length, diameter)});
    };
    if ((!walls_.empty() || !fixed_.empty()) &&
        beyond_walls(centre, trial.axis) > beyond_walls(rods_.centre[row], rods_.axis[row]))
        return true;
    for (int k = 0; k < 3; ++k) {
        if (box_.periodic()[static_cast<std::size_t>(k)]) continue;
        const auto outside = [&](double x) { return std::max({0.0, -x, x - box_.edges()[k]}); };
        if (outside(centre[k]) > outside(rods_.centre[row][k])) return true;
    }
    return site.domains.domain_of(centre) != site.domain;
}

bool MonteCarlo::try_out(std::uint32_t row, Trial trial, double uniform, Site& site) {
    Image crossed{0, 0, 0};
    box_.wrap(trial.centre, crossed);
    if (leads_out(row, trial, site)) return false;
    constexpr double many = 1e6;
    const double bought = std::min(many, std::floor(-std::log(uniform) / site.price));
    const std::size_t most = overlaps_[row] + static_cast<std::size_t>(bought);
    const std::size_t own = own_images(row, trial.axis);
    if (own > most || !find_partners(row, trial, most - own, site.partners)) return false;

    for (const std::uint32_t partner : site.partners) add_overlaps(partner, 1, site);
    const auto before = static_cast<std::int32_t>(overlaps_[row]);
    const auto overlaps = static_cast<std::int32_t>(site.partners.size() + own);
    if (before > 0) {
        find_partners(row, {rods_.centre[row], rods_.axis[row]}, rods_.size(), site.partners);
        for (const std::uint32_t partner : site.partners) add_overlaps(partner, -1, site);
    }
    if (overlaps != before) add_overlaps(row, overlaps - before, site);
    put(row, trial.centre, trial.axis);
    if (!ranks_.alone()) site.changes.moved.push_back({row, trial.centre, trial.axis});
    return true;
}

/// Whether a rod would overlap `most` others or fewer; which ones, then.
bool MonteCarlo::find_partners(std::uint32_t row, const Trial& trial, std::size_t most,
                               std::vector<std::uint32_t>& partners) const {
    partners.clear();
    return !cells_.any_near(trial.centre, [&](std::uint32_t other, const Vec3& displacement) {
        if (other == row || !touches(row, other, trial, displacement)) return false;
        partners.push_back(other);
        return partners.size() > most;
    });
}

bool MonteCarlo::touches(std::uint32_t row, std::uint32_t other, const Trial& trial, const Vec3& displacement) const {
    return pair_overlaps({rods_.centre[other] + displacement - trial.centre, trial.axis, rods_.axis[other],
                          0.5 * rods_.length[row], 0.5 * rods_.length[other],
                          0.5 * (1.0 + rounding) * (rods_.diameter[row] + rods_.diameter[other])});
}

/// How many of its own images a rod with this axis overlaps.
std::size_t MonteCarlo::own_images(std::uint32_t row, const Vec3& axis) const {
    const double size = rods_.length[row] + rods_.diameter[row];
    std::array<int, 3> far{};
    for (int k = 0; k < 3; ++k) {
        const auto direction = static_cast<std::size_t>(k);
        far[direction] = box_.periodic()[direction] ? static_cast<int>(std::ceil(size / box_.edges()[k])) - 1 : 0;
    }
    if (far == std::array<int, 3>{0, 0, 0}) return 0;
    std::size_t overlaps = 0;
    const double half = 0.5 * rods_.length[row], diameter = (1.0 - rounding) * rods_.diameter[row];
    for (int x = -far[0]; x <= far[0]; ++x)
        for (int y = -far[1]; y <= far[1]; ++y)
            for (int z = -far[2]; z <= far[2]; ++z)
                if ((x != 0 || y != 0 || z != 0) &&
                    pair_overlaps({box_.displacement({x, y, z}), axis, axis, half, half, diameter}))
                    ++overlaps;
    return overlaps;
}

}  // namespace jostle
