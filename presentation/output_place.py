"""Outputs appear whole or not at all, and replace nothing but what the same command made before."""

import contextlib
import os
import shutil
from pathlib import Path

from refusal import Refusal


def place(out, default, name_in_folder=None):
    """Where the output goes: `out` as the user gave it (a file may be given by its folder), else the default."""
    target = Path(out) if out else Path(default)
    if name_in_folder and target.is_dir():
        target = target / name_in_folder
    if not target.absolute().parent.is_dir():
        raise Refusal(target.absolute().parent, "there is no such folder", "Make it first, or give another --out")
    return target


@contextlib.contextmanager
def replaced_file(target, is_ours):
    """Gives a temporary name to write to; at the end it becomes the target. `is_ours(path)`: may be replaced."""
    if os.path.lexists(target) and not (target.is_file() and is_ours(target)):
        raise _taken(target)
    temporary = _beside(target)
    try:
        temporary.touch()  # with the usual permissions; some writers would choose their own
        yield temporary
        _sync(temporary)
        os.replace(temporary, target)
    finally:
        temporary.unlink(missing_ok=True)


@contextlib.contextmanager
def replaced_folder(target, is_ours):
    """The same for a folder; an empty one is taken too."""
    if os.path.lexists(target) and not (target.is_dir() and (not any(target.iterdir()) or is_ours(target))):
        raise _taken(target)
    temporary, old = _beside(target), _beside(target, "old")
    try:
        os.mkdir(temporary)
        yield temporary
        for path in temporary.rglob("*"):
            _sync(path)
        if target.exists():
            os.rename(target, old)
        os.rename(temporary, target)
    finally:
        if old.exists() and not target.exists():
            os.rename(old, target)
        for folder in (temporary, old):
            shutil.rmtree(folder, ignore_errors=True)


def _beside(target, ending="tmp"):
    target = target.absolute()
    return target.with_name(f".{target.name}.{os.getpid()}.{ending}")


def _sync(path):
    if path.is_file():
        with open(path, "rb") as file:
            os.fsync(file.fileno())


def _taken(target):
    return Refusal(target, "this is there already, and not from this command: it is not replaced",
                   "Move it away, or give another name with --out")
