"""Which Python runs the Python programs of the command: what JOSTLE_PYTHON names, else the python3 of PATH, else one that has what they need."""

import os
import sys
from pathlib import Path

import pytest

from jostle_command import BAD_INPUT, DONE, command, require_one_line

WORDS = ("export", "run", "--to", "xyz")


def python_in(folder, line):
    """A program python3 in a folder of its own that writes "asked" and does what the line says."""
    folder.mkdir()
    program = folder / "python3"
    program.write_text(f"#!/bin/sh\necho asked >> {folder}/asked\n{line}\n")
    program.chmod(0o755)
    return program


def surroundings(path, **others):
    kept = {name: value for name, value in os.environ.items() if name != "JOSTLE_PYTHON"}
    return {**kept, "PATH": f"{path}:/bin", **others}


def test_the_one_of_path(finished_copy):
    first = python_in(finished_copy / "first", f'exec {sys.executable} "$@"')
    result = command(finished_copy, *WORDS, env=surroundings(first.parent))
    assert result.returncode == DONE and (first.parent / "asked").read_text() == "asked\n", result.stderr


@pytest.mark.parametrize("old", [False, True], ids=["lacks modules", "too old"])
def test_one_that_cannot_gives_way_to_another(finished_copy, old):
    """As a python3 of a user's own before Debian's in PATH."""
    line = f'exec {sys.executable} -S "$@"'  # without the folders in which modules are installed
    if old:
        shown = finished_copy / "shown"
        shown.mkdir()
        (shown / "sitecustomize.py").write_text("import sys\nsys.version_info = (3, 9, 2)\n")
        line = f'PYTHONPATH={shown} exec {sys.executable} "$@"'
    first = python_in(finished_copy / "first", line)
    second = python_in(finished_copy / "second", f'unset PYTHONPATH\nexec {sys.executable} "$@"')
    result = command(finished_copy, *WORDS, env=surroundings(f"{first.parent}:{second.parent}"))
    assert result.returncode == DONE, result.stderr
    assert (first.parent / "asked").exists() and (second.parent / "asked").read_text() == "asked\nasked\n"  # has it, and does it
    assert (finished_copy / "run/trajectory.xyz").exists()


def test_none_that_can(finished_copy):
    """Where none has the modules, the first says what is missing."""
    bare = python_in(finished_copy / "bare", f'exec {sys.executable} -S "$@"')
    require_one_line(command(finished_copy, *WORDS, env=surroundings(bare.parent, JOSTLE_PYTHON=str(bare))),
                     "Python module numpy and h5py: is not there", "apt-get install python3-numpy python3-h5py", "JOSTLE_PYTHON")


def test_a_name_is_looked_for_in_path(finished_copy):
    chosen = python_in(finished_copy / "chosen", f'exec {sys.executable} "$@"')
    chosen.rename(chosen.with_name("mine"))
    result = command(finished_copy, *WORDS, env=surroundings(chosen.parent, JOSTLE_PYTHON="mine"))
    assert result.returncode == DONE and (chosen.parent / "asked").exists()


@pytest.mark.parametrize("chosen, words", [("nowhere", "PATH has no such program"), ("/usr/nowhere/python3", "this Python does not start"),
                                           ("./python3", "this Python does not start")])
def test_a_choice_that_is_none(finished_copy, chosen, words):
    result = command(finished_copy, *WORDS, env=surroundings(Path("/nowhere"), JOSTLE_PYTHON=chosen))
    assert result.returncode == BAD_INPUT
    require_one_line(result, chosen, words, "JOSTLE_PYTHON")
