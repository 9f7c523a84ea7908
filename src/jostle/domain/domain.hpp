#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <span>
#include <type_traits>
#include <vector>

#include "jostle/domain/partition.hpp"
#include "jostle/parallel/ranks.hpp"
#include "jostle/rods/box.hpp"
#include "jostle/rods/rods.hpp"

namespace jostle {

/// Which rods belong to this rank, and which rods of other ranks it has to know.
///
/// The first rows of its rods are its own. Ghosts follow: rods of other ranks that are near to its own, one row each,
/// with the centre and image that their owner has, so that all numbers that two ranks work out about a rod are worked
/// out of the same bits. A ghost is moved by every rank that has it. Rods change their rank, and ghosts are chosen,
/// where neighbours are listed anew, and only then.
class Domain {
public:
    /// Of one process: all rods are its own.
    Domain() = default;
    explicit Domain(const Ranks& ranks) : ranks_(ranks), owned_(0) {}

    /// What everything belongs to where nothing is shared.
    static const Domain& whole();

    const Ranks& ranks() const { return ranks_; }
    /// Whether other ranks have rods, too.
    bool is_shared() const { return !ranks_.alone(); }

    bool owns(std::uint32_t row) const { return row < owned_; }
    /// How many of so many rows.
    std::size_t owned_of(std::size_t rows) const { return rows < owned_ ? rows : owned_; }

    /// Leaves to this rank its share of rods that every rank has: every so-manieth, wherever it is.
    void share_out(Rods& rods);

    /// Brings every rod to the rank whose part it is in, with all that it carries, in an order that keeps neighbours
    /// near in memory; ghosts are left. `balance`: cuts are moved first, so that all ranks have the same work to do,
    /// where each of this rank's rods costs `work`. All ranks call it together, as they do the rest.
    void migrate(Rods& rods, const Box& box, bool balance, double work = 1.0);

    /// An own rod that another rank has to know, wherever it is.
    struct Wanted {
        std::uint32_t row;
        int rank;
    };

    /// Then brings ghosts: all rods whose surfaces may be nearer than `range` to one of this rank's, and those wanted.
    void fetch_ghosts(Rods& rods, const Box& box, double range, std::span<const Wanted> wanted = {});

    /// Both.
    void gather(Rods& rods, const Box& box, double range, bool balance) {
        migrate(rods, box, balance);
        fetch_ghosts(rods, box, range);
    }

    /// The rods and ghosts in these rows are left, in the order of `rows`, which begins with all own ones: the others
    /// have no neighbour here.
    void keep(Rods& rods, std::span<const std::uint32_t> rows);

    Rods own_rods(const Rods& rods) const;
    /// These are the own rods from now on, and ghosts are left: cells have divided or died.
    void replace(Rods& rods, Rods own);

    /// The rods of all ranks, in any order.
    Rods all_rods(const Rods& rods) const;

    static constexpr int nobody = -1;
    /// The rank that has each of these rods as its own now, or `nobody`. All ranks call it together, each with ids of
    /// its own choice.
    std::vector<int> ranks_of(const Rods& rods, std::span<const std::uint64_t> ids) const;

    /// Values of ghosts from their owners: value_of(row) is the place of a row's value, of plain numbers.
    template <class T, class ValueOf>
    void refresh(ValueOf&& value_of) const {
        static_assert(std::is_trivially_copyable_v<T>);
        if (!is_shared()) return;
        Exchange& exchange = exchange_of(sizeof(T));
        for (std::size_t p = 0; p < peers_.size(); ++p) {
            std::byte* place = exchange.out(p).data();
            for (const std::uint32_t row : peers_[p].sent) {
                const T& value = value_of(row);
                std::memcpy(place, &value, sizeof(T));
                place += sizeof(T);
            }
        }
        exchange.begin();
        exchange.end();
        for (std::size_t p = 0; p < peers_.size(); ++p) {
            const std::byte* place = exchange.in(p).data();
            for (std::uint32_t row = peers_[p].first_ghost; row < peers_[p].first_ghost + peers_[p].ghosts; ++row) {
                std::memcpy(&value_of(row), place, sizeof(T));
                place += sizeof(T);
            }
        }
    }

    /// Whose rod a ghost is: a number of those that exchange anything with this rank, in the order of their ranks.
    std::size_t peer_of(std::uint32_t ghost) const { return peer_of_ghost_[ghost - owned_]; }
    std::size_t peer_count() const { return peers_.size(); }
    int rank_of_peer(std::size_t peer) const { return peers_[peer].rank; }

    /// What has been gathered last, of this rank.
    struct Counts {
        std::size_t owned = 0, arrived = 0;  ///< own rods, and those that came from other ranks
        std::size_t near = 0, ghosts = 0;    ///< rods within range of the own ones, and those with a neighbour there
    };
    const Counts& counts() const { return counts_; }

private:
    struct Peer {
        int rank;
        std::vector<std::uint32_t> sent;  ///< own rows that are ghosts there, in the order of its rows
        std::uint32_t first_ghost, ghosts;
    };

    Exchange& exchange_of(std::size_t bytes) const;
    void bring_home(Rods& rods, const Box& box);
    void note_ghosts(std::span<const std::uint32_t> from, const std::vector<std::vector<std::uint32_t>>& sent);

    Ranks ranks_;
    std::size_t owned_ = std::numeric_limits<std::size_t>::max();
    Partition partition_;
    bool is_cut_ = false;
    std::vector<Peer> peers_;
    std::vector<std::uint32_t> peer_of_ghost_;
    Counts counts_;
    mutable std::map<std::size_t, std::unique_ptr<Exchange>> exchanges_;  ///< by the bytes of a value
};

}  // namespace jostle
