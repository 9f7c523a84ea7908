#include "jostle/parallel/thread_ranks.hpp"

#include <algorithm>
#include <array>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <tuple>

namespace jostle {

namespace {

/// Thrown where a rank waits for one that has failed.
struct RankHasFailed {};

using Bytes = RankLink::Bytes;

/// What all ranks see: messages on their way, and what they work out together.
class MeetingPoint {
public:
    explicit MeetingPoint(int count) : count_(static_cast<std::size_t>(count)), boxes_(count_ * count_) {}

    int count() const { return static_cast<int>(count_); }

    void send(int from, int to, Bytes message) {
        Box& box = box_of(from, to);
        {
            const std::lock_guard guard(box.lock);
            box.messages.push_back(std::move(message));
        }
        box.arrived.notify_one();
    }

    /// In the order in which they were sent.
    Bytes receive(int from, int to) {
        Box& box = box_of(from, to);
        std::unique_lock guard(box.lock);
        box.arrived.wait(guard, [&] { return !box.messages.empty() || box.is_lost; });
        if (box.messages.empty()) throw RankHasFailed();
        Bytes message = std::move(box.messages.front());
        box.messages.pop_front();
        return message;
    }

    /// `values` of all ranks, brought together by merge(together, one rank's), which may not depend on their order.
    template <class Number, class Merge>
    void together(std::span<Number> values, Merge&& merge) {
        std::unique_lock guard(lock_);
        if (failed_) throw RankHasFailed();
        // A round begins only when all have come to it, and so have taken what the last but one gave.
        const std::uint64_t round = round_;
        auto& sum = std::get<std::vector<Number>>(sums_[round % 2]);
        if (there_ == 0)
            sum.assign(values.begin(), values.end());
        else
            for (std::size_t k = 0; k < values.size(); ++k) merge(sum[k], values[k]);
        if (++there_ == count_) {
            there_ = 0;
            ++round_;
            all_there_.notify_all();
        } else {
            all_there_.wait(guard, [&] { return round_ != round || failed_; });
            if (round_ == round) throw RankHasFailed();
        }
        std::copy(sum.begin(), sum.end(), values.begin());
    }

    void fail(std::exception_ptr what) {
        {
            const std::lock_guard guard(lock_);
            if (!failed_) thrown_ = std::move(what);
            failed_ = true;
        }
        all_there_.notify_all();
        for (Box& box : boxes_) {
            {
                const std::lock_guard guard(box.lock);
                box.is_lost = true;
            }
            box.arrived.notify_all();
        }
    }

    void rethrow() const {
        if (thrown_) std::rethrow_exception(thrown_);
    }

private:
    struct Box {
        std::mutex lock;
        std::condition_variable arrived;
        std::deque<Bytes> messages;
        bool is_lost = false;
    };
    Box& box_of(int from, int to) {
        return boxes_[static_cast<std::size_t>(from) * count_ + static_cast<std::size_t>(to)];
    }

    std::size_t count_;
    std::vector<Box> boxes_;
    std::mutex lock_;
    std::condition_variable all_there_;
    std::array<std::tuple<std::vector<double>, std::vector<std::int64_t>>, 2> sums_;
    std::uint64_t round_ = 0;
    std::size_t there_ = 0;
    bool failed_ = false;
    std::exception_ptr thrown_;
};

class ThreadExchange final : public Exchange {
public:
    ThreadExchange(MeetingPoint& meeting_point, int rank, std::vector<Peer> peers)
        : Exchange(std::move(peers)), meeting_point_(meeting_point), rank_(rank) {}

    void begin() override {
        for (std::size_t k = 0; k < peers_.size(); ++k)
            if (peers_[k].bytes_out > 0) meeting_point_.send(rank_, peers_[k].rank, out_[k]);
    }
    void wait() override {
        for (std::size_t k = 0; k < peers_.size(); ++k) {
            if (peers_[k].bytes_in == 0) continue;
            const Bytes message = meeting_point_.receive(peers_[k].rank, rank_);
            if (message.size() != peers_[k].bytes_in) throw std::logic_error("ranks disagree about a message");
            in_[k] = message;
        }
    }

private:
    MeetingPoint& meeting_point_;
    int rank_;
};

class ThreadLink final : public RankLink {
public:
    ThreadLink(MeetingPoint& meeting_point, int rank) : meeting_point_(meeting_point), rank_(rank) {}

    int rank() const override { return rank_; }
    int count() const override { return meeting_point_.count(); }
    void largest(std::span<double> values) override {
        meeting_point_.together(values, [](double& all, double one) { all = std::max(all, one); });
    }
    void add_up(std::span<std::int64_t> numbers) override {
        meeting_point_.together(numbers, [](std::int64_t& all, std::int64_t one) { all += one; });
    }
    std::vector<Bytes> deal(const std::vector<Bytes>& to) override {
        for (int q = 0; q < count(); ++q) meeting_point_.send(rank_, q, to[static_cast<std::size_t>(q)]);
        std::vector<Bytes> from;
        for (int p = 0; p < count(); ++p) from.push_back(meeting_point_.receive(p, rank_));
        return from;
    }
    Bytes of_first(Bytes message) override {
        if (rank_ != 0) return meeting_point_.receive(0, rank_);
        for (int q = 1; q < count(); ++q) meeting_point_.send(0, q, message);
        return message;
    }
    std::unique_ptr<Exchange> exchange(std::vector<Exchange::Peer> peers) override {
        return std::make_unique<ThreadExchange>(meeting_point_, rank_, std::move(peers));
    }

private:
    MeetingPoint& meeting_point_;
    int rank_;
};

}  // namespace

void run_as_ranks(int count, const std::function<void(const Ranks&)>& body) {
    MeetingPoint meeting_point(count);
    std::vector<std::thread> threads;
    const auto run = [&meeting_point, &body](int rank) {
        ThreadLink link(meeting_point, rank);
        try {
            body(Ranks(link));
        } catch (const RankHasFailed&) {  // who failed has told
        } catch (...) {
            meeting_point.fail(std::current_exception());
        }
    };
    try {
        for (int rank = 0; rank < count; ++rank) threads.emplace_back(run, rank);
    } catch (const std::system_error&) {  // no more threads can be started
        meeting_point.fail(std::current_exception());
    }
    for (std::thread& thread : threads) thread.join();
    meeting_point.rethrow();
}

}  // namespace jostle
