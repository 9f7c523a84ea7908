#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// What ranks have sent, all together.
struct Traffic {
    std::atomic<std::uint64_t> exchanges = 0;   ///< each rank counts its own
    std::atomic<std::uint64_t> messages = 0;    ///< of exchanges
    std::atomic<std::uint64_t> bytes = 0;       ///< of these messages
    std::atomic<std::uint64_t> agreements = 0;  ///< on the largest, and on sums
    std::atomic<std::uint64_t> deals = 0, bytes_dealt = 0;
};

/// Does what the link of these ranks does, and counts it.
class CountedLink final : public RankLink {
public:
    CountedLink(const Ranks& ranks, Traffic& traffic) : ranks_(ranks), traffic_(traffic) {}

    int rank() const override { return ranks_.rank(); }
    int count() const override { return ranks_.count(); }
    void largest(std::span<double> values) override {
        ++traffic_.agreements;
        ranks_.largest(values);
    }
    void add_up(std::span<std::int64_t> numbers) override {
        ++traffic_.agreements;
        ranks_.add_up(numbers);
    }
    std::vector<Bytes> deal(const std::vector<Bytes>& to) override {
        ++traffic_.deals;
        for (const Bytes& bytes : to) traffic_.bytes_dealt += bytes.size();
        return ranks_.deal(to);
    }
    Bytes of_first(Bytes message) override {
        const std::string_view text(reinterpret_cast<const char*>(message.data()), message.size());
        const std::string told = ranks_.of_first(text);
        const auto* const begin = reinterpret_cast<const std::byte*>(told.data());
        return {begin, begin + told.size()};
    }
    std::unique_ptr<Exchange> exchange(std::vector<Exchange::Peer> peers) override {
        return std::make_unique<CountedExchange>(ranks_.exchange(std::move(peers)), traffic_);
    }

    std::unique_ptr<FileOfRanks> open(const std::string& path) override { return ranks_.open(path); }

private:
    class CountedExchange final : public Exchange {
    public:
        CountedExchange(std::unique_ptr<Exchange> exchange, Traffic& traffic)
            : Exchange({exchange->peers().begin(), exchange->peers().end()}),
              exchange_(std::move(exchange)),
              traffic_(traffic) {}

        void begin() override {
            ++traffic_.exchanges;
            for (std::size_t p = 0; p < peers_.size(); ++p) {
                traffic_.messages += out_[p].empty() ? 0 : 1;
                traffic_.bytes += out_[p].size();
                std::copy(out_[p].begin(), out_[p].end(), exchange_->out(p).begin());
            }
            exchange_->begin();
        }

    private:
        void wait() override {
            exchange_->end();
            for (std::size_t p = 0; p < peers_.size(); ++p) {
                const auto arrived = exchange_->in(p);
                std::copy(arrived.begin(), arrived.end(), in_[p].begin());
            }
        }

        std::unique_ptr<Exchange> exchange_;
        Traffic& traffic_;
    };

    Ranks ranks_;
    Traffic& traffic_;
};

}  // namespace jostle
