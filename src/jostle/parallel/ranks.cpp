#include "jostle/parallel/ranks.hpp"

#include <cmath>
#include <limits>

namespace jostle {

Exchange::Exchange(std::vector<Peer> peers) : peers_(std::move(peers)) {
    for (const Peer& peer : peers_) {
        out_.emplace_back(peer.bytes_out);
        in_.emplace_back(peer.bytes_in);
    }
}

void Ranks::largest(std::span<double> values) const {
    if (!link_) return;
    for (double& value : values)
        if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
    link_->largest(values);
}

}  // namespace jostle
