#pragma once

// The only header that names OpenMP. Every result is the same for any number of threads: loops write to places of their
// own, and sums are taken over blocks of fixed size, first inside each block, then over the blocks in order.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace jostle {

namespace parallel {

/// Number of threads used by all later loops; at least 1.
void set_thread_count(int count);
int thread_count();

/// Loops shorter than this run on the calling thread: starting the others would take longer than the work.
inline constexpr std::size_t serial_limit = 512;

/// Terms summed one after the other before block sums are combined.
inline constexpr std::size_t sum_block = 256;

}  // namespace parallel

/// Calls body(k) for every k in [0, count), in any order and on any thread; body(k) may write only what belongs to k.
template <class Body>
void parallel_for(std::size_t count, Body&& body) {
    const auto end = static_cast<std::int64_t>(count);
#pragma omp parallel for schedule(static) if (count > parallel::serial_limit)
    for (std::int64_t k = 0; k < end; ++k) body(static_cast<std::size_t>(k));
}

/// Calls body(part) for every part in [0, count), each of which is worth a thread of its own.
template <class Body>
void parallel_for_parts(std::size_t count, Body&& body) {
    const auto end = static_cast<std::int64_t>(count);
#pragma omp parallel for schedule(static) if (count > 1)
    for (std::int64_t part = 0; part < end; ++part) body(static_cast<std::size_t>(part));
}

/// Calls body(block, begin, end) for consecutive blocks of `block_size` indices that cover [0, count).
template <class Body>
void parallel_for_blocks(std::size_t count, std::size_t block_size, Body&& body) {
    const auto blocks = static_cast<std::int64_t>((count + block_size - 1) / block_size);
#pragma omp parallel for schedule(static) if (count > parallel::serial_limit)
    for (std::int64_t block = 0; block < blocks; ++block) {
        const auto begin = static_cast<std::size_t>(block) * block_size;
        body(static_cast<std::size_t>(block), begin, std::min(begin + block_size, count));
    }
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
    double largest = floor;
    const auto end = static_cast<std::int64_t>(count);
#pragma omp parallel for schedule(static) reduction(max : largest) if (count > parallel::serial_limit)
    for (std::int64_t k = 0; k < end; ++k)
        largest = std::max(largest, static_cast<double>(value(static_cast<std::size_t>(k))));
    return largest;
}

/// The largest of 0 and all value(begin, end) over blocks that cover [0, count).
template <class Value>
double parallel_max_of_blocks(std::size_t count, Value&& value) {
    if (count <= parallel::serial_limit) return std::max(0.0, static_cast<double>(value(std::size_t{0}, count)));
    const std::size_t blocks = (count + parallel::sum_block - 1) / parallel::sum_block;
    double largest = 0.0;
    const auto end = static_cast<std::int64_t>(blocks);
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (std::int64_t block = 0; block < end; ++block) {
        const auto begin = static_cast<std::size_t>(block) * parallel::sum_block;
        largest = std::max(largest, static_cast<double>(value(begin, std::min(begin + parallel::sum_block, count))));
    }
    return largest;
}

}  // namespace jostle
