#pragma once

// The only header that names OpenMP. Every result is the same for any number of threads and any order of the terms:
// loops write to places of their own, and sums are exact.

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <exception>
#include <type_traits>
#include <utility>
#include <vector>

#include "jostle/parallel/exact_sum.hpp"

namespace jostle {

namespace parallel {

/// Number of threads used by all later loops, whichever thread calls them: 1 to 4096, and no more than the system
/// starts. Errors: InputError, with `asked_by` as its key. In a child of a fork, if threads had been started before, it
/// stays 1.
void set_thread_count(long long count, const char* asked_by = "set_thread_count");
/// Errors: InputError if OMP_NUM_THREADS is outside the same range.
int thread_count();

/// Number of threads that the next loop begins with, the calling one among them.
int team_size(bool on_one);

/// Whether neither that nor OMP_NUM_THREADS has set it.
bool thread_count_is_free();

/// As many threads as are worth starting for so many rods: one for every 2000, and no more than there are processors.
int worthwhile_thread_count(std::size_t rods);

/// To be told where so many processes of this machine make one run: each has its part of the processors then, and no
/// more than it may run on.
void share_processors(int processes);

/// Number of threads used by all later loops of this thread, where it is free.
void suit_thread_count(int count);

/// The part of a loop that the calling thread is to do.
std::pair<std::size_t, std::size_t> own_share(std::size_t count);

/// Number of the calling thread in the loop that it takes part in, from 0; shares follow each other in this order.
int thread_number();

/// Loops shorter than this run on the calling thread: starting the others would take longer than the work.
inline constexpr std::size_t serial_limit = 512;

/// Calls share(begin, end) for parts of [0, count), each on a thread of its own unless `on_one`. Waits for all, then
/// throws what was thrown first.
template <class Share>
void for_shares(std::size_t count, bool on_one, Share&& share) {
    const int threads = team_size(on_one);
    if (threads == 1) {  // to enter a region takes longer than many a loop
        share(std::size_t{0}, count);
        return;
    }
    std::exception_ptr thrown;  // it may not leave the thread
#pragma omp parallel num_threads(threads)
    try {
        const auto [begin, end] = own_share(count);
        share(begin, end);
    } catch (...) {
#pragma omp critical
        if (!thrown) thrown = std::current_exception();
    }
    if (thrown) std::rethrow_exception(thrown);
}

/// Calls body(k) for every k in [0, count).
template <class Body>
void for_each(std::size_t count, bool on_one, Body&& body) {
    for_shares(count, on_one, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) body(k);
    });
}

/// The largest of `floor` and all value(begin, end) over shares.
template <class Value>
double max_of_shares(std::size_t count, bool on_one, double floor, Value&& value) {
    std::atomic<double> largest = floor;
    for_shares(count, on_one, [&](std::size_t begin, std::size_t end) {
        const double mine = value(begin, end);
        for (double seen = largest; seen < mine && !largest.compare_exchange_weak(seen, mine);) {
        }
    });
    return largest;
}

}  // namespace parallel

/// Calls body(k) for every k in [0, count), in any order and on any thread; body(k) may write only what belongs to k.
/// If a call throws, others may be left out, and the loop throws that once no thread is at work any more.
template <class Body>
void parallel_for(std::size_t count, Body&& body) {
    parallel::for_each(count, count <= parallel::serial_limit, body);
}

/// Calls body(part) for every part in [0, count), each of which is worth a thread of its own.
template <class Body>
void parallel_for_parts(std::size_t count, Body&& body) {
    parallel::for_each(count, count <= 1, body);
}

/// Calls body(block, begin, end) for consecutive blocks of `block_size` indices that cover [0, count).
template <class Body>
void parallel_for_blocks(std::size_t count, std::size_t block_size, Body&& body) {
    const std::size_t blocks = (count + block_size - 1) / block_size;
    parallel::for_each(blocks, count <= parallel::serial_limit, [&](std::size_t block) {
        body(block, block * block_size, std::min((block + 1) * block_size, count));
    });
}

/// How sums of T are held until they are rounded: whole numbers as they are.
template <class T>
inline constexpr std::size_t numbers_in = std::is_integral_v<T> ? 1 : sizeof(T) / sizeof(double);
template <class T>
using UnroundedSum = std::array<std::conditional_t<std::is_integral_v<T>, T, ExactSum>, numbers_in<T>>;

/// The sum of term(k) over [0, count), not rounded yet.
template <class T, class Term>
UnroundedSum<T> unrounded_sum(std::size_t count, Term&& term) {
    static_assert(std::is_integral_v<T> || (std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0));
    constexpr std::size_t width = numbers_in<T>;
    UnroundedSum<T> total{};
    parallel::for_shares(count, count <= parallel::serial_limit, [&](std::size_t begin, std::size_t end) {
        UnroundedSum<T> share{};
        if constexpr (std::is_integral_v<T>) {
            for (std::size_t k = begin; k < end; ++k) share[0] += term(k);
        } else {
            std::array<std::array<double, ExactSum::batch>, width> batch;
            for (std::size_t first = begin; first < end; first += ExactSum::batch) {
                const std::size_t count_of_batch = std::min(ExactSum::batch, end - first);
                for (std::size_t k = 0; k < count_of_batch; ++k) {
                    const auto numbers = std::bit_cast<std::array<double, width>>(static_cast<T>(term(first + k)));
                    for (std::size_t n = 0; n < width; ++n) batch[n][k] = numbers[n];
                }
                for (std::size_t n = 0; n < width; ++n) share[n].add_all({batch[n].data(), count_of_batch});
            }
        }
#pragma omp critical
        for (std::size_t n = 0; n < width; ++n) total[n] += share[n];
    });
    return total;
}

template <class T>
T rounded_sum(const UnroundedSum<T>& total) {
    if constexpr (std::is_integral_v<T>) {
        return total[0];
    } else {
        std::array<double, numbers_in<T>> sum;
        for (std::size_t n = 0; n < sum.size(); ++n) sum[n] = total[n].value();
        return std::bit_cast<T>(sum);
    }
}

/// The sum of term(k) over [0, count): exact and rounded once, so that neither threads nor the order of the terms
/// matter. T is a whole number, a double, or a struct of doubles alone, each of which is summed.
template <class T, class Term>
T parallel_sum(std::size_t count, Term&& term) {
    return rounded_sum<T>(unrounded_sum<T>(count, term));
}

/// The largest of `floor` and all value(k) over [0, count).
template <class Value>
double parallel_max(std::size_t count, double floor, Value&& value) {
    return parallel::max_of_shares(count, count <= parallel::serial_limit, floor,
                                   [&](std::size_t begin, std::size_t end) {
                                       double largest = floor;
                                       for (std::size_t k = begin; k < end; ++k)
                                           largest = std::max(largest, static_cast<double>(value(k)));
                                       return largest;
                                   });
}

/// The largest of 0 and all value(block) over [0, count), on one thread where the blocks hold too few items, so many in
/// all, to be worth more.
template <class Value>
double parallel_max_of_blocks(std::size_t count, std::size_t items, Value&& value) {
    return parallel::max_of_shares(count, items <= parallel::serial_limit, 0.0,
                                   [&](std::size_t begin, std::size_t end) {
                                       double largest = 0.0;
                                       for (std::size_t block = begin; block < end; ++block)
                                           largest = std::max(largest, static_cast<double>(value(block)));
                                       return largest;
                                   });
}

}  // namespace jostle
