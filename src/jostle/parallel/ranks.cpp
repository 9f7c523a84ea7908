#include "jostle/parallel/ranks.hpp"

#include <array>
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
    const Waiting waiting(link_->seconds_waited);
    link_->largest(values);
}

std::string Ranks::of_first(std::string_view message) const {
    if (!link_) return std::string(message);
    RankLink::Bytes bytes(rank() == 0 ? message.size() : 0);
    if (!bytes.empty()) std::memcpy(bytes.data(), message.data(), bytes.size());
    bytes = link_->of_first(std::move(bytes));
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool Ranks::all_have(std::uint64_t number) const {
    if (!link_) return true;
    // In halves, which a double holds exactly.
    const auto low = static_cast<double>(number & 0xFFFF'FFFF), high = static_cast<double>(number >> 32);
    std::array<double, 4> most = {low, -low, high, -high};
    link_->largest(most);
    return most[0] == -most[1] && most[2] == -most[3];
}

}  // namespace jostle
