#include "jostle/domain/domain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "jostle/math/mixed_bits.hpp"
#include "jostle/rods/space_filling_order.hpp"

namespace jostle {

namespace {

/// All that a rod carries.
struct CarriedRod {
    Vec3 centre, axis;
    double length, diameter;
    std::uint64_t id;
    Image image;
    CellCycle cycle;
    double speed;
};

CarriedRod carried(const Rods& rods, std::size_t row) {
    return {rods.centre[row],
            rods.axis[row],
            rods.length[row],
            rods.diameter[row],
            rods.id[row],
            rods.image[row],
            rods.cycle.empty() ? CellCycle{} : rods.cycle[row],
            rods.speed.empty() ? 0.0 : rods.speed[row]};
}

/// What of it there is: a rank without rods learns that from the others.
struct Carries {
    bool cycle, speed;
};

void append(Rods& rods, const CarriedRod& rod, const Carries& carries) {
    rods.push_back(rod.id, rod.centre, rod.axis, rod.length, rod.diameter);
    rods.image.back() = rod.image;
    if (carries.cycle) rods.cycle.push_back(rod.cycle);
    if (carries.speed) rods.speed.push_back(rod.speed);
}

Carries carried_by_any(const Ranks& ranks, const Rods& rods) {
    return {ranks.any(!rods.cycle.empty()), ranks.any(!rods.speed.empty())};
}

/// A box along the axes that encloses rods; empty where low > high.
struct Bounds {
    Vec3 low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};

    void enclose(const Bounds& other) {
        for (int k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], other.low[k]);
            high[k] = std::max(high[k], other.high[k]);
        }
    }
};

Bounds bounds_of(const Rods& rods, std::size_t row) {
    Bounds bounds;
    for (int k = 0; k < 3; ++k) {
        const double half = 0.5 * (rods.length[row] * std::fabs(rods.axis[row][k]) + rods.diameter[row]);
        bounds.low[k] = rods.centre[row][k] - half;
        bounds.high[k] = rods.centre[row][k] + half;
    }
    return bounds;
}

/// Whether two come nearer than `range` along direction k, in some periodic image, if a is displaced by `shift`.
bool are_near_along(int k, const Bounds& a, double shift, const Bounds& b, double range, const Box& box) {
    const double edge = box.edges()[k], low = a.low[k] + shift;
    // a displaced by m edges, low + m edge <= high_b + range: the farthest such one is the only one to ask.
    double below = b.high[k] + range - low;
    if (box.periodic()[static_cast<std::size_t>(k)])
        below -= std::floor(below / edge) * edge;  // how far low is then below high_b + range
    else if (below < 0.0)
        return false;
    return b.high[k] + range - below + (a.high[k] - a.low[k]) >= b.low[k] - range;
}

/// Whether two come nearer than `range` along every direction, in some periodic image.
bool are_near(const Bounds& a, const Bounds& b, double range, const Box& box) {
    for (int k = 0; k < 3; ++k)
        if (!(b.low[k] <= b.high[k])) return false;
    if (!are_near_along(2, a, 0.0, b, range, box)) return false;
    if (box.offset() == 0.0)
        return are_near_along(0, a, 0.0, b, range, box) && are_near_along(1, a, 0.0, b, range, box);
    // Copies above are displaced along x: every one that is near along y has to be asked.
    const double edge = box.edges().y;
    const double last = std::floor((b.high.y + range - a.low.y) / edge);
    for (double copy = std::ceil((b.low.y - range - a.high.y) / edge); copy <= last; ++copy)
        if (are_near_along(0, a, copy * box.offset(), b, range, box)) return true;
    return false;
}

}  // namespace

const Domain& Domain::whole() {
    static const Domain domain;
    return domain;
}

void Domain::share_out(Rods& rods) {
    if (!is_shared()) return;
    std::vector<std::uint32_t> own;
    const auto count = static_cast<std::uint32_t>(ranks_.count());
    for (auto row = static_cast<std::uint32_t>(ranks_.rank()); row < rods.size(); row += count) own.push_back(row);
    rods = reordered(rods, own);
    owned_ = rods.size();
}

void Domain::migrate(Rods& rods, const Box& box, bool balance, double work) {
    if (!is_shared()) return;
    rods = own_rods(rods);
    if (balance || !std::exchange(is_cut_, true))
        partition_.balance(ranks_, box, rods.centre, std::vector(rods.size(), static_cast<float>(work)));
    bring_home(rods, box);
}

void Domain::bring_home(Rods& rods, const Box& box) {
    const Carries carries = carried_by_any(ranks_, rods);
    const auto here = static_cast<std::size_t>(ranks_.rank());
    std::vector<std::vector<CarriedRod>> to(static_cast<std::size_t>(ranks_.count()));
    std::vector<std::uint32_t> stay;
    for (std::uint32_t row = 0; row < rods.size(); ++row) {
        const auto rank = static_cast<std::size_t>(partition_.rank_of(rods.centre[row]));
        if (rank == here)
            stay.push_back(row);
        else
            to[rank].push_back(carried(rods, row));
    }
    rods = reordered(rods, stay);
    counts_.arrived = 0;
    for (const auto& arrived : ranks_.deal(to)) {
        for (const CarriedRod& rod : arrived) append(rods, rod, carries);
        counts_.arrived += arrived.size();
    }
    rods = reordered(rods, space_filling_order(rods, box));
    owned_ = counts_.owned = rods.size();
}

void Domain::fetch_ghosts(Rods& rods, const Box& box, double range, std::span<const Wanted> wanted) {
    if (!is_shared()) return;
    const Carries carries = carried_by_any(ranks_, rods);
    Bounds own;
    std::vector<Bounds> bounds(owned_);
    for (std::size_t row = 0; row < owned_; ++row) own.enclose(bounds[row] = bounds_of(rods, row));
    const std::vector<Bounds> of_rank = ranks_.gather(own);
    std::vector<std::vector<CarriedRod>> to(of_rank.size());
    std::vector<std::vector<std::uint32_t>> sent(of_rank.size());
    for (const Wanted& rod : wanted) sent[static_cast<std::size_t>(rod.rank)].push_back(rod.row);
    for (std::size_t q = 0; q < of_rank.size(); ++q) {
        if (q == static_cast<std::size_t>(ranks_.rank()) || owned_ == 0) continue;
        std::vector<std::uint32_t>& rows = sent[q];
        if (are_near(own, of_rank[q], range, box))
            for (std::uint32_t row = 0; row < owned_; ++row)
                if (are_near(bounds[row], of_rank[q], range, box)) rows.push_back(row);
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
        for (const std::uint32_t row : rows) to[q].push_back(carried(rods, row));
    }
    const auto arrived = ranks_.deal(to);
    std::vector<std::uint32_t> from;
    for (std::size_t p = 0; p < arrived.size(); ++p) {
        for (const CarriedRod& rod : arrived[p]) append(rods, rod, carries);
        from.insert(from.end(), arrived[p].size(), static_cast<std::uint32_t>(p));
    }
    counts_.near = from.size();
    note_ghosts(from, sent);
}

/// `from`: (ghosts) the rank of each, ascending; `sent`: (ranks) own rows.
void Domain::note_ghosts(std::span<const std::uint32_t> from, const std::vector<std::vector<std::uint32_t>>& sent) {
    exchanges_.clear();
    peers_.clear();
    peer_of_ghost_.clear();
    counts_.ghosts = from.size();
    std::size_t ghost = 0;
    for (std::uint32_t rank = 0; rank < sent.size(); ++rank) {
        const std::size_t first = ghost;
        while (ghost < from.size() && from[ghost] == rank) ++ghost;
        if (ghost == first && sent[rank].empty()) continue;
        peer_of_ghost_.resize(ghost, static_cast<std::uint32_t>(peers_.size()));
        peers_.push_back({static_cast<int>(rank), sent[rank], static_cast<std::uint32_t>(owned_ + first),
                          static_cast<std::uint32_t>(ghost - first)});
    }
}

void Domain::keep(Rods& rods, std::span<const std::uint32_t> rows) {
    if (!is_shared()) return;
    // Owners are told by the places that ghosts have in what they have sent.
    std::vector<std::vector<std::uint32_t>> kept(static_cast<std::size_t>(ranks_.count()));
    std::vector<std::uint32_t> from;
    for (const std::uint32_t row : rows.subspan(owned_)) {
        const Peer& peer = peers_[peer_of(row)];
        kept[static_cast<std::size_t>(peer.rank)].push_back(row - peer.first_ghost);
        from.push_back(static_cast<std::uint32_t>(peer.rank));
    }
    const auto wanted = ranks_.deal(kept);
    std::vector<std::vector<std::uint32_t>> sent(wanted.size());
    for (const Peer& peer : peers_) {
        const auto rank = static_cast<std::size_t>(peer.rank);
        for (const std::uint32_t place : wanted[rank]) sent[rank].push_back(peer.sent[place]);
    }
    rods = reordered(rods, rows);
    note_ghosts(from, sent);
}

Rods Domain::own_rods(const Rods& rods) const {
    std::vector<std::uint32_t> own(owned_of(rods.size()));
    std::iota(own.begin(), own.end(), 0U);
    return reordered(rods, own);
}

void Domain::replace(Rods& rods, Rods own) {
    rods = std::move(own);
    owned_ = rods.size();
    note_ghosts({}, {});
}

Rods Domain::all_rods(const Rods& rods) const {
    if (!is_shared()) return rods;
    const Carries carries = carried_by_any(ranks_, rods);
    std::vector<CarriedRod> own;
    for (std::size_t row = 0; row < owned_; ++row) own.push_back(carried(rods, row));
    Rods all;
    all.founder_bits = rods.founder_bits;
    for (const CarriedRod& rod : ranks_.gather_at_all(std::move(own))) append(all, rod, carries);
    return all;
}

// Every rod is known to one rank that follows from its id, which the others ask.
std::vector<int> Domain::ranks_of(const Rods& rods, std::span<const std::uint64_t> ids) const {
    const auto count = static_cast<std::size_t>(ranks_.count());
    const auto asked_of = [&](std::uint64_t id) { return mixed_bits(id) % count; };
    std::vector<std::vector<std::uint64_t>> known(count), asked(count);
    for (std::size_t row = 0; row < owned_of(rods.size()); ++row) known[asked_of(rods.id[row])].push_back(rods.id[row]);
    for (const std::uint64_t id : ids) asked[asked_of(id)].push_back(id);
    std::unordered_map<std::uint64_t, int> rank_of;
    const auto told = ranks_.deal(known);
    for (std::size_t rank = 0; rank < count; ++rank)
        for (const std::uint64_t id : told[rank]) rank_of[id] = static_cast<int>(rank);
    std::vector<std::vector<int>> answers(count);
    const auto questions = ranks_.deal(asked);
    for (std::size_t rank = 0; rank < count; ++rank)
        for (const std::uint64_t id : questions[rank]) {
            const auto found = rank_of.find(id);
            answers[rank].push_back(found == rank_of.end() ? nobody : found->second);
        }
    const auto arrived = ranks_.deal(answers);
    std::vector<std::size_t> next(count, 0);
    std::vector<int> ranks;
    for (const std::uint64_t id : ids) ranks.push_back(arrived[asked_of(id)][next[asked_of(id)]++]);
    return ranks;
}

Exchange& Domain::exchange_of(std::size_t bytes) const {
    auto& exchange = exchanges_[bytes];
    if (!exchange) {
        std::vector<Exchange::Peer> peers;
        for (const Peer& peer : peers_) peers.push_back({peer.rank, bytes * peer.sent.size(), bytes * peer.ghosts});
        exchange = ranks_.exchange(std::move(peers));
    }
    return *exchange;
}

}  // namespace jostle
