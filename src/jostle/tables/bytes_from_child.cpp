#include "jostle/tables/bytes_from_child.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

#include "jostle/disk/durable_file.hpp"

namespace jostle {

namespace {

// The last byte that the child writes: without it, it has not come to its end.
constexpr char whole = 'w', without_memory = 'm';

void limit_to(rlim_t most, decltype(RLIMIT_CORE) resource) {
    rlimit limit{};
    ::getrlimit(resource, &limit);
    limit.rlim_cur = std::min(limit.rlim_max, most);
    ::setrlimit(resource, &limit);
}

[[noreturn]] void be_the_child(int answer, double seconds, const std::function<std::string()>& make) {
    limit_to(0, RLIMIT_CORE);
    limit_to(static_cast<rlim_t>(seconds), RLIMIT_CPU);
    const int nowhere = ::open("/dev/null", O_RDWR);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
        if (standard != answer) ::dup2(nowhere, standard);
    bool told = false;
    try {
        told = write_to(answer, make() + whole);
    } catch (const std::bad_alloc&) {
        told = write_to(answer, std::string(1, without_memory));
    } catch (...) {  // told by what is missing
    }
    ::_exit(told ? 0 : 1);
}

std::string everything_from(int descriptor) {
    std::string bytes;
    std::array<char, 1 << 16> block{};
    for (;;) {
        const ssize_t got = ::read(descriptor, block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return bytes;
        bytes.append(block.data(), static_cast<std::size_t>(got));
    }
}

/// Waits for the child. Empty, or a clause that tells of the signal that ended it.
std::string end_of(pid_t child) {
    int status = 0;
    pid_t ended = 0;
    do ended = ::waitpid(child, &status, 0);
    while (ended < 0 && errno == EINTR);
    if (ended < 0 || !WIFSIGNALED(status)) return "";
    return std::string(" (signal: ") + ::strsignal(WTERMSIG(status)) + ")";
}

}  // namespace

std::string bytes_from_child(const std::string& path, double seconds, const std::function<std::string()>& make) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) < 0)
        throw std::runtime_error(std::string("cannot make a pipe: ") + std::strerror(errno));
    const pid_t child = ::fork();
    const int error_number = errno;
    if (child == 0) be_the_child(ends[1], seconds, make);
    ::close(ends[1]);
    if (child < 0) {
        ::close(ends[0]);
        throw std::runtime_error(path + ": cannot start a process that reads it: " + std::strerror(error_number));
    }
    std::string bytes;
    try {
        bytes = everything_from(ends[0]);
    } catch (...) {
        ::close(ends[0]);  // the child, which may be within a write, then ends
        end_of(child);
        throw;
    }
    ::close(ends[0]);
    const std::string signal = end_of(child);
    const char last = bytes.empty() ? '\0' : bytes.back();
    if (last == without_memory && bytes.size() == 1) throw std::bad_alloc();
    if (last != whole) throw refused_file(path, "the library that reads it failed" + signal, "The file is damaged");
    bytes.pop_back();
    return bytes;
}

}  // namespace jostle
