#include "jostle/contact_problem/border_messages.hpp"

#include <algorithm>
#include <utility>

namespace jostle {

BorderMessages::BorderMessages(const Domain& domain, const ContactMatrix& contact_matrix,
                               std::span<const ContactPair> pairs, std::size_t bytes) {
    using Rod = std::pair<std::uint64_t, std::uint32_t>;  // id, local index
    struct Shared {
        std::vector<Rod> sent, received;
    };
    std::vector<Shared> by_peer(domain.peer_count());
    for (const ContactPair& pair : pairs) {
        const Rod i = {contact_matrix.id_of_i(pair.first), pair.i}, j = {contact_matrix.id_of_j(pair.first), pair.j};
        const bool i_is_own = domain.owns(contact_matrix.rods()[pair.i]);
        const auto& [own, ghost] = i_is_own ? std::pair(i, j) : std::pair(j, i);
        Shared& shared = by_peer[domain.peer_of(contact_matrix.rods()[ghost.second])];
        shared.sent.push_back(own);
        shared.received.push_back(ghost);
    }
    const auto in_order = [](std::vector<Rod>& rods) {
        std::sort(rods.begin(), rods.end());
        rods.erase(std::unique(rods.begin(), rods.end()), rods.end());
        std::vector<std::uint32_t> locals(rods.size());
        std::transform(rods.begin(), rods.end(), locals.begin(), [](const Rod& rod) { return rod.second; });
        return locals;
    };
    std::vector<Exchange::Peer> messages;
    for (std::size_t p = 0; p < by_peer.size(); ++p)
        if (!by_peer[p].sent.empty())
            add_peer(messages, domain.rank_of_peer(p), {in_order(by_peer[p].sent), in_order(by_peer[p].received)},
                     bytes);
    if (!peers_.empty()) exchange_ = domain.ranks().exchange(std::move(messages));
}

BorderMessages::BorderMessages(const Ranks& ranks, const BorderLists& sent, const BorderLists& received,
                               std::size_t bytes) {
    std::vector<Exchange::Peer> messages;
    for (std::size_t rank = 0; rank < sent.size(); ++rank)
        if (!sent[rank].empty() || !received[rank].empty())
            add_peer(messages, static_cast<int>(rank), {sent[rank], received[rank]}, bytes);
    if (!peers_.empty()) exchange_ = ranks.exchange(std::move(messages));
}

void BorderMessages::add_peer(std::vector<Exchange::Peer>& messages, int rank, Peer peer, std::size_t bytes) {
    messages.push_back({rank, bytes * peer.sent.size(), bytes * peer.received.size()});
    peers_.push_back(std::move(peer));
}

}  // namespace jostle
