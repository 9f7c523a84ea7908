#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "jostle/parallel/ranks.hpp"

namespace jostle::test {

/// Ranks whose velocities take so long to arrive.
class SlowLink final : public RankLink {
public:
    SlowLink(const Ranks& ranks, std::chrono::microseconds delay) : ranks_(ranks), delay_(delay) {}

    int rank() const override { return ranks_.rank(); }
    int count() const override { return ranks_.count(); }
    void largest(std::span<double> values) override { ranks_.largest(values); }
    void add_up(std::span<std::int64_t> numbers) override { ranks_.add_up(numbers); }
    std::vector<Bytes> deal(const std::vector<Bytes>& to) override { return ranks_.deal(to); }
    Bytes of_first(Bytes message) override {
        const std::string_view text(reinterpret_cast<const char*>(message.data()), message.size());
        const std::string told = ranks_.of_first(text);
        const auto* const begin = reinterpret_cast<const std::byte*>(told.data());
        return {begin, begin + told.size()};
    }
    std::unique_ptr<Exchange> exchange(std::vector<Exchange::Peer> peers) override {
        return std::make_unique<SlowExchange>(ranks_.exchange(std::move(peers)), delay_);
    }

private:
    class SlowExchange final : public Exchange {
    public:
        SlowExchange(std::unique_ptr<Exchange> exchange, std::chrono::microseconds delay)
            : Exchange({exchange->peers().begin(), exchange->peers().end()}),
              exchange_(std::move(exchange)),
              delay_(delay) {}

        void begin() override {
            for (std::size_t p = 0; p < peers_.size(); ++p)
                std::copy(out_[p].begin(), out_[p].end(), exchange_->out(p).begin());
            exchange_->begin();
        }
        void wait() override {
            std::this_thread::sleep_for(delay_);
            exchange_->end();
            for (std::size_t p = 0; p < peers_.size(); ++p) {
                const auto arrived = exchange_->in(p);
                std::copy(arrived.begin(), arrived.end(), in_[p].begin());
            }
        }

    private:
        std::unique_ptr<Exchange> exchange_;
        std::chrono::microseconds delay_;
    };

    const Ranks& ranks_;
    std::chrono::microseconds delay_;
};

}  // namespace jostle::test
