#include "standard_streams.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "exit_code.hpp"

void open_standard_streams() {
    for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(number, F_GETFD) >= 0 || errno != EBADF) continue;
        // The lowest free number is given, and those below are taken. Without /dev/null nothing could even be told.
        if (::open("/dev/null", O_RDWR) != number) ::_exit(static_cast<int>(ExitCode::disk));
    }
}

std::string output_failure() {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return "";
    const std::string reason = errno != 0 ? std::string(": ") + std::strerror(errno) : "";  // of an earlier part: lost
    return "standard output: cannot write" + reason + "; what was printed is not whole";
}
