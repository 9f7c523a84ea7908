"""What the programs of this folder cannot do, told as the command tells it: one line, and an exit status."""

import errno
import importlib
import signal
import sys

import other_python

DONE, BAD_INPUT, DISK, STOPPED = 0, 2, 4, 75
FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


class Refusal(Exception):
    """Bad input: a clause for what is wrong, and a sentence for what to do."""

    def __init__(self, subject, problem, advice=""):
        super().__init__(f"{subject}: {problem}" + (f". {advice}" if advice else ""))

    def lines(self):
        return [str(self)]


class OtherPython(Exception):
    """The program is to begin anew, with the Python that stands here."""


required = set()  # modules, since the program began


def require_modules(packages):
    """Refuses to go on without the Python modules; `packages` names the Debian package of each. Raises OtherPython where another Python has them,
    and all that were asked for before."""
    required.update(packages)
    missing = []
    for module, package in packages.items():
        try:
            importlib.import_module(module)
        except ImportError:
            missing.append((module, package))
    if missing:
        python = other_python.that_has(sorted(required))
        if python:
            raise OtherPython(python)
        names = " and ".join(module for module, _ in missing)
        raise Refusal(f"Python module {names}", f"is not there for {sys.executable}",
                      "Run: apt-get install " + " ".join(package for _, package in missing) + f". {other_python.ADVICE}")


def on_one_line(text):
    """What a terminal would obey, line ends, and bytes of names that are no UTF-8, as \\n or \\x1b."""
    return "".join(letter if letter.isprintable() else _number(letter) for letter in text)


def _number(letter):
    if "\udc80" <= letter <= "\udcff":  # how Python keeps a byte that is no UTF-8
        return f"\\x{ord(letter) - 0xdc00:02x}"
    return letter.encode("unicode_escape").decode("ascii")


def _tell(*lines):
    print("jostle: " + "\n".join(map(on_one_line, lines)), file=sys.stderr)


def _stop(*_):
    raise KeyboardInterrupt


def exit_status(program):
    """Runs the program, and tells what went wrong on standard error in one line. Its result, if any, is the exit status."""
    signal.signal(signal.SIGTERM, _stop)  # so that what was begun is removed
    sys.stdout.reconfigure(errors="surrogateescape")  # names as they are
    try:
        return program() or DONE
    except OtherPython as other:
        other_python.go_on(str(other))
    except Refusal as refusal:
        _tell(*refusal.lines())
        return BAD_INPUT
    except OSError as error:
        room = "make room, or " if error.errno in FULL else ""
        _tell(f"{error.filename or 'output'}: cannot write: {error.strerror or error}. Nothing was changed; {room}give another "
              "place with --out")
        return DISK
    except KeyboardInterrupt:
        _tell("stopped, nothing was changed; run the same command again")
        return STOPPED
