#pragma once

#include <cstring>
#include <memory>
#include <span>
#include <type_traits>
#include <vector>

#include "jostle/contact/contact_matrix.hpp"
#include "jostle/contact_problem/pair_colours.hpp"
#include "jostle/domain/domain.hpp"

namespace jostle {

/// Whether one of two rods is another rank's.
inline bool is_between_ranks(const ContactPair& pair, const ContactMatrix& contact_matrix, const Domain& domain) {
    const auto owns = [&](std::uint32_t local) {
        return local == no_local_index || domain.owns(contact_matrix.rods()[local]);
    };
    return !owns(pair.i) || !owns(pair.j);
}

/// Local indices of rods, for each rank.
using BorderLists = std::vector<std::vector<std::uint32_t>>;

/// Values of rods that pairs between ranks share: each rank sends those of its own rods, and receives those of its
/// ghosts. Two ranks have the same pairs between them, so each knows what the other sends.
class BorderMessages {
public:
    /// Nothing is sent.
    BorderMessages() = default;
    /// `pairs`: those between ranks; `bytes`: of a value.
    BorderMessages(const Domain& domain, const ContactMatrix& contact_matrix, std::span<const ContactPair> pairs,
                   std::size_t bytes);

    /// Own rods that are `sent` to each rank, and those `received` from each, in the order in which it sends them.
    BorderMessages(const Ranks& ranks, const BorderLists& sent, const BorderLists& received, std::size_t bytes);

    bool empty() const { return !exchange_; }

    /// `values`: (n) by local indices; those of ghosts become their owners'.
    template <class T>
    void bring(std::span<T> values) {
        begin(std::span<const T>(values));
        end(values);
    }

    /// The same in two parts: what lies between is done while messages travel, and leaves these values as they are.
    template <class T>
    void begin(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (empty()) return;
        for (std::size_t p = 0; p < peers_.size(); ++p) {
            std::byte* place = exchange_->out(p).data();
            for (const std::uint32_t local : peers_[p].sent) {
                std::memcpy(place, &values[local], sizeof(T));
                place += sizeof(T);
            }
        }
        exchange_->begin();
    }
    template <class T>
    void end(std::span<T> values) {
        if (empty()) return;
        exchange_->end();
        for (std::size_t p = 0; p < peers_.size(); ++p) {
            const std::byte* place = exchange_->in(p).data();
            for (const std::uint32_t local : peers_[p].received) {
                std::memcpy(&values[local], place, sizeof(T));
                place += sizeof(T);
            }
        }
    }

private:
    struct Peer {
        std::vector<std::uint32_t> sent, received;  ///< local indices, in an order that both ranks know
    };

    void add_peer(std::vector<Exchange::Peer>& messages, int rank, Peer peer, std::size_t bytes);

    std::vector<Peer> peers_;
    std::unique_ptr<Exchange> exchange_;
};

}  // namespace jostle
