#include "progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace {

constexpr double seconds_between_terminal_lines = 0.2;
constexpr double seconds_between_plain_lines = 30.0;

std::string duration(double seconds) {
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole >= 3600) return fmt::format("{}h{:02}m", whole / 3600, whole / 60 % 60);
    if (whole >= 60) return fmt::format("{}m{:02}s", whole / 60, whole % 60);
    return fmt::format("{}s", whole);
}

}  // namespace

ProgressLine::ProgressLine(bool quiet)
    : quiet_(quiet), terminal_(isatty(STDERR_FILENO) == 1), begin_(Clock::now()), last_(begin_) {}

ProgressLine::~ProgressLine() {
    if (terminal_ && shown_) std::fputc('\n', stderr);
}

bool ProgressLine::is_due() const {
    const double since_last = std::chrono::duration<double>(Clock::now() - last_).count();
    return !quiet_ &&
           (!begun_ || since_last >= (terminal_ ? seconds_between_terminal_lines : seconds_between_plain_lines));
}

void ProgressLine::show(const Now& now) {
    if (quiet_) return;
    const auto here = Clock::now();
    if (!begun_) {
        begun_ = true;
        begin_ = last_ = here;
        first_step_ = now.step;
        first_fraction_ = now.fraction_done;
        return;
    }
    last_ = here;
    const double elapsed = std::chrono::duration<double>(here - begin_).count();
    const double steps_per_second = static_cast<double>(now.step - first_step_) / (elapsed > 0.0 ? elapsed : 1.0);
    const double gained = now.fraction_done - first_fraction_;
    const char* at_least = now.cells_grow && now.fraction_done < 1.0 ? "more than " : "";
    const std::string left = gained > 0.0 ? at_least + duration(elapsed * (1.0 - now.fraction_done) / gained) : "?";
    const std::string line = fmt::format(
        "step {}  t {:.4g}  phi {:.4f}  Z {:.3f}  overlap {:.1e} D  iterations {:.0f}  contacts {:.0f}  "
        "{:.0f} steps/s  {} left{}{}",
        now.step, now.time, now.phi, now.Z, now.max_overlap_in_D, now.iterations, now.contacts, steps_per_second, left,
        now.remark.empty() ? "" : "  ", now.remark);
    std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", line.c_str());
    std::fflush(stderr);
    shown_ = true;
}
