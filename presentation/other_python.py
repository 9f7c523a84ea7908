"""Another Python, where the one that was started cannot do: too old, or without a module. Any Python 3 can read this file.

The environment variable JOSTLE_PYTHON names the only one that is taken; else all that PATH and Debian have are asked.
"""

import os
import subprocess
import sys

OLDEST = (3, 11)
CHOICE = "JOSTLE_PYTHON"
OF_DEBIAN = "/usr/bin/python3"
ADVICE = "The environment variable JOSTLE_PYTHON names the Python to take"
ASK = ("import sys, importlib.util as search; "
       "sys.exit(sys.version_info < %r or any(search.find_spec(name) is None for name in sys.argv[1:]))" % (OLDEST,))
SECONDS = 20.0


def that_has(modules):
    """The first other Python that has these modules, or None."""
    for python in _others():
        try:
            answer = subprocess.run([python, "-B", "-c", ASK] + list(modules), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.DEVNULL, timeout=SECONDS)
        except (OSError, subprocess.TimeoutExpired):
            continue
        if answer.returncode == 0:
            return python
    return None


def go_on(python):
    """Begins this program anew with that Python, which then is the only one."""
    os.environ[CHOICE] = python
    sys.stdout.flush()
    os.execv(python, [python, "-B"] + sys.argv)


def _others():
    if os.environ.get(CHOICE):
        return []
    folders = [folder for folder in os.environ.get("PATH", "").split(os.pathsep) if os.path.isabs(folder)]
    found = []
    for python in [os.path.join(folder, "python3") for folder in folders] + [OF_DEBIAN]:
        if os.access(python, os.X_OK) and not any(os.path.samefile(python, other) for other in found):
            found.append(python)
    return [python for python in found if python != sys.executable]
