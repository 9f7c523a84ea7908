#include "jostle/setup/monte_carlo.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

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

MonteCarlo::MonteCarlo(Rods& rods, const Box& box, std::uint64_t seed)
    : rods_(rods),
      box_(box),
      seed_(seed),
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
    std::vector<Moves> moves(domains.size());
    for (int colour = 0; colour < CellDomains::colours; ++colour) {
        std::vector<std::size_t> alike;
        for (std::size_t domain = 0; domain < domains.size(); ++domain)
            if (domains.colour()[domain] == colour) alike.push_back(domain);
        parallel_for_parts(alike.size(), [&](std::size_t k) {
            const std::size_t domain = alike[k];
            moves[domain] = move_rods_of({domains, domain, price, {}, {}}, rows[domain], placings);
        });
    }
    ++sweeps_;
    Moves sum;
    for (const Moves& of_domain : moves) sum += of_domain;
    return sum;
}

MonteCarlo::Moves MonteCarlo::move_rods_of(Site site, std::span<const std::uint32_t> rows, int placings) {
    for (const std::uint32_t row : rows) {
        const RandomKey key{seed_, sweeps_, Stream::monte_carlo, rods_.id[row]};
        std::uint32_t draw = 1;
        for (int k = 0; k < placings; ++k, draw += 2) {
            const double chance = uniform4(key, draw)[3];
            ++site.moves.placings;
            if (try_out(row, placing(row, draw, site), chance, site)) ++site.moves.placed;
        }
        const double chance = uniform4(key, draw)[3];
        ++site.moves.shifts;
        if (try_out(row, shift(row, draw), chance, site)) ++site.moves.shifted;
    }
    return site.moves;
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

    for (const std::uint32_t partner : site.partners) count(overlaps_[partner], 1);
    const std::size_t overlaps = site.partners.size() + own;
    if (overlaps_[row] > 0) {
        find_partners(row, {rods_.centre[row], rods_.axis[row]}, rods_.size(), site.partners);
        for (const std::uint32_t partner : site.partners) count(overlaps_[partner], -1);
    }
    overlaps_[row] = static_cast<std::uint32_t>(overlaps);
    cells_.take_out(row, rods_.centre[row]);
    rods_.centre[row] = trial.centre;
    rods_.axis[row] = trial.axis;
    cells_.put_in(row, trial.centre);
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
