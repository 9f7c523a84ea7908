"""A full disk: exit 4 and a message, nothing sound is lost, and after room is made the same command goes on."""

import os
import resource
import signal
import subprocess

import pytest

from jostle_command import (DISK, DONE, RODS, STOPPED, changed, checkpoint_step, command, finish, kill, lines_but_notices,
                            require_same_results, rows_of, run, start, wait_until, with_steps, write_scene)

ADVICE = "Make room and run the same command again: it goes on from the last checkpoint"

# Scenes in which one file, at the time it is written, is the largest by far.
NO_OTHER = {"trajectory_every": 0, "contacts": False}
SCENES = {
    "series.csv": changed(RODS, output={**NO_OTHER, "series_every": 1}),
    "contacts.csv": changed(RODS, output={**NO_OTHER, "contacts": True}),
    "trajectory.journal": changed(RODS, output={**NO_OTHER, "trajectory_every": 1, "series_every": 50}),
    "trajectory.h5": changed(with_steps(RODS, 10), output={**NO_OTHER, "trajectory_every": 5}),
    "checkpoint": changed(RODS, rods={"count": 300}, output={**NO_OTHER, "series_every": 50}),
}


def file_size_limit(size):
    """For preexec_fn: no file grows beyond the size; a write that would fails with EFBIG."""
    return lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))


def require_disk_error(result, name=""):
    assert result.returncode == DISK, (result.returncode, result.stdout, result.stderr)
    assert result.stdout == ""
    lines = lines_but_notices(result.stderr)
    assert len(lines) == 1 and lines[0].startswith("jostle: "), result.stderr
    assert name in lines[0] and ADVICE in lines[0], result.stderr


@pytest.mark.parametrize("name", SCENES)
def test_each_file_hits_the_limit(tmp_path, name):
    write_scene(tmp_path / "reference", SCENES[name])
    reference = finish(tmp_path / "reference")
    sizes = {entry.name: entry.stat().st_size for entry in reference.iterdir()}
    limit = sizes[name] - 1 if name in ("checkpoint", "trajectory.h5") else 2 * sizes[name] // 3
    assert limit > max(size for other, size in sizes.items()
                       if other not in (name, "trajectory.h5", "checkpoint.previous")), sizes

    write_scene(tmp_path / "limited", SCENES[name])
    folder = tmp_path / "limited/run"
    require_disk_error(run(tmp_path / "limited", preexec_fn=file_size_limit(limit)), f"run/{name}")
    assert not list(folder.glob("*.tmp"))
    if name != "checkpoint":  # there the very first one failed
        assert command(tmp_path / "limited", "verify", "run").returncode == DONE
    step = checkpoint_step(folder) if (folder / "checkpoint").exists() else 0
    again = run(tmp_path / "limited", preexec_fn=file_size_limit(limit))  # still no room: nothing gets worse
    require_disk_error(again, f"run/{name}")
    if (folder / "checkpoint").exists():
        assert checkpoint_step(folder) >= step
    assert run(tmp_path / "limited").returncode == DONE
    require_same_results(folder, reference)


@pytest.mark.parametrize("limit", [0, 10, 100, 400, 1000, 3000])
def test_no_room_to_begin(tmp_path, limit):
    """The first files already fail: lock, scene, resolved scene, record, description of the series."""
    write_scene(tmp_path / "reference", RODS)
    reference = finish(tmp_path / "reference")
    write_scene(tmp_path / "limited", RODS)
    result = run(tmp_path / "limited", preexec_fn=file_size_limit(limit))
    require_disk_error(result)
    assert not list((tmp_path / "limited/run").glob("*.tmp"))
    result = run(tmp_path / "limited")
    assert result.returncode == DONE, result.stderr
    require_same_results(tmp_path / "limited/run", reference)


def test_fresh_without_room_keeps_the_old_run(finished, finished_copy):
    result = run(finished_copy, "--fresh", preexec_fn=file_size_limit(100))
    assert result.returncode == DISK and ADVICE in result.stderr
    require_same_results(finished_copy / "run.1", finished / "run")


@pytest.fixture
def small_disk(tmp_path):
    """A file system of 1 MB of its own; needs root."""
    folder = tmp_path / "disk"
    folder.mkdir()
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1m", "tmpfs", folder], capture_output=True)
    if mounted.returncode != 0:
        pytest.skip("a small file system cannot be mounted here: " + mounted.stderr.decode().strip())
    yield folder
    subprocess.run(["umount", folder], check=True)


def fill(folder, left):
    """Fills the file system but for `left` bytes, in whole pages."""
    free = os.statvfs(folder).f_bavail * os.statvfs(folder).f_frsize
    (folder / "filler").write_bytes(b"\0" * (free - left))


@pytest.mark.parametrize("left", [0, 16 * 1024, 64 * 1024, 160 * 1024])
def test_disk_fills_up(tmp_path, small_disk, left):
    write_scene(tmp_path / "reference", RODS)
    reference = finish(tmp_path / "reference")
    write_scene(small_disk, RODS)
    fill(small_disk, left)
    require_disk_error(run(small_disk), "No space left on device")
    (small_disk / "filler").unlink()
    assert run(small_disk).returncode == DONE
    require_same_results(small_disk / "run", reference)


def test_disk_fills_up_after_a_checkpoint(small_disk):
    """What the checkpoint stands for survives the failure, byte for byte."""
    write_scene(small_disk, with_steps(RODS, 10**6))
    process = start(small_disk)
    wait_until(lambda: rows_of(small_disk / "run/series.csv") > 4, process)
    assert kill(process, signal.SIGTERM)[0] == STOPPED
    step = checkpoint_step(small_disk / "run")
    before = {name: (small_disk / "run" / name).read_bytes() for name in ("series.csv", "contacts.csv")}
    fill(small_disk, 8 * 1024)
    require_disk_error(run(small_disk), "No space left on device")
    assert checkpoint_step(small_disk / "run") >= step
    for name, content in before.items():
        assert (small_disk / "run" / name).read_bytes().startswith(content)
    verified = command(small_disk, "verify", "run")
    assert verified.returncode == DONE, verified.stderr
