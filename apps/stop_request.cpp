#include "stop_request.hpp"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "exit_code.hpp"

namespace {

volatile std::sig_atomic_t received = 0, makes_steps = 0;

void on_signal(int signal) {
    // What is on disk is sound at any moment, so stopping at once loses only the steps since the last checkpoint.
    if (makes_steps == 0) {
        constexpr std::string_view message = "jostle: stopped before a step was made\n";
        [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, message.data(), message.size());
    }
    if (received != 0 || makes_steps == 0) _exit(static_cast<int>(ExitCode::stopped_early));
    received = signal;
}

}  // namespace

namespace stop_request {

void install() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is then an error of the write, like a full disk
}

void wait_for_steps() {
    makes_steps = 1;
}

int signal_received() {
    return received;
}

}  // namespace stop_request
