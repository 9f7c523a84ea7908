"""Outputs appear whole or not at all, and replace nothing but what the same command made before.

What is written lies beside the output until it is whole, under a name that nothing had; its maker holds a lock on it. So what
a kill left there is known by its name and by its lock, which nobody holds, and the next command removes it.
"""

import contextlib
import fcntl
import os
import re
import shutil
import tempfile
from pathlib import Path

from refusal import Refusal

LEFT = re.compile(r"\.jostle-[a-z0-9_]{8}\.tmp")


def place(out, default, name_in_folder=None):
    """Where the output goes: `out` as the user gave it (a file may be given by its folder), else the default."""
    target = Path(out) if out else Path(default)
    if name_in_folder and target.is_dir():
        target = target / name_in_folder
    if not target.absolute().parent.is_dir():
        raise Refusal(target.absolute().parent, "there is no such folder", "Make it first, or give another --out")
    return target


def keep_temporary_files_in(folder):
    """Matplotlib keeps its list of fonts in the user's own folder, or, without one, where all users do."""
    tempfile.tempdir = str(folder)
    if not os.access(Path.home(), os.W_OK):
        os.environ.setdefault("MPLCONFIGDIR", str(folder))


@contextlib.contextmanager
def replaced_file(target, is_ours):
    """Gives a temporary name to write to; at the end it becomes the target. `is_ours(path)`: may be replaced."""
    if os.path.lexists(target) and not (target.is_file() and is_ours(target)):
        raise _taken(target)
    with named(target), beside(target, _new_file) as temporary:
        yield temporary
        _sync(temporary)
        os.replace(temporary, target)


@contextlib.contextmanager
def replaced_folder(target, is_ours):
    """The same for a folder; an empty one is taken too."""
    if os.path.lexists(target) and not (target.is_dir() and (not any(target.iterdir()) or is_ours(target))):
        raise _taken(target)
    with named(target), beside(target) as temporary, beside(target) as aside:
        yield temporary
        for path in temporary.rglob("*"):
            _sync(path)
        old = aside / "old"
        if target.exists():
            os.rename(target, old)
        try:
            os.rename(temporary, target)
        except OSError:
            if old.exists():
                os.rename(old, target)
            raise


def _new_folder(**name):
    return None, tempfile.mkdtemp(**name)


def _new_file(**name):
    return tempfile.mkstemp(**name)


@contextlib.contextmanager
def beside(target, make=_new_folder):
    """A new folder, or file, beside the target; what is left of it at the end is removed."""
    parent = target.absolute().parent
    for path in parent.iterdir():
        if LEFT.fullmatch(path.name):
            _remove_if_left(path)
    lock = None
    while lock is None:
        descriptor, name = make(prefix=".jostle-", suffix=".tmp", dir=parent)
        temporary = Path(name)
        if descriptor is not None:
            os.close(descriptor)
        lock = _lock(temporary)
    try:
        os.chmod(temporary, (0o777 if temporary.is_dir() else 0o666) & ~_umask())  # as other files are made
        yield temporary
    finally:
        _remove(temporary)
        os.close(lock)


def _lock(path):
    """A descriptor that holds the lock; None where another process holds it, or has removed what is there."""
    try:
        descriptor = os.open(path, os.O_RDONLY | os.O_NOFOLLOW)
    except OSError:
        return None
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        if os.path.samestat(os.fstat(descriptor), os.lstat(path)):
            return descriptor
    except OSError:
        pass
    os.close(descriptor)
    return None


def _remove_if_left(path):
    lock = _lock(path)
    if lock is not None:
        _remove(path)
        os.close(lock)


def _remove(path):
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        with contextlib.suppress(OSError):
            path.unlink()


def _umask():
    mask = os.umask(0o077)
    os.umask(mask)
    return mask


@contextlib.contextmanager
def named(target):
    """Errors of writing, some of which know no name, tell that of the output."""
    try:
        yield
    except OSError as error:
        error.filename, error.filename2 = str(target), None
        raise


def _sync(path):
    if path.is_file():
        with open(path, "rb") as file:
            os.fsync(file.fileno())


def _taken(target):
    return Refusal(target, "this is there already, and not from this command: it is not replaced",
                   "Move it away, or give another name with --out")
