"""What the programs of this folder cannot do, told as the command tells it: one line, and an exit status."""

import importlib
import signal
import sys

DONE, BAD_INPUT, DISK, STOPPED = 0, 2, 4, 75


class Refusal(Exception):
    """Bad input: a clause for what is wrong, and a sentence for what to do."""

    def __init__(self, subject, problem, advice=""):
        super().__init__(f"{subject}: {problem}" + (f". {advice}" if advice else ""))


def require_modules(packages):
    """Refuses to go on without the Python modules; `packages` names the Debian package of each."""
    missing = []
    for module, package in packages.items():
        try:
            importlib.import_module(module)
        except ImportError:
            missing.append((module, package))
    if missing:
        names = " and ".join(module for module, _ in missing)
        raise Refusal(f"Python module {names}", "is not there",
                      "Run: apt-get install " + " ".join(package for _, package in missing))


def _stop(*_):
    raise KeyboardInterrupt


def exit_status(program):
    """Runs the program, and tells what went wrong on standard error in one line."""
    signal.signal(signal.SIGTERM, _stop)  # so that what was begun is removed
    try:
        program()
        return DONE
    except Refusal as refusal:
        print(f"jostle: {refusal}", file=sys.stderr)
        return BAD_INPUT
    except OSError as error:
        reason = error.strerror or str(error)
        print(f"jostle: {error.filename or 'output'}: cannot write: {reason}. Nothing was changed; make room, or give "
              "another place with --out", file=sys.stderr)
        return DISK
    except KeyboardInterrupt:
        print("jostle: stopped, nothing was changed; run the same command again", file=sys.stderr)
        return STOPPED
