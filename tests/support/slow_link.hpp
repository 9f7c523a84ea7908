#pragma once

#include <chrono>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "jostle/parallel/forwarding_link.hpp"

namespace jostle::test {

/// Ranks whose exchanges take so much longer.
class SlowLink final : public ForwardingLink {
public:
    SlowLink(const Ranks& ranks, std::chrono::microseconds delay) : ForwardingLink(ranks), delay_(delay) {}

    std::unique_ptr<Exchange> exchange(std::vector<Exchange::Peer> peers) override {
        return std::make_unique<SlowExchange>(ForwardingLink::exchange(std::move(peers)), delay_);
    }

private:
    class SlowExchange final : public ForwardingExchange {
    public:
        SlowExchange(std::unique_ptr<Exchange> exchange, std::chrono::microseconds delay)
            : ForwardingExchange(std::move(exchange)), delay_(delay) {}

    private:
        void wait() override {
            std::this_thread::sleep_for(delay_);
            ForwardingExchange::wait();
        }

        std::chrono::microseconds delay_;
    };

    std::chrono::microseconds delay_;
};

}  // namespace jostle::test
