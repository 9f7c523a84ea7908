"""kill -9 at any moment: the same command goes on from the checkpoint and ends as if nothing had been."""

import json
import shutil
import signal
import subprocess
import time

import pytest

from jostle_command import (DONE, RODS, SPHERES, changed, checkpoint_step, command, finish, random_numbers,
                            require_every_row, require_same_results, rows_of, run, start, with_steps, write_scene)
from read_h5md import read as read_h5md

KILLS = 16
MOST_RUNS = 30


def run_with_kills(folder, longest_life, random):
    """Kills the run after at most `longest_life` seconds, again and again, until its end. Returns the kills."""
    kills = 0
    while True:
        process = start(folder)
        try:
            process.communicate(timeout=random.uniform(0.0, longest_life))
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
        if process.returncode == DONE:
            return kills
        assert process.returncode == -signal.SIGKILL, process.returncode
        kills += 1
        assert kills < 200, "the run gets nowhere"
        if (folder / "run/checkpoint").exists() or (folder / "run/checkpoint.previous").exists():
            verified = command(folder, "verify", "run")
            assert verified.returncode == DONE, f"a kill left a damaged file: {verified.stderr}"


@pytest.mark.parametrize("checkpoint_every", [7, 60])
def test_killed_at_random_moments(tmp_path, checkpoint_every):
    steps = 20 * checkpoint_every + 11
    scene = changed(with_steps(RODS, steps), output={"checkpoint_every": checkpoint_every, "series_every": 1,
                                                     "trajectory_every": 3})
    random = random_numbers()
    write_scene(tmp_path / "reference", scene)
    began = time.monotonic()
    reference = finish(tmp_path / "reference")
    lasted = time.monotonic() - began
    require_every_row(reference, 1, steps)

    kills = []
    while sum(kills) < KILLS and len(kills) < MOST_RUNS:
        folder = tmp_path / f"killed_{len(kills)}"
        write_scene(folder, scene)
        kills.append(run_with_kills(folder, lasted, random))
        require_same_results(folder / "run", reference)
        require_every_row(folder / "run", 1, steps)
        assert read_h5md(folder / "run/trajectory.h5")["steps"] == list(range(0, steps + 1, 3))
        sessions = json.loads((folder / "run/run.json").read_text())["sessions"]
        for killed, next_one in zip(sessions, sessions[1:]):  # the record follows the checkpoint
            assert 0 <= next_one["first_step"] - killed["last_step"] <= checkpoint_every and killed["wall_seconds"] > 0
    print(f"kills of each run: {kills}")
    assert sum(kills) >= KILLS
    assert max(kills) >= 2


def half_of(path):
    content = path.read_bytes()
    return content[:len(content) // 2]


def tear_series(folder):
    with open(folder / "series.csv", "ab") as file:
        file.write(b"105,2.1,50,0.2")


def tear_contacts(folder):
    with open(folder / "contacts.csv", "ab") as file:
        file.write(b"105,3,")


def tear_journal(folder):
    content = (folder / "trajectory.journal").read_bytes()
    with open(folder / "trajectory.journal", "ab") as file:
        file.write(content[16:1000])


def leave_half_a_checkpoint(folder):
    (folder / "checkpoint.tmp").write_bytes(half_of(folder / "checkpoint"))


def leave_between_renames(folder):
    """The new checkpoint is whole, the one before has been renamed, and then the process ended."""
    shutil.copy(folder / "checkpoint", folder / "checkpoint.tmp")
    (folder / "checkpoint").rename(folder / "checkpoint.previous")


def leave_half_a_record(folder):
    (folder / "run.json.tmp").write_bytes(half_of(folder / "run.json"))


def leave_half_a_trajectory(folder):
    (folder / "trajectory.h5.tmp").write_bytes(half_of(folder / "trajectory.h5"))
    (folder / "trajectory.h5").unlink()


def lose_the_summary(folder):
    (folder / "summary.json.tmp").write_bytes(half_of(folder / "summary.json"))
    (folder / "summary.json").unlink()


@pytest.mark.parametrize("leave", [tear_series, tear_contacts, tear_journal, leave_half_a_checkpoint,
                                   leave_between_renames, leave_half_a_record, leave_half_a_trajectory,
                                   lose_the_summary])
def test_states_that_a_kill_can_leave(finished, finished_copy, leave):
    """Every write of a run, cut in the middle by hand."""
    leave(finished_copy / "run")
    assert run(finished_copy).returncode == DONE
    require_same_results(finished_copy / "run", finished / "run")


def test_killed_before_the_first_checkpoint(spheres):
    """A folder with nothing but a lock, even an empty one, is taken for a run that had not begun."""
    (spheres / "run").mkdir()
    (spheres / "run/lock").write_text("")
    first = finish(spheres)
    write_scene(spheres / "again", SPHERES)
    require_same_results(finish(spheres / "again"), first)


def test_files_beyond_the_checkpoint_are_cut_back(tmp_path):
    """Rows that a killed run wrote after its checkpoint are written once, not twice."""
    scene = changed(with_steps(RODS, 4000), output={"checkpoint_every": 10**6})
    write_scene(tmp_path / "reference", scene)
    reference = finish(tmp_path / "reference")
    write_scene(tmp_path / "killed", scene)
    process = start(tmp_path / "killed")
    while rows_of(tmp_path / "killed/run/series.csv") < 20 and process.poll() is None:
        time.sleep(0.001)
    process.kill()
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    assert checkpoint_step(tmp_path / "killed/run") == 0 and rows_of(tmp_path / "killed/run/series.csv") >= 20
    require_same_results(finish(tmp_path / "killed"), reference)
