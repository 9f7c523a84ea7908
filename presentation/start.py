"""Starts a program of jostle by its path: start.py PROGRAM ARGUMENT...

The command calls this with the `python3` of PATH. A Python that is too old for the programs, which it could not even read, gives way to another.
"""

import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import other_python  # noqa: E402  (the path comes first)


def start():
    program = os.path.abspath(sys.argv[1])
    sys.argv = [program] + sys.argv[2:]
    if sys.version_info < other_python.OLDEST:
        python = other_python.that_has([])
        if python is None:
            return "jostle: %s: is Python %d.%d, older than 3.11. %s" % ((sys.executable,) + sys.version_info[:2] + (other_python.ADVICE,))
        other_python.go_on(python)
    import runpy

    sys.path[0] = os.path.dirname(program)
    runpy.run_path(program, run_name="__main__")


if __name__ == "__main__":
    reason = start()
    if reason:
        sys.stderr.write(reason + "\n")
        sys.exit(2)
