import os
import shutil
import signal
import subprocess
import time

import h5py
import numpy as np
import pytest
from conftest import RODS, finished_run

import jostle


def test_a_finished_run(run_of_rods, rods):
    run = jostle.load(run_of_rods)
    assert run.scene == rods
    assert list(run.series["step"]) == list(range(5, 101, 5))
    lines = (run_of_rods / "series.csv").read_text().splitlines()
    assert [float(value) for value in lines[-1].split(",")] == list(run.series[-1])
    assert run.summary["Z"]["mean"] == pytest.approx(run.series["Z"].mean(), rel=1e-12)
    assert run.columns["time"]["unit"] == "kT-1 D3 mu"
    assert run.record["sessions"] and run.lineage is None
    assert run.contacts["force"].min() > 0
    assert run.series is run.series  # read once


def test_pandas(run_of_rods):
    pandas = pytest.importorskip("pandas")
    run = jostle.load(run_of_rods)
    frame = run.series_frame
    assert isinstance(frame, pandas.DataFrame) and list(frame.columns) == list(run.series.dtype.names)
    assert np.array_equal(frame["Z"], run.series["Z"])


@pytest.mark.parametrize("kind", ["rods", "cells"])
def test_frames(kind, request, tmp_path):
    """Frames of the file, those of the journal and the rods of the simulation are the same, to single precision."""
    folder = request.getfixturevalue(f"run_of_{kind}")
    shutil.copytree(folder, tmp_path / "run")
    (tmp_path / "run/trajectory.h5").unlink()
    frames, of_journal = jostle.load(folder).trajectory, jostle.load(tmp_path / "run").trajectory
    assert len(frames) == len(of_journal) > 3
    assert np.array_equal(frames.steps, of_journal.steps) and np.array_equal(frames.times, of_journal.times)
    simulation = jostle.Simulation(request.getfixturevalue(kind))
    for frame, other in zip(frames, of_journal):
        simulation.run(frame.step - simulation.clock.step)
        assert (frame.step, frame.time, frame.periodic) == (other.step, other.time, other.periodic)
        assert frame.step == simulation.clock.step and len(frame) == len(simulation)
        for name in ("edges", "id", "centre", "axis", "image", "length", "diameter"):
            assert np.array_equal(getattr(frame, name), getattr(other, name)), name
        for name in ("id", "image"):
            assert np.array_equal(getattr(frame, name), getattr(simulation.rods, name))
        for name in ("centre", "axis", "length", "diameter"):
            assert np.array_equal(getattr(frame, name), getattr(simulation.rods, name).astype(np.float32))
    assert frames[-1].step == frames.steps[-1] == of_journal[-1].step
    assert [frame.step for frame in frames[1:3]] == list(frames.steps[1:3]) == [f.step for f in of_journal[1:3]]
    with pytest.raises(IndexError):
        frames[len(frames)]
    assert frames[0].unwrapped.shape == (len(frames[0]), 3)


def test_frames_are_read_when_asked_for(run_of_rods, monkeypatch):
    read = []
    original = h5py.Dataset.__getitem__
    monkeypatch.setattr(h5py.Dataset, "__getitem__",
                        lambda self, place, *more: read.append(self.name) or original(self, place, *more))
    frames = jostle.load(run_of_rods).trajectory
    assert not [name for name in read if "orientation" in name]
    assert frames[2].step == 24
    assert [name for name in read if "orientation" in name] == ["/particles/rods/orientation/value"]


def test_lineage(run_of_cells):
    run = jostle.load(run_of_cells)
    births = run.lineage[run.lineage["birth"] == 1]
    deaths = run.lineage[run.lineage["birth"] == 0]
    assert len(births) > 0 and len(deaths) > 0
    assert 12 + len(births) - len(deaths) == run.series["N"][-1]


def test_a_run_that_goes_on_and_one_that_was_killed(tmp_path):
    (tmp_path / "scene.toml").write_text(RODS.replace("production = 2.0", "production = 1e6"))
    process = subprocess.Popen([os.environ["JOSTLE"], "run", "scene.toml", "--out", "run", "--quiet"], cwd=tmp_path,
                               env={**os.environ, "OMP_NUM_THREADS": "1"})
    try:
        end = time.monotonic() + 60
        series = tmp_path / "run/series.csv"
        while not series.exists() or "\n" not in series.read_text() or len(jostle.load(tmp_path / "run").series) < 20:
            assert process.poll() is None and time.monotonic() < end
            time.sleep(0.01)
        run = jostle.load(tmp_path / "run")
        assert run.summary is None and run.record["sessions"] and len(run.trajectory) > 1
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
    run = jostle.load(tmp_path / "run")
    assert list(run.series["step"]) == list(range(5, 5 * len(run.series) + 1, 5))
    assert run.summary is None and len(run.trajectory) > 1 and run.trajectory[1].step == 12
    simulation = run.resume()
    step = simulation.clock.step
    assert step % 32 == 0 and simulation.run(10)["step"][0] == step + 5 - step % 5


def test_a_torn_row_is_passed_over(run_of_rods, tmp_path):
    shutil.copytree(run_of_rods, tmp_path / "run")
    text = (tmp_path / "run/series.csv").read_text()
    for cut, rows in ((3, 19), (0, 20), (len(text) - text.index("\n") - 1, 0)):
        (tmp_path / "run/series.csv").write_text(text[:len(text) - cut])
        series = jostle.load(tmp_path / "run").series
        assert len(series) == rows and series.dtype.names[0] == "step"


def test_bad_folders(run_of_rods, tmp_path):
    with pytest.raises(jostle.InputError, match="there is no such folder. Give the folder that"):
        jostle.load(tmp_path / "none")
    with pytest.raises(jostle.InputError, match="this is not the folder of a run"):
        jostle.load(tmp_path)
    shutil.copytree(run_of_rods, tmp_path / "run")
    run = jostle.load(tmp_path / "run")
    (tmp_path / "run/summary.json").write_text("{")
    (tmp_path / "run/trajectory.h5").write_bytes(b"no")
    (tmp_path / "run/series.csv").write_text("a,b\n1,2,3\n")
    (tmp_path / "run/run.json").unlink()
    for name in ("summary", "trajectory", "series", "record"):
        with pytest.raises(jostle.InputError, match="jostle verify"):
            getattr(run, name)
    (tmp_path / "run/trajectory.h5").unlink()
    (tmp_path / "run/trajectory.journal").unlink()
    with pytest.raises(jostle.InputError, match="the run kept no trajectory. Set output.trajectory_every"):
        run.trajectory


def test_frames_with_the_stress_of_every_rod(tmp_path, run_of_rods):
    """Its sum over the rods, over the volume, is the stress of the step."""
    run = jostle.load(finished_run(tmp_path, RODS.replace("series_every = 5", "series_every = 1\nstress_per_rod = true")))
    frame = run.trajectory[3]
    row = run.series[run.series["step"] == frame.step]
    assert frame.stress_collision.shape == (50, 3, 3)
    assert frame.stress_collision.sum(axis=0)[0, 1] / frame.volume == pytest.approx(row["stress_xy"][0], rel=1e-9)
    assert frame.stress_orientation.sum(axis=0)[0, 1] / frame.volume == pytest.approx(row["stress_orientation_xy"][0], rel=1e-4, abs=1e-6)
    assert jostle.load(run_of_rods).trajectory[3].stress_collision is None
