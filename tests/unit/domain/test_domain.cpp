// Which rods a rank has and knows: none is lost or doubled where they change their rank, all that they carry goes with
// them, and the ghosts of a rank are all rods near to its own, rods longer than its part among them.

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <span>
#include <stdexcept>

#include "jostle/domain/domain.hpp"
#include "jostle/domain/homes.hpp"
#include "jostle/domain/rods_in_order.hpp"
#include "jostle/parallel/thread_ranks.hpp"

using namespace jostle;

namespace {

Rods random_rods(std::size_t count, const Vec3& edges, double longest, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(0.0, 1.0);
    std::normal_distribution<double> normal;
    Rods rods;
    for (std::size_t k = 0; k < count; ++k) {
        const double x = any(random), y = any(random), z = any(random), length = longest * any(random);
        const double a = normal(random), b = normal(random), c = normal(random);
        const Vec3 axis{a, b, c};
        rods.push_back(1000 - k, {edges.x * x, edges.y * y, edges.z * z}, (1.0 / norm(axis)) * axis, length,
                       0.5 + any(random));
        rods.image.back() = {static_cast<int>(k), -1, 2};
        rods.speed.push_back(any(random));
    }
    return rods;
}

/// An upper bound of the gap of two rods in the nearest image: of points along them.
double gap_at_most(const Rods& rods, std::size_t i, std::size_t j, const Box& box) {
    constexpr int points = 8;
    double least = INFINITY;
    for (int a = -points; a <= points; ++a)
        for (int b = -points; b <= points; ++b) {
            Vec3 between = rods.centre[j] + (0.5 * rods.length[j] * b / points) * rods.axis[j] - rods.centre[i] -
                           (0.5 * rods.length[i] * a / points) * rods.axis[i];
            for (int k = 0; k < 3; ++k)
                if (box.periodic()[static_cast<std::size_t>(k)])
                    between[k] = std::remainder(between[k], box.edges()[k]);
            least = std::min(least, norm(between));
        }
    return least - 0.5 * (rods.diameter[i] + rods.diameter[j]);
}

void require(bool holds, const char* what) {
    if (!holds) throw std::logic_error(what);
}

bool is_same_rod(const Rods& a, std::size_t i, const Rods& b, std::size_t j) {
    return a.id[i] == b.id[j] && a.centre[i] == b.centre[j] && a.axis[i] == b.axis[j] && a.length[i] == b.length[j] &&
           a.diameter[i] == b.diameter[j] && a.image[i] == b.image[j] && a.speed[i] == b.speed[j];
}

/// Throws unless the rods of all ranks are `all`, each once, and this rank knows all near to its own.
void require_sound(const Domain& domain, const Rods& rods, const Rods& all, const Box& box, double range) {
    std::map<std::uint64_t, std::size_t> row_of;
    for (std::size_t row = 0; row < all.size(); ++row) row_of[all.id[row]] = row;
    std::set<std::uint64_t> known;
    const std::size_t owned = domain.owned_of(rods.size());
    for (std::size_t row = 0; row < rods.size(); ++row) {
        require(known.insert(rods.id[row]).second, "a rod is known twice");
        require(is_same_rod(rods, row, all, row_of.at(rods.id[row])), "a rod has changed");
    }
    require(domain.ranks().sum(static_cast<std::int64_t>(owned)) == static_cast<std::int64_t>(all.size()),
            "rods are lost");
    for (std::size_t row = 0; row < owned; ++row)
        for (std::size_t other = 0; other < all.size(); ++other)
            if (!known.contains(all.id[other]))
                require(gap_at_most(all, row_of.at(rods.id[row]), other, box) >= range, "a rod near by is not known");
}

}  // namespace

TEST_CASE("one process has all rods, and no ghosts") {
    Rods rods = random_rods(5, {10, 10, 10}, 3.0, 1);
    const auto ids = rods.id;
    Domain domain;
    domain.share_out(rods);
    domain.gather(rods, Box({10, 10, 10}), 2.0, true);
    CHECK(rods.id == ids);
    CHECK(!domain.is_shared());
    CHECK(domain.owned_of(rods.size()) == 5);
    CHECK(domain.owns(4));
}

TEST_CASE("no rod is lost where rods change their rank, and ghosts are all that are near") {
    struct Case {
        Vec3 edges;
        std::array<bool, 3> periodic;
        std::size_t rods;
        double longest, range;
    };
    const Case cases[] = {
        {{20, 20, 20}, {true, true, true}, 300, 3.0, 1.5},
        {{30, 6, 6}, {true, true, true}, 200, 20.0, 1.0},  // longer than a part, and than the box
        {{20, 20, 20}, {false, true, false}, 200, 4.0, 2.0},
        {{20, 20, 20}, {true, true, true}, 3, 3.0, 1.5},  // ranks without rods
        {{20, 20, 20}, {true, true, true}, 0, 3.0, 1.5},
    };
    for (const Case& now : cases)
        for (const int count : {1, 2, 3, 5, 8}) {
            CAPTURE(now.edges.x);
            CAPTURE(now.rods);
            CAPTURE(count);
            const Box box(now.edges, now.periodic);
            CHECK_NOTHROW(run_as_ranks(count, [&](const Ranks& ranks) {
                Rods all = random_rods(now.rods, now.edges, now.longest, 2), rods = all;
                Domain domain(ranks);
                domain.share_out(rods);
                domain.gather(rods, box, now.range, true);
                require_sound(domain, rods, all, box, now.range);
                // Rods move, ghosts as their owners have them, and are shared out anew.
                std::mt19937 random(7);
                std::uniform_real_distribution<double> any(0.0, 1.0);
                for (int k = 0; k < 3; ++k) {
                    std::map<std::uint64_t, Vec3> moved;
                    for (std::size_t row = 0; row < all.size(); ++row) {
                        const double x = any(random), y = any(random), z = any(random);
                        all.centre[row] += Vec3{x, y, z};
                        box.wrap(all.centre[row], all.image[row]);
                        moved[all.id[row]] = all.centre[row];
                    }
                    std::vector<Image> images = all.image;
                    for (std::size_t row = 0; row < rods.size(); ++row) {
                        rods.centre[row] = moved[rods.id[row]];
                        rods.image[row] = all.image[1000 - rods.id[row]];
                    }
                    domain.gather(rods, box, now.range, k == 1);
                    require_sound(domain, rods, all, box, now.range);
                }
            }));
        }
}

TEST_CASE("the first rank gathers all rods in the order of ids, slice by slice") {
    const Box box({20, 20, 20});
    Rods all = random_rods(300, box.edges(), 3.0, 4);
    for (std::uint64_t& id : all.id) id <<= 40;
    CHECK_NOTHROW(run_as_ranks(4, [&](const Ranks& ranks) {
        Rods rods = all;
        Domain domain(ranks);
        domain.share_out(rods);
        domain.gather(rods, box, 1.0, true);
        const Rods whole = RodsInOrder(rods, domain, RodsInOrder::TakenBy::first_rank, 50).whole();
        require(whole.size() == (ranks.rank() == 0 ? all.size() : 0), "all are at the first rank, and nowhere else");
        require(std::is_sorted(whole.id.begin(), whole.id.end()), "they are in the order of ids");
        for (std::size_t row = 0; row < whole.size(); ++row)  // whose ids descend
            require(is_same_rod(whole, row, all, all.size() - 1 - row), "a rod has changed");
    }));
}

TEST_CASE("all ranks take slices of all rods in the order of ids, in turns") {
    const Rods all = random_rods(300, {20, 20, 20}, 3.0, 4);
    CHECK_NOTHROW(run_as_ranks(4, [&](const Ranks& ranks) {
        Rods rods = all;
        Domain domain(ranks);
        domain.share_out(rods);
        const RodsInOrder in_order(rods, domain, RodsInOrder::TakenBy::all_ranks, 50);
        std::size_t taken = 0;
        in_order.column([](const Rods& of, std::uint32_t row) { return of.id[row]; },
                        [&](std::size_t before, std::span<const std::uint64_t> ids) {
                            for (std::size_t k = 0; k < ids.size(); ++k)  // ids descend from 1000
                                require(ids[k] == 1000 - all.size() + 1 + before + k, "a rod is at another place");
                            taken += ids.size();
                        });
        require(taken > 20 && taken < 200, "a rank takes too few rods, or too many");
        require(ranks.sum(static_cast<std::int64_t>(taken)) == 300, "a rod is taken twice, or by nobody");
        try {
            in_order.whole();
        } catch (const std::logic_error&) {
            return;
        }
        throw std::runtime_error("the first rank does not have them all");
    }));
}

TEST_CASE("any rank is told which rank has a rod, and a rod that is wanted comes however far it is") {
    const Box box({200, 20, 20});
    CHECK_NOTHROW(run_as_ranks(4, [&](const Ranks& ranks) {
        Rods rods = random_rods(300, box.edges(), 3.0, 4);
        std::vector<std::uint64_t> ids = rods.id;
        const std::uint64_t none = *std::max_element(ids.begin(), ids.end()) + 1;
        ids.push_back(none);
        Domain domain(ranks);
        domain.share_out(rods);
        domain.migrate(rods, box, true);
        const std::vector<int> rank_of = domain.ranks_of(rods, ids);
        for (std::size_t k = 0; k < ids.size(); ++k) {
            const bool is_here = std::find(rods.id.begin(), rods.id.end(), ids[k]) != rods.id.end();
            require((rank_of[k] == ranks.rank()) == is_here, "the rank of a rod is another");
            require((rank_of[k] == Domain::nobody) == (ids[k] == none), "a rod is lost, or made up");
        }
        std::vector<Domain::Wanted> wanted;
        for (int rank = 0; rank < 4; ++rank)
            if (rank != ranks.rank()) wanted.push_back({0, rank});
        domain.fetch_ghosts(rods, box, 0.0, wanted);
        std::set<int> known;
        for (auto row = static_cast<std::uint32_t>(domain.owned_of(rods.size())); row < rods.size(); ++row)
            known.insert(domain.rank_of_peer(domain.peer_of(row)));
        require(known.size() == 3, "a rod that is wanted has not come");
    }));
}

TEST_CASE("cuts give each rank the same work: where rods cost more it has fewer") {
    const Box box({40, 20, 20});
    CHECK_NOTHROW(run_as_ranks(2, [&](const Ranks& ranks) {
        Rods rods = random_rods(2000, box.edges(), 1.0, 4);
        Domain domain(ranks);
        domain.share_out(rods);
        domain.migrate(rods, box, true);
        require(std::abs(static_cast<int>(rods.size()) - 1000) < 20, "the same number each");
        domain.migrate(rods, box, true, ranks.rank() == 0 ? 3.0 : 1.0);  // 4000 in all: 667 rods of the first rank
        require(std::abs(static_cast<int>(rods.size()) - (ranks.rank() == 0 ? 667 : 1333)) < 20, "the same work each");
    }));
}

TEST_CASE("every id has one home, and what belongs to it is brought there") {
    struct Item {
        std::uint64_t id;
        double value;
    };
    for (const std::uint64_t ids : {0, 1, 3, 7, 100})
        for (const int count : {1, 2, 4, 5}) {
            CAPTURE(ids);
            CAPTURE(count);
            CHECK_NOTHROW(run_as_ranks(count, [&](const Ranks& ranks) {
                const Homes homes(ranks, ids);
                std::vector<Item> own;
                for (std::uint64_t id = 0; id < ids; ++id)
                    if (id * id % static_cast<std::uint64_t>(count) == static_cast<std::uint64_t>(ranks.rank()))
                        own.push_back({id, 0.5 * static_cast<double>(id)});
                const auto [begin, end] = homes.range();
                std::set<std::uint64_t> here;
                for (const Item& item : homes.bring(std::span<const Item>(own))) {
                    require(item.id >= begin && item.id < end, "it is at home elsewhere");
                    require(item.value == 0.5 * static_cast<double>(item.id), "it is another's");
                    here.insert(item.id);
                }
                require(here.size() == end - begin, "some are missing");
                require(ranks.sum(static_cast<std::int64_t>(end - begin)) == static_cast<std::int64_t>(ids),
                        "homes are not all of them");
            }));
        }
}

TEST_CASE("values of ghosts come from their owners, of those that were kept, in their order") {
    const Box box({20, 20, 20});
    CHECK_NOTHROW(run_as_ranks(5, [&](const Ranks& ranks) {
        Rods rods = random_rods(300, box.edges(), 3.0, 4);
        Domain domain(ranks);
        domain.share_out(rods);
        domain.gather(rods, box, 1.0, true);
        const auto owned = static_cast<std::uint32_t>(domain.owned_of(rods.size()));
        require(domain.counts().near == rods.size() - owned, "ghosts are counted");
        std::vector<std::uint32_t> rows;
        for (std::uint32_t row = 0; row < rods.size(); ++row)
            if (row < owned || rods.id[row] % 3 != 0) rows.push_back(row);
        domain.keep(rods, rows);
        require(rods.size() == rows.size() && domain.counts().ghosts == rows.size() - owned, "rods are left out");
        for (int k = 0; k < 3; ++k) {
            std::vector<double> value(rods.size(), -1.0);
            for (std::uint32_t row = 0; row < owned; ++row) value[row] = static_cast<double>(rods.id[row]) + k;
            domain.refresh<double>([&](std::uint32_t row) -> double& { return value[row]; });
            std::vector<Vec3> centre(rods.size());
            for (std::uint32_t row = 0; row < owned; ++row) centre[row] = rods.centre[row];
            domain.refresh<Vec3>([&](std::uint32_t row) -> Vec3& { return centre[row]; });
            for (std::uint32_t row = 0; row < rods.size(); ++row) {
                require(value[row] == static_cast<double>(rods.id[row]) + k, "a value is another rod's");
                require(centre[row] == rods.centre[row], "a centre is another rod's");
            }
        }
        for (std::uint32_t row = owned; row < rods.size(); ++row)
            require(domain.rank_of_peer(domain.peer_of(row)) != ranks.rank(), "a ghost is another rank's");
    }));
}
