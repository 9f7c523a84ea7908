"""Simulation.record: frames in H5MD and GSD, as the command writes them; what is refused harms nothing."""

import gc
import os
import subprocess
import sys

import numpy as np
import pytest

import jostle
from conftest import command
from jostle import analysis


def same_frames(one, other):
    assert len(one) == len(other)
    for left, right in zip(one, other):
        assert (left.step, left.time, left.periodic) == (right.step, right.time, right.periodic)
        for name in ("id", "centre", "axis", "image", "length", "diameter", "edges"):
            assert np.array_equal(getattr(left, name), getattr(right, name)), name


@pytest.mark.parametrize("kind", ["rods", "cells"])
def test_records_what_the_command_does(kind, request, tmp_path):
    """The same frames as trajectory.h5 of the command, also where cells divide and die; by the scene's own periods, or by a number."""
    scene, run = request.getfixturevalue(kind), jostle.load(request.getfixturevalue(f"run_of_{kind}"))
    simulation = jostle.Simulation(scene)
    with simulation.record(tmp_path / "own.h5") as own, simulation.record(tmp_path / "every.h5", every=scene.output.trajectory_every) as every:
        simulation.run()
        assert own.journal.exists() and not own.path.exists()
    assert not own.journal.exists() and len(own) == len(every) == len(run.trajectory)
    for recording in (own, every):
        same_frames(jostle.frames.frames_of(recording.path), run.trajectory)


def test_file_is_sound_h5md(rods, tmp_path):
    simulation = jostle.Simulation(rods)
    with simulation.record(tmp_path / "rods.h5", every=10):
        simulation.run(30)
    import h5py
    with h5py.File(tmp_path / "rods.h5") as file:
        assert file["h5md"].attrs["version"].tolist() == [1, 1]
        assert file["particles/rods/position/step"][()].tolist() == [0, 10, 20, 30]
        assert file["particles/rods/position/value"].attrs["unit"] == b"D"
        assert jostle.Scene.from_toml(file["parameters/scene"][()].decode()) == rods
        assert np.allclose(file["observables/stress_collision/value"][:, 0, 0], simulation.series["stress_xx"])


def test_gsd_holds_the_same_rods(cells, tmp_path):
    simulation = jostle.Simulation(cells)
    with simulation.record(tmp_path / "cells.gsd", every=50), simulation.record(tmp_path / "cells.h5", every=50):
        simulation.run(400)
    of_gsd, of_h5md = (list(jostle.frames.frames_of(tmp_path / name)) for name in ("cells.gsd", "cells.h5"))
    assert len(of_gsd) == len(of_h5md) == 9
    for left, right in zip(of_gsd, of_h5md):
        assert (left.step, left.time) == (right.step, right.time) and np.array_equal(left.id, right.id)
        assert np.array_equal(left.image, right.image) and np.array_equal(left.length, right.length)
        assert np.allclose(left.centre, right.centre, atol=1e-5) and np.allclose(left.axis, right.axis, atol=1e-6)
    assert analysis.clusters(tmp_path / "cells.gsd", 0.1).number[0] == analysis.clusters(tmp_path / "cells.h5", 0.1).number[0]


def test_closes_by_itself(rods, tmp_path):
    """Where nobody holds it any more, and at the end of the program."""
    simulation = jostle.Simulation(rods)
    simulation.record(tmp_path / "gone.h5", every=5)
    simulation.run(10)
    del simulation
    gc.collect()
    assert len(jostle.frames.frames_of(tmp_path / "gone.h5")) == 3
    program = ("import jostle; s = jostle.Simulation(jostle.Scene(box={'edges': [9, 9, 9]}, rods={'count': 9, 'length': 1},"
               "time={'production': 1})); s.record('end.gsd', every=2); s.run(4)")
    subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=True)
    assert len(jostle.frames.frames_of(tmp_path / "end.gsd")) == 3


def test_killed_program_leaves_its_journal(tmp_path):
    program = ("import jostle, os; s = jostle.Simulation(jostle.Scene(box={'edges': [9, 9, 9]}, rods={'count': 9, 'length': 1},"
               "time={'production': 1})); s.record('rods.h5', every=2); s.run(6); os.kill(os.getpid(), 9)")
    assert subprocess.run([sys.executable, "-c", program], cwd=tmp_path, check=False).returncode == -9
    assert os.listdir(tmp_path) == ["rods.h5.journal"]
    assert len(analysis.mean_square_displacements(tmp_path / "rods.h5.journal").time) == 3


@pytest.mark.parametrize("name, options, words", [
    ("rods.xyz", {}, "names no format"), ("there.h5", {}, "is there already"), ("rods.h5", {"every": 0}, "at least 1"),
    ("rods.h5", {"every": 1.5}, "whole number"), ("nowhere/rods.h5", {"every": 1}, "nowhere")])
def test_refuses(rods, tmp_path, name, options, words):
    (tmp_path / "there.h5").write_text("mine")
    simulation = jostle.Simulation(rods)
    with pytest.raises((jostle.InputError, jostle.DiskError), match=words):
        simulation.record(tmp_path / name, **options)
    assert os.listdir(tmp_path) == ["there.h5"] and (tmp_path / "there.h5").read_text() == "mine"
    simulation.run(2)


def test_every_is_needed_where_the_scene_keeps_no_frames(rods, tmp_path):
    rods.output.trajectory_every = 0
    with pytest.raises(jostle.InputError, match="every: is missing"):
        jostle.Simulation(rods).record(tmp_path / "rods.h5")


def test_replaces_where_it_is_told_to(rods, tmp_path):
    for _ in range(2):
        with jostle.Simulation(rods).record(tmp_path / "rods.h5", every=1, replace=True) as recording:
            pass
    assert len(jostle.frames.frames_of(recording.path)) == 1
    assert command(tmp_path, "verify", ".").returncode == 2  # no run, and nothing else is left
    assert os.listdir(tmp_path) == ["rods.h5"]


def test_full_disk_is_told_and_leaves_the_simulation_whole(rods):
    simulation, other = jostle.Simulation(rods), jostle.Simulation(rods)
    os.makedirs("/dev/shm", exist_ok=True)
    link = f"/dev/shm/jostle-{os.getpid()}.h5"
    os.symlink("/dev/full", link + ".journal")
    try:
        with pytest.raises((jostle.DiskError, jostle.InputError)):
            simulation.record(link, every=1, replace=True)
    finally:
        os.unlink(link + ".journal")
    simulation.run(10)
    other.run(10)
    assert np.array_equal(simulation.series, other.series)
