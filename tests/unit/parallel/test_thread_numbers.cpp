// Which numbers of threads are taken, and what is left of them after a fork.

#include <doctest/doctest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>

#include "jostle/error/input_error.hpp"
#include "jostle/parallel/parallel_for.hpp"

using namespace jostle;

// Sanitizers claim terabytes, and know no limit of memory.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define JOSTLE_IS_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define JOSTLE_IS_SANITIZED
#endif
#endif

namespace {

constexpr std::size_t many = 4 * parallel::serial_limit;

long long sum_of_squares() {
    return parallel_sum<long long>(many, [](std::size_t k) { return static_cast<long long>(k * k); });
}

/// What `act` returns in a child, which has ten seconds for it; -1 if it did not come to its end.
int in_child(const std::function<int()>& act) {
    const pid_t child = fork();
    if (child == 0) {
        alarm(10);
        _exit(act());
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

bool is_refused(long long count, const std::string& words) {
    try {
        parallel::set_thread_count(count, "--threads");
    } catch (const InputError& error) {
        return error.parts().key == "--threads" && std::string(error.what()).find(words) != std::string::npos;
    }
    return false;
}

/// Leaves the number as it was.
struct ThreadCount {
    int before = parallel::thread_count();
    ~ThreadCount() { parallel::set_thread_count(before); }
};

}  // namespace

TEST_CASE("a number of threads is one of 1 to 4096") {
    const ThreadCount restored;
    for (const long long count : {0LL, -1LL, 4097LL, 100000LL, 1LL << 40})
        CHECK(is_refused(count, "is no number of threads (allowed: 1 to 4096)"));
    parallel::set_thread_count(3);
    CHECK(parallel::thread_count() == 3);
}

#ifndef JOSTLE_IS_SANITIZED
TEST_CASE("more threads than the system starts are refused; OpenMP would end the program") {
    const int answer = in_child([] {
        const rlimit memory = {rlim_t{1} << 30, rlim_t{1} << 30};  // the stacks of some hundred threads
        setrlimit(RLIMIT_AS, &memory);
        if (!is_refused(2000, "the system does not start so many threads")) return 1;
        parallel::set_thread_count(2);
        return sum_of_squares() > 0 ? 0 : 2;
    });
    CHECK(answer == 0);
}
#endif

TEST_CASE("a child of a fork works on one thread, where it would wait for those of its parent for ever") {
    const ThreadCount restored;
    parallel::set_thread_count(2);
    const long long expected = sum_of_squares();
    CHECK(in_child([expected] { return sum_of_squares() == expected ? parallel::thread_count() : 9; }) == 1);
    CHECK(in_child([] { return is_refused(2, "was forked from one that had started threads") ? 0 : 9; }) == 0);
    CHECK(parallel::thread_count() == 2);
    CHECK(sum_of_squares() == expected);
}
