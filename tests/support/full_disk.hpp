#pragma once

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

/// Runs `call` in a child process in which no file may grow beyond `bytes`, like a disk that is full then (the error is
/// EFBIG in place of ENOSPC). Result: the child's exit code, which is what `call` returns, or -1 if a signal ended it.
template <class Call>
int with_file_size_limit(rlim_t bytes, Call call) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{bytes, bytes};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        int code = 99;
        try {
            code = call();
        } catch (...) {
        }
        ::_exit(code);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}
