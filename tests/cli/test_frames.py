"""Frames that a run keeps by itself, and at logarithmic times; the line that names the report."""

import signal

from jostle_command import (DONE, RODS, STOPPED, changed, command, finish, kill, require_same_results, rows_of, run, start,
                            wait_until, with_steps, write_scene)
from read_h5md import read as read_h5md

AUTO = changed(with_steps(RODS, 600), output={"trajectory_every": None})


def test_a_hundred_frames_also_of_a_run_that_was_stopped(tmp_path):
    write_scene(tmp_path / "whole", AUTO)
    whole = finish(tmp_path / "whole")
    assert read_h5md(whole / "trajectory.h5")["steps"] == list(range(0, 601, 6))
    write_scene(tmp_path / "stopped", AUTO)
    process = start(tmp_path / "stopped")
    series = tmp_path / "stopped/run/series.csv"
    wait_until(lambda: rows_of(series) > 20, process)
    assert kill(process, signal.SIGTERM)[0] == STOPPED
    require_same_results(finish(tmp_path / "stopped"), whole)


def test_logarithmic_times(tmp_path):
    write_scene(tmp_path, changed(AUTO, output={"trajectory_times": "logarithmic"}))
    result = run(tmp_path)
    assert result.returncode == DONE
    assert result.stdout.splitlines()[-1] == "files in run; to look at them: jostle report run"
    steps = read_h5md(tmp_path / "run/trajectory.h5")["steps"]
    assert steps == sorted({0} | {round(10**(k / 20)) for k in range(56)})
    assert steps[-1] == 562 and f"{len(steps)}, at logarithmic times" in command(tmp_path, "check", "scene.toml").stdout


def test_a_run_without_frames_keeps_some_once_it_is_asked_to(tmp_path):
    write_scene(tmp_path, changed(RODS, output={"trajectory_every": 0}))
    finish(tmp_path)
    assert not (tmp_path / "run/trajectory.h5").exists()
    write_scene(tmp_path, changed(with_steps(RODS, 120), output={"trajectory_every": None}))
    finish(tmp_path)
    assert rows_of(tmp_path / "run/series.csv") == 24
    steps = read_h5md(tmp_path / "run/trajectory.h5")["steps"]
    assert steps[0] == 100 and steps[-1] == 120
