// Ranks as threads of one process: what they agree upon, what they send, and what happens where one fails.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>
#include <stdexcept>

#include "jostle/parallel/launched_ranks.hpp"
#include "jostle/parallel/sum_over_ranks.hpp"
#include "jostle/parallel/thread_ranks.hpp"

using namespace jostle;

namespace {

/// What all ranks have found, in their order; doctest counts checks of one thread.
template <class T>
std::vector<T> found_by_ranks(int count, const std::function<T(const Ranks&)>& find) {
    std::vector<T> found(static_cast<std::size_t>(count));
    run_as_ranks(count, [&](const Ranks& ranks) { found[static_cast<std::size_t>(ranks.rank())] = find(ranks); });
    return found;
}

struct Three {
    double a, b, c;
    bool operator==(const Three&) const = default;
};

}  // namespace

TEST_CASE("one alone agrees with itself, and sends nothing") {
    const Ranks ranks;
    CHECK(ranks.alone());
    CHECK(ranks.rank() == 0);
    CHECK(ranks.count() == 1);
    CHECK(ranks.largest(-2.5) == -2.5);
    CHECK(std::isnan(ranks.largest(std::numeric_limits<double>::quiet_NaN())));
    CHECK(ranks.sum(-3) == -3);
    CHECK(!ranks.any(false));
    CHECK(ranks.deal<int>({{1, 2}}) == std::vector<std::vector<int>>{{1, 2}});
    CHECK(ranks.gather(7) == std::vector<int>{7});
}

TEST_CASE("ranks agree on the largest value, sums of whole numbers, and what any of them says") {
    for (const int count : {1, 2, 5, 8}) {
        CAPTURE(count);
        const auto found = found_by_ranks<std::vector<double>>(count, [count](const Ranks& ranks) {
            const int rank = ranks.rank();
            std::vector<double> all;
            for (int k = 0; k < 50; ++k) {  // the same buffers again and again
                all.push_back(ranks.largest(-1.0 - (rank + k) % count));
                all.push_back(static_cast<double>(ranks.sum(rank + k)));
            }
            all.push_back(ranks.any(rank == count - 1));
            all.push_back(ranks.any(false));
            all.push_back(ranks.largest(rank == 0 ? std::numeric_limits<double>::quiet_NaN() : 1.0));
            all.push_back(ranks.count());
            return all;
        });
        std::vector<double> expected;
        for (int k = 0; k < 50; ++k) {
            expected.push_back(-1.0);
            expected.push_back(count * (count - 1) / 2 + count * k);
        }
        expected.insert(expected.end(), {1.0, 0.0, std::numeric_limits<double>::infinity(), 1.0 * count});
        for (const auto& one : found) CHECK(one == expected);
    }
}

TEST_CASE("what is dealt arrives, in order, and empty where there is nothing") {
    constexpr int count = 4;
    using Dealt = std::vector<std::vector<std::int32_t>>;
    const auto found = found_by_ranks<Dealt>(count, [](const Ranks& ranks) {
        Dealt to(count);
        for (int q = 0; q < count; ++q)  // rank p sends q numbers to rank q
            for (int k = 0; k < q; ++k) to[static_cast<std::size_t>(q)].push_back(100 * ranks.rank() + k);
        return ranks.deal(to);
    });
    for (std::size_t q = 0; q < count; ++q) {
        REQUIRE(found[q].size() == count);
        for (std::size_t p = 0; p < count; ++p) {
            std::vector<std::int32_t> expected(q);
            std::iota(expected.begin(), expected.end(), static_cast<std::int32_t>(100 * p));
            CHECK(found[q][p] == expected);
        }
    }
    for (const auto& one : found_by_ranks<std::vector<int>>(3, [](const Ranks& r) { return r.gather(r.rank() + 1); }))
        CHECK(one == std::vector<int>{1, 2, 3});
}

TEST_CASE("the first rank tells the others, and all see where they do not have the same") {
    using Told = std::pair<std::string, std::vector<bool>>;
    const auto found = found_by_ranks<Told>(3, [](const Ranks& ranks) {
        const std::string told = ranks.of_first(ranks.rank() == 0 ? std::string("a\0b", 3) : "not looked at");
        const auto rank = static_cast<std::uint64_t>(ranks.rank());
        std::vector<bool> same = {ranks.all_have(0x8765'4321'8765'4321)};
        for (const unsigned bit : {0U, 31U, 32U, 63U}) same.push_back(ranks.all_have(rank == 2 ? 1ULL << bit : 0));
        return Told{told, same};
    });
    for (const Told& one : found) {
        CHECK(one.first == std::string("a\0b", 3));
        CHECK(one.second == std::vector<bool>{true, false, false, false, false});
    }
    CHECK(Ranks().of_first("alone") == "alone");
    CHECK(Ranks().all_have(7));
}

TEST_CASE("what launchers leave in the environment") {
    const char* const names[] = {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK", "PMI_SIZE", "PMI_RANK", "PMIX_RANK",
                                 "SLURM_STEP_NUM_TASKS", "SLURM_PROCID"};
    const auto launch_of = [&](std::initializer_list<std::pair<const char*, const char*>> variables) {
        for (const char* name : names) ::unsetenv(name);
        for (const auto& [name, value] : variables) ::setenv(name, value, 1);
        const Launch launch = launch_in_environment();
        for (const char* name : names) ::unsetenv(name);
        return std::pair(launch.rank, launch.count);
    };
    CHECK(launch_of({}) == std::pair(0, 1));
    CHECK(launch_of({{"OMPI_COMM_WORLD_SIZE", "4"}, {"OMPI_COMM_WORLD_RANK", "3"}}) == std::pair(3, 4));
    CHECK(launch_of({{"OMPI_COMM_WORLD_SIZE", "1"}, {"OMPI_COMM_WORLD_RANK", "0"}}) == std::pair(0, 1));
    CHECK(launch_of({{"PMI_SIZE", "2"}, {"PMI_RANK", "1"}}) == std::pair(1, 2));
    CHECK(launch_of({{"SLURM_STEP_NUM_TASKS", "8"}, {"PMIX_RANK", "7"}}) == std::pair(7, 8));
    CHECK(launch_of({{"SLURM_STEP_NUM_TASKS", "8"}, {"SLURM_PROCID", "6"}}) == std::pair(6, 8));
    CHECK(launch_of({{"SLURM_PROCID", "0"}}) == std::pair(0, 1));  // a batch script, in no step
    CHECK(launch_of({{"OMPI_COMM_WORLD_SIZE", "many"}}) == std::pair(0, 1));
}

TEST_CASE("an exchange sends the same messages again and again, and none where there is nothing to send") {
    constexpr int count = 3, times = 200;
    const auto found = found_by_ranks<std::vector<int>>(count, [](const Ranks& ranks) {
        // Round the ring: a message to the next, none back.
        const int next = (ranks.rank() + 1) % count, last = (ranks.rank() + count - 1) % count;
        const auto exchange = ranks.exchange({{next, sizeof(int), 0}, {last, 0, sizeof(int)}});
        std::vector<int> arrived;
        int carried = ranks.rank();
        for (int k = 0; k < times; ++k) {
            std::memcpy(exchange->out(0).data(), &carried, sizeof carried);
            exchange->begin();
            exchange->end();
            std::memcpy(&carried, exchange->in(1).data(), sizeof carried);
            arrived.push_back(carried);
        }
        return arrived;
    });
    for (int rank = 0; rank < count; ++rank)
        for (int k = 0; k < times; ++k)
            CHECK(found[static_cast<std::size_t>(rank)][static_cast<std::size_t>(k)] ==
                  ((rank - k - 1) % count + count) % count);
}

TEST_CASE("sums over ranks have the bits of sums on one, whoever has the terms") {
    std::mt19937 random(3);
    std::vector<Three> terms(3000);
    std::uniform_real_distribution<double> exponent(-40.0, 40.0), sign(-1.0, 1.0);
    for (Three& term : terms)
        term = {std::exp2(exponent(random)) * sign(random), sign(random), -std::exp2(0.1 * exponent(random))};
    const auto alone = parallel_sum<Three>(terms.size(), [&](std::size_t k) { return terms[k]; });
    CHECK(sum_over_ranks<Three>({}, terms.size(), [&](std::size_t k) { return terms[k]; }) == alone);
    for (const int count : {1, 2, 3, 7}) {
        CAPTURE(count);
        std::vector<std::vector<Three>> dealt(static_cast<std::size_t>(count));
        for (std::size_t k = 0; k < terms.size(); ++k) dealt[random() % dealt.size()].push_back(terms[k]);
        const auto found = found_by_ranks<Three>(count, [&](const Ranks& ranks) {
            const auto& own = dealt[static_cast<std::size_t>(ranks.rank())];
            return sum_over_ranks<Three>(ranks, own.size(), [&](std::size_t k) { return own[k]; });
        });
        for (const Three& one : found) CHECK(one == alone);
    }
}

TEST_CASE("sums that cancel, negative ones and those that are not finite are sums over ranks, too") {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const auto sum_of = [](std::vector<double> terms) {  // one a rank
        return found_by_ranks<double>(static_cast<int>(terms.size()),
                                      [&](const Ranks& ranks) {
                                          const double own = terms[static_cast<std::size_t>(ranks.rank())];
                                          return sum_over_ranks<double>(ranks, 1, [&](std::size_t) { return own; });
                                      })
            .back();
    };
    CHECK(sum_of({1e300, 1.0, -1e300}) == 1.0);
    CHECK(sum_of({-3.5, 1e20, -1e20, 1.25}) == -2.25);
    CHECK(sum_of({-1.0, -std::ldexp(1.0, -53), -std::ldexp(1.0, -600)}) == -1.0 - std::ldexp(1.0, -52));
    CHECK(sum_of({0.0, 0.0}) == 0.0);
    CHECK(sum_of({infinity, 1.0}) == infinity);
    CHECK(sum_of({2.0, -infinity}) == -infinity);
    CHECK(std::isnan(sum_of({infinity, -infinity})));
    CHECK(std::isnan(sum_of({std::nan(""), 1.0})));
}

TEST_CASE("a rank that fails ends the others, wherever they wait, and its error is the one that is seen") {
    const auto fail_while = [](const std::function<void(const Ranks&)>& wait) {
        run_as_ranks(3, [&](const Ranks& ranks) {
            if (ranks.rank() == 1) throw std::runtime_error("rank 1");
            wait(ranks);
        });
    };
    CHECK_THROWS_WITH_AS(fail_while([](const Ranks& ranks) { ranks.sum(1); }), "rank 1", std::runtime_error);
    CHECK_THROWS_WITH_AS(fail_while([](const Ranks& ranks) { ranks.gather(1); }), "rank 1", std::runtime_error);
    CHECK_THROWS_WITH_AS(fail_while([](const Ranks& ranks) {
                             const auto exchange = ranks.exchange({{1, 0, 8}});
                             exchange->begin();
                             exchange->end();
                         }),
                         "rank 1", std::runtime_error);
}
