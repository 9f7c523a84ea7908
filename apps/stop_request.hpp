#pragma once

/// Ctrl-C and SIGTERM: the first asks the run to stop after the step at hand, the second ends the process at once.
namespace stop_request {

void install();

/// Whether a stop has been asked for; and by which signal (0: none).
int signal_received();

}  // namespace stop_request
