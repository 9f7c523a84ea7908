"""Simulation(scene, rods=...): arrays, frames, files and folders of runs as beginnings."""

import numpy as np
import pytest

import jostle
from conftest import command


@pytest.fixture
def places():
    random = np.random.default_rng(4)
    grid = np.stack(np.meshgrid(*[np.arange(4) * 3.0 + 1.5] * 3), axis=-1).reshape(-1, 3)
    axis = random.normal(size=(64, 3))
    return {"centre": grid, "axis": axis / np.linalg.norm(axis, axis=1, keepdims=True), "length": 1.0, "diameter": 1.0, "edges": [12, 12, 12]}


def scene_of(**rods):
    return jostle.Scene(box={"edges": [12.0, 12.0, 12.0]}, rods={"count": 64, "length": 1.0, **rods}, time={"equilibration": 0.0, "production": 1.0})


def test_arrays(places):
    simulation = jostle.Simulation(scene_of(), rods=places)
    assert np.array_equal(simulation.rods.centre, places["centre"]) and np.allclose(simulation.rods.axis, places["axis"], atol=1e-15)
    assert simulation.rods.id.tolist() == list(range(64)) and simulation.clock.step == 0
    assert len(simulation.run(20)) == 2


def test_arrays_beyond_the_box_are_brought_into_it(places):
    simulation = jostle.Simulation(scene_of(), rods={**places, "centre": places["centre"] + [24.0, -12.0, 0]})
    assert np.allclose(simulation.rods.centre, places["centre"])


def test_denser_than_any_random_start(places):
    """Rules of random starts do not hold for rods that are there."""
    grid = np.stack(np.meshgrid(*[np.arange(5) * 1.05 + 0.5] * 3), axis=-1).reshape(-1, 3)
    scene = jostle.Scene(box={"edges": [5.25] * 3}, rods={"count": 125, "length": 0.0}, time={"equilibration": 0.0, "production": 0.1})
    simulation = jostle.Simulation(scene, rods={"centre": grid, "edges": [5.25] * 3})
    assert simulation.volume > 0 and len(simulation) == 125


def test_saved_and_resumed(places, tmp_path):
    simulation, whole = (jostle.Simulation(scene_of(), rods=places) for _ in range(2))
    simulation.run(10)
    simulation.save(tmp_path / "saved")
    again = jostle.Simulation.resume(tmp_path / "saved")
    assert np.array_equal(again.run(20), whole.run(30)[1:])


def test_own_speeds(places):
    scene = scene_of()
    scene.motion.self_propulsion, scene.motion.brownian, scene.time.rms_step, scene.time.step = 0.5, False, None, 0.01
    speed = np.linspace(-1, 1, 64)
    simulation = jostle.Simulation(scene, rods={**places, "speed": speed})
    simulation.run(1)
    moved = np.einsum("ia,ia->i", simulation.rods.centre - places["centre"], places["axis"]) / 0.01
    assert np.allclose(moved, speed, atol=1e-9)


def test_folder_of_a_run_to_the_last_bit(run_of_rods):
    run = jostle.load(run_of_rods)
    state = run.resume()
    for source in (run_of_rods, str(run_of_rods), run):
        simulation = jostle.Simulation(run.scene, rods=source)
        for name in ("centre", "axis", "length", "diameter"):
            assert np.array_equal(getattr(simulation.rods, name), getattr(state.rods, name)), name
        assert simulation.clock.step == 0 and not simulation.rods.image.any()


def test_frames_and_files(run_of_rods, tmp_path):
    run = jostle.load(run_of_rods)
    assert command(run_of_rods.parent, "export", run_of_rods, "--to", "gsd", "--out", tmp_path / "rods.gsd").returncode == 0
    last = run.trajectory[-1]
    for source in (last, run_of_rods / "trajectory.h5", tmp_path / "rods.gsd"):
        found = jostle.Simulation(run.scene, rods=source).rods
        apart = found.centre - last.centre
        edges = last.edges
        assert abs(apart - edges * np.round(apart / edges)).max() < 1e-5 and abs(found.axis - last.axis).max() < 1e-5
        assert len(jostle.Simulation(run.scene, rods=source).run(10)) == 2
    third = jostle.Simulation(run.scene, rods=run.trajectory[2]).rods
    assert np.allclose(third.axis, run.trajectory[2].axis, atol=1e-6)


def test_scene_of_a_run(run_of_rods):
    scene = jostle.load(run_of_rods).scene
    scene.rods.start, scene.rods.run, scene.rods.frame = "run", str(run_of_rods), 2
    frame = jostle.load(run_of_rods).trajectory[2]
    assert np.allclose(jostle.Simulation(scene).rods.centre, frame.centre, atol=1e-6)


@pytest.mark.parametrize("change, words", [
    ({"centre": np.zeros((64, 3))}, "rods.run.*overlap by up to 1"), ({"centre": np.zeros((5, 3)), "axis": [1, 0, 0]}, "rods.count = 64"),
    ({"length": -1.0}, "length .row 0.*outside"), ({"diameter": 0.0}, "diameter .row 0.*outside"), ({"axis": [1, 1, 0]}, "unit vectors"),
    ({"speed": np.ones(64)}, "self_propulsion"), ({"speed": np.ones(3)}, "speed"), ({"diameter": 0.5}, "rods.diameter"),
    ({"colour": 1}, "is no array of rods"), ({"centre": np.full((64, 3), 1e12)}, "far outside the box")])
def test_refuses_arrays(places, change, words):
    with pytest.raises(jostle.InputError, match=words):
        jostle.Simulation(scene_of(), rods={**places, **change})


@pytest.mark.parametrize("source, words", [("nowhere", "no such folder"), (3, "are no rods"), (".", "no checkpoint"), ([], "are no rods")])
def test_refuses_sources(source, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(jostle.InputError, match=words):
        jostle.Simulation(scene_of(), rods=source)


def test_springs_need_a_folder(places):
    scene = scene_of()
    scene.springs.file = "springs.csv"
    with pytest.raises(jostle.InputError, match="nothing of the springs"):
        jostle.Simulation(scene, rods=places)
