"""Running another program that ends when this one is told to end."""

import signal
import subprocess

SECONDS_DEAF = 0.5  # a signal that comes just before a wait begins is heard only when it ends


def run(words, folder):
    """Runs a program in the folder to its end. Result: its status, and what it said on standard error."""
    stopped = []
    with_signals = {number: signal.signal(number, lambda *_: stopped.append(True))
                    for number in (signal.SIGINT, signal.SIGTERM)}
    process = None
    try:
        # A signal while the program starts must wait until there is something to end.
        process = subprocess.Popen(words, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        _restore(with_signals)
        if stopped:
            raise KeyboardInterrupt
        errors = _errors_of(process)
        return process.returncode, errors
    finally:
        if process:
            process.kill()  # does nothing to one that has ended
            process.wait()
        _restore(with_signals)


def _errors_of(process):
    while True:
        try:
            return process.communicate(timeout=SECONDS_DEAF)[1]
        except subprocess.TimeoutExpired:
            pass


def _restore(with_signals):
    for number, action in with_signals.items():
        signal.signal(number, action)
