#include "stop_request.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "exit_code.hpp"

namespace {

volatile std::sig_atomic_t received = 0, makes_steps = 0, is_silent = 0;

sigset_t stopping_signals() {
    sigset_t signals;
    sigemptyset(&signals);
    for (const int number : {SIGINT, SIGTERM, SIGHUP, SIGUSR1}) sigaddset(&signals, number);
    return signals;
}

void on_signal(int signal) {
    // What is on disk is sound at any moment, so stopping at once loses only the steps since the last checkpoint.
    if (makes_steps == 0 && is_silent == 0) {
        constexpr std::string_view message = "jostle: stopped before a step was made\n";
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
    }
    if ((received != 0 && signal != SIGUSR1) || makes_steps == 0) _exit(static_cast<int>(ExitCode::stopped_early));
    if (received == 0) received = signal;
}

}  // namespace

namespace stop_request {

void hold() {
    const sigset_t signals = stopping_signals();
    sigprocmask(SIG_BLOCK, &signals, nullptr);
}

void release() {
    const sigset_t signals = stopping_signals();
    sigprocmask(SIG_UNBLOCK, &signals, nullptr);
}

void install() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    sigaction(SIGUSR1, &action, nullptr);
    struct sigaction hang_up {};
    sigaction(SIGHUP, nullptr, &hang_up);
    if (hang_up.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);  // nohup has it ignored
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error of the write, like a full disk
}

void say_nothing() {
    is_silent = 1;
}

void wait_for_steps() {
    makes_steps = 1;
}

int signal_received() {
    return received;
}

}  // namespace stop_request
