"""The command `jostle` of the installed Python package: hands over to the program that lies in the package."""

import os
import sys

PROGRAM = os.path.join(os.path.dirname(os.path.abspath(__file__)), "jostle", "command", "bin", "jostle")


def main():
    # Reports, films and sweeps run with this Python: pip has installed what they need for it.
    os.environ.setdefault("JOSTLE_PYTHON", sys.executable)
    os.execv(PROGRAM, sys.argv)
