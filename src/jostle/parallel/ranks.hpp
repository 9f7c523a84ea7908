#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace jostle {

/// Adds the time of its life to what a rank has waited for others (s).
class Waiting {
public:
    explicit Waiting(double& seconds) : seconds_(seconds), began_(Clock::now()) {}
    ~Waiting() { seconds_ += std::chrono::duration<double>(Clock::now() - began_).count(); }
    Waiting(const Waiting&) = delete;
    Waiting& operator=(const Waiting&) = delete;

private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point began_;
};

/// The same messages between the same ranks, again and again.
class Exchange {
public:
    struct Peer {
        int rank;
        std::size_t bytes_out, bytes_in;
    };

    explicit Exchange(std::vector<Peer> peers);
    virtual ~Exchange() = default;
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;

    std::span<const Peer> peers() const { return peers_; }
    std::span<std::byte> out(std::size_t peer) { return out_[peer]; }
    std::span<const std::byte> in(std::size_t peer) const { return in_[peer]; }

    /// Sends what is in `out`; what lies between `begin` and `end` is done while messages travel.
    virtual void begin() = 0;
    /// Waits until all is in `in`.
    void end() {
        const Waiting waiting(*waited_);
        wait();
    }
    /// Where the time that `end` takes is added up.
    void add_waiting_to(double& seconds) { waited_ = &seconds; }

protected:
    virtual void wait() = 0;

    std::vector<Peer> peers_;
    std::vector<std::vector<std::byte>> out_, in_;

private:
    double own_waiting_ = 0.0;
    double* waited_ = &own_waiting_;
};

/// A file that all ranks write to, each at places of its own.
///
/// Errors of all that it does, and of opening it: std::system_error with a value of errno.
class FileOfRanks {
public:
    virtual ~FileOfRanks() = default;
    virtual void write_at(std::uint64_t place, std::string_view bytes) = 0;
    /// Returns when all is on the disk that all ranks have written; nothing can be written any more. All call it
    /// together. Without it the file stays open: no rank may wait for one that has met an error.
    virtual void finish() = 0;
};

/// How one rank reaches the others. All ranks make the same calls in the same order.
class RankLink {
public:
    using Bytes = std::vector<std::byte>;

    virtual ~RankLink() = default;
    virtual int rank() const = 0;
    virtual int count() const = 0;
    virtual void largest(std::span<double> values) = 0;
    virtual void add_up(std::span<std::int64_t> numbers) = 0;
    virtual std::vector<Bytes> deal(const std::vector<Bytes>& to) = 0;
    virtual Bytes of_first(Bytes message) = 0;
    virtual std::unique_ptr<Exchange> exchange(std::vector<Exchange::Peer> peers) = 0;
    /// None where ranks are of one process, which opens files by itself.
    virtual std::unique_ptr<FileOfRanks> open(const std::string& /*path*/) { return nullptr; }

    double seconds_waited = 0.0;  ///< for other ranks, in all calls but `exchange`
};

/// Those that make a run together, each with a part of the rods: all of them, or one alone, for whom nothing is sent.
/// Whatever they agree upon is the same for all, to the bit. A handle: the link must outlive it.
class Ranks {
public:
    Ranks() = default;
    explicit Ranks(RankLink& link) : link_(&link) {}

    bool alone() const { return link_ == nullptr; }
    int rank() const { return link_ ? link_->rank() : 0; }
    int count() const { return link_ ? link_->count() : 1; }
    /// How long this rank has waited for others so far, messages included (s).
    double seconds_waited() const { return link_ ? link_->seconds_waited : 0.0; }

    /// The largest of all ranks; nan counts as infinite.
    double largest(double value) const {
        if (link_) largest(std::span(&value, 1));
        return value;
    }
    void largest(std::span<double> values) const;
    /// Whether it is so on any rank.
    bool any(bool here) const { return link_ ? largest(here ? 1.0 : 0.0) > 0.0 : here; }
    /// The sum over all ranks.
    std::int64_t sum(std::int64_t number) const {
        add_up({&number, 1});
        return number;
    }
    void add_up(std::span<std::int64_t> numbers) const {
        if (!link_) return;
        const Waiting waiting(link_->seconds_waited);
        link_->add_up(numbers);
    }

    /// to[q] goes to rank q; returns what has come, from[p] from rank p. T is made of plain numbers.
    template <class T>
    std::vector<std::vector<T>> deal(const std::vector<std::vector<T>>& to) const {
        static_assert(std::is_trivially_copyable_v<T>);
        if (!link_) return to;
        std::vector<RankLink::Bytes> bytes(to.size());
        for (std::size_t q = 0; q < to.size(); ++q) {
            bytes[q].resize(to[q].size() * sizeof(T));
            if (!bytes[q].empty()) std::memcpy(bytes[q].data(), to[q].data(), bytes[q].size());
        }
        const auto arrived = dealt(bytes);
        std::vector<std::vector<T>> from(arrived.size());
        for (std::size_t p = 0; p < arrived.size(); ++p) {
            from[p].resize(arrived[p].size() / sizeof(T));
            if (!from[p].empty()) std::memcpy(from[p].data(), arrived[p].data(), arrived[p].size());
        }
        return from;
    }

    /// What rank 0 gives; what the others give is not looked at.
    std::string of_first(std::string_view message) const;

    /// Whether it is the same for all.
    bool all_have(std::uint64_t number) const;

    /// One value of each rank, for all.
    template <class T>
    std::vector<T> gather(const T& here) const {
        std::vector<T> all;
        for (const auto& one : deal(std::vector<std::vector<T>>(static_cast<std::size_t>(count()), {here})))
            all.push_back(one.front());
        return all;
    }

    /// The items of all ranks, those of one after those of the other, for rank 0; none for the others.
    template <class T>
    std::vector<T> gather_at_first(const std::vector<T>& here) const {
        if (alone()) return here;
        std::vector<std::vector<T>> to(static_cast<std::size_t>(count()));
        to[0] = here;
        std::vector<T> all;
        for (const auto& of_rank : deal(to)) all.insert(all.end(), of_rank.begin(), of_rank.end());
        return all;
    }

    /// The items of all ranks, those of one after those of the other, for all.
    template <class T>
    std::vector<T> gather_at_all(std::vector<T> here) const {
        if (alone()) return here;
        std::vector<T> all;
        for (const auto& of_rank : deal(std::vector(static_cast<std::size_t>(count()), here)))
            all.insert(all.end(), of_rank.begin(), of_rank.end());
        return all;
    }

    /// Not for one alone.
    std::unique_ptr<Exchange> exchange(std::vector<Exchange::Peer> peers) const {
        auto exchange = link_->exchange(std::move(peers));
        exchange->add_waiting_to(link_->seconds_waited);
        return exchange;
    }

    /// A file that is there, by the same path for all; none where ranks are of one process. Not for one alone.
    std::unique_ptr<FileOfRanks> open(const std::string& path) const { return link_->open(path); }

private:
    std::vector<RankLink::Bytes> dealt(const std::vector<RankLink::Bytes>& to) const {
        const Waiting waiting(link_->seconds_waited);
        return link_->deal(to);
    }

    RankLink* link_ = nullptr;
};

}  // namespace jostle
