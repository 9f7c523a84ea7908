#include <omp.h>
#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstdlib>
#include <latch>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "jostle/error/refuse.hpp"
#include "jostle/parallel/parallel_for.hpp"

namespace jostle::parallel {

namespace {

/// For fewer, loops are so short that another thread saves no more than waiting for it takes (docs/performance.md).
constexpr std::size_t rods_per_thread = 2000;
constexpr int max_threads = 4096;

const auto processors = static_cast<std::size_t>(omp_get_num_procs());
std::atomic<std::size_t> own_processors = processors;  ///< of these, less where others use them, too
const char* const environment = std::getenv("OMP_NUM_THREADS");
std::atomic<int> chosen = 0;  ///< 0: OpenMP's own, which belongs to the calling thread
std::atomic<int> start = 1;   ///< so many have been seen to start
std::atomic<int> max_that_start = max_threads;

// A child of a fork has one thread. OpenMP would wait there for ever for those that it had started in the parent.
std::atomic<bool> has_started = false, is_forked = false;
[[maybe_unused]] const int at_fork = pthread_atfork(nullptr, nullptr, [] { is_forked = has_started.load(); });

/// Starts threads that only wait, and ends them. Where one cannot be started, OpenMP would end the program.
int seen_to_start(int wanted) {
    std::latch all_are_there(1);
    std::vector<std::thread> others;
    try {
        others.reserve(static_cast<std::size_t>(wanted));
        for (int k = 1; k < wanted; ++k) others.emplace_back([&all_are_there] { all_are_there.wait(); });
    } catch (const std::system_error&) {
    } catch (const std::bad_alloc&) {
    }
    all_are_there.count_down();
    for (std::thread& other : others) other.join();
    return static_cast<int>(others.size()) + 1;
}

/// So many threads, or as many of them as the system starts.
int as_many_as_start(int wanted) {
    if (wanted > max_that_start) return max_that_start;
    if (wanted <= start) return wanted;
    const int found = seen_to_start(wanted);
    if (found < wanted) max_that_start = found;
    start = std::max(start.load(), found);
    return found;
}

/// The one range of all numbers of threads, whoever asks for them.
int checked(long long count, const char* key, const std::string& value) {
    if (count < 1 || count > max_threads)
        refuse(key, value, "is no number of threads", "1 to " + std::to_string(max_threads));
    const int found = as_many_as_start(static_cast<int>(count));
    if (found < count)
        refuse(key, value, "the system does not start so many threads", "1 to " + std::to_string(found),
               "Its limits of memory and processes (ulimit -v, -u) stand in the way");
    return found;
}

/// The number in OMP_NUM_THREADS, which may be a list with a number for each level of loops; 0 if there is none.
int number_in_environment() {
    if (!environment) return 0;
    const std::string_view text = environment;
    const auto first = std::min(text.find_first_not_of(" \t"), text.size());
    long long count = 0;
    const auto [end, error] = std::from_chars(text.data() + first, text.data() + text.size(), count);
    const auto rest = text.find_first_not_of(" \t", static_cast<std::size_t>(end - text.data()));
    const bool whole = error == std::errc{} && (rest == std::string_view::npos || text[rest] == ',');
    return checked(whole ? count : 0, "OMP_NUM_THREADS", environment);
}

}  // namespace

void set_thread_count(long long count, const char* asked_by) {
    if (is_forked && count > 1)
        refuse(asked_by, std::to_string(count), "this process was forked from one that had started threads", "1",
               "Start it anew instead: multiprocessing.set_start_method(\"spawn\")");
    chosen = checked(count, asked_by, std::to_string(count));
}

bool thread_count_is_free() {
    return chosen == 0 && !environment && !is_forked;
}

int worthwhile_thread_count(std::size_t rods) {
    const auto most = std::min(own_processors.load(), static_cast<std::size_t>(max_that_start));
    return static_cast<int>(std::clamp(rods / rods_per_thread, std::size_t{1}, most));
}

void share_processors(int processes) {
    const auto online = static_cast<std::size_t>(std::max(1, omp_get_num_procs()));
    const auto machine = std::max(online, static_cast<std::size_t>(std::thread::hardware_concurrency()));
    own_processors = std::clamp(machine / static_cast<std::size_t>(std::max(1, processes)), std::size_t{1}, online);
}

void suit_thread_count(int count) {
    if (thread_count_is_free()) omp_set_num_threads(count);
}

int thread_count() {
    if (is_forked) return 1;
    if (chosen > 0) return chosen;
    static const int from_environment = number_in_environment();
    return from_environment > 0 ? from_environment : std::min(omp_get_max_threads(), max_threads);
}

int team_size(bool on_one) {
    if (on_one) return 1;
    const int count = as_many_as_start(thread_count());
    if (count > 1) has_started = true;
    return count;
}

int thread_number() {
    return omp_get_thread_num();
}

std::pair<std::size_t, std::size_t> own_share(std::size_t count) {
    const auto threads = static_cast<std::size_t>(omp_get_num_threads());
    const auto own = static_cast<std::size_t>(omp_get_thread_num());
    return {count * own / threads, count * (own + 1) / threads};
}

}  // namespace jostle::parallel
