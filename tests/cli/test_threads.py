"""One thread and two give the same bits, with enough rods that the loops are shared out (from 512 on)."""

import json

import pytest

from jostle_command import (DONE, STOPPED, changed, checkpoint_step, finish, require_same_results, run, write_scene)

OUTPUT = {"series_every": 2, "trajectory_every": 3, "checkpoint_every": 4, "contacts": True}
SCENES = {
    "rods": {"seed": 11, "box": {"volume_fraction": 0.3}, "rods": {"count": 1500, "length": 5.0},
             "time": {"step": 0.01, "equilibration": 0.0, "production": 0.06}, "output": OUTPUT},
    "spheres": {"seed": 12, "box": {"volume_fraction": 0.4}, "rods": {"count": 2000, "length": 0.0},
                "time": {"step": 0.002, "equilibration": 0.0, "production": 0.012}, "output": OUTPUT},
}


def threads_of(folder):
    return [session["threads"] for session in json.loads((folder / "run.json").read_text())["sessions"]]


@pytest.mark.parametrize("name", SCENES)
def test_threads(tmp_path, name):
    folder = {}
    for threads in (1, 2):
        write_scene(tmp_path / str(threads), SCENES[name])
        folder[threads] = finish(tmp_path / str(threads), threads=threads)
        assert threads_of(folder[threads]) == [threads]
    require_same_results(folder[2], folder[1], same_command=False)


def test_threads_may_change_when_a_run_goes_on(tmp_path):
    for name in ("reference", "changed"):
        write_scene(tmp_path / name, changed(SCENES["rods"], rods={"start": "lattice"}))
    reference = finish(tmp_path / "reference")
    assert run(tmp_path / "changed", "--walltime", "0:00:01", threads=2).returncode == STOPPED
    assert checkpoint_step(tmp_path / "changed/run") == 1
    result = run(tmp_path / "changed")
    assert result.returncode == DONE, result.stderr
    assert threads_of(tmp_path / "changed/run") == [2, 1]
    require_same_results(tmp_path / "changed/run", reference)
