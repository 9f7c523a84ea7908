#pragma once

/// Ctrl-C, SIGTERM and a terminal that is closed (SIGHUP): the first asks the run to stop at the step at hand, the
/// second ends the process at once. SIGUSR1, which launchers pass on to all ranks, asks the same, however often it
/// comes. Before the first step, while a start is made or a checkpoint read, the first does.
namespace stop_request {

/// Signals wait from here to `release`, also while the program begins once more.
void hold();
void release();

/// From now on signals are requests.
void install();

/// Not even where a signal ends the process: the first of several ranks says it for all.
void say_nothing();

/// From now on steps are made.
void wait_for_steps();

/// Whether a stop has been asked for; and by which signal (0: none).
int signal_received();

}  // namespace stop_request
