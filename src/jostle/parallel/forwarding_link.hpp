#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jostle/parallel/ranks.hpp"

namespace jostle {

/// Does what another exchange does: for those that do something beside it.
class ForwardingExchange : public Exchange {
public:
    explicit ForwardingExchange(std::unique_ptr<Exchange> exchange)
        : Exchange({exchange->peers().begin(), exchange->peers().end()}), exchange_(std::move(exchange)) {}

    void begin() override {
        for (std::size_t p = 0; p < peers_.size(); ++p)
            std::copy(out_[p].begin(), out_[p].end(), exchange_->out(p).begin());
        exchange_->begin();
    }

protected:
    void wait() override {
        exchange_->end();
        for (std::size_t p = 0; p < peers_.size(); ++p) {
            const auto arrived = exchange_->in(p);
            std::copy(arrived.begin(), arrived.end(), in_[p].begin());
        }
    }

private:
    std::unique_ptr<Exchange> exchange_;
};

/// Does what the link of these ranks does: for those that count, or delay, what goes through them.
class ForwardingLink : public RankLink {
public:
    explicit ForwardingLink(const Ranks& ranks) : ranks_(ranks) {}

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
        return ranks_.exchange(std::move(peers));
    }

private:
    Ranks ranks_;
};

}  // namespace jostle
