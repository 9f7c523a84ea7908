#pragma once

// The only header that names OpenMP. Every result is the same for any number of threads: loops write to places of their
// own, and sums are taken over blocks of fixed size, first inside each block, then over the blocks in order.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <utility>
#include <vector>

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

/// Number of threads used by all later loops of this thread, where it is free.
void suit_thread_count(int count);

/// The part of a loop that the calling thread is to do.
std::pair<std::size_t, std::size_t> own_share(std::size_t count);

/// Loops shorter than this run on the calling thread: starting the others would take longer than the work.
inline constexpr std::size_t serial_limit = 512;

/// Terms summed one after the other before block sums are combined.
inline constexpr std::size_t sum_block = 256;

/// Calls share(begin, end) for parts of [0, count), each on a thread of its own unless `on_one`. Waits for all, then
/// throws what was thrown first.
template <class Share>
void for_shares(std::size_t count, bool on_one, Share&& share) {
    std::exception_ptr thrown;  // it may not leave the thread
#pragma omp parallel num_threads(team_size(on_one))
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

/// The sum of term(k) over [0, count) in a fixed order. T needs a zero default and +=.
template <class T, class Term>
T parallel_sum(std::size_t count, Term&& term) {
    const std::size_t blocks = (count + parallel::sum_block - 1) / parallel::sum_block;
    std::vector<T> partial(blocks);
    parallel_for_blocks(count, parallel::sum_block, [&](std::size_t block, std::size_t begin, std::size_t end) {
        T sum{};
        for (std::size_t k = begin; k < end; ++k) sum += term(k);
        partial[block] = sum;
    });
    T sum{};
    for (const T& value : partial) sum += value;
    return sum;
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
