"""output.stress_per_rod: the stress of every rod stands beside it in the frames, and sums to that of the series."""

import signal

import h5py
import numpy as np

from jostle_command import (RODS, changed, column, command, finish, place_of, require_refused, require_same_results,
                            scene_text, stop_and_kill, with_steps, write_scene)
from read_h5md import read as read_h5md
from test_dividing_population import CELLS

WITH_STRESS = changed(RODS, output={"stress_per_rod": True, "series_every": 1})


def tensor_of_series(folder, step):
    row = column(folder / "series.csv", "step").index(step)
    xx, xy, xz, yy, yz, zz = (column(folder / "series.csv", f"stress_orientation_{ab}")[row]
                              for ab in ("xx", "xy", "xz", "yy", "yz", "zz"))
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def stress_and_ids(folder):
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        return rods["stress_collision/value"][()], rods["id/value"][()], rods["stress_collision/step"][()]


def total_of_series(folder, step):
    row = column(folder / "series.csv", "step").index(step)
    return np.array([[column(folder / "series.csv", f"stress_{a}{b}")[row] for b in "xyz"] for a in "xyz"])


def volume_of(folder):
    with h5py.File(folder / "trajectory.h5") as file:
        return np.prod(file["particles/rods/box/edges"][()])


def test_sums_to_the_stress_of_the_step_before(tmp_path):
    write_scene(tmp_path, WITH_STRESS)
    folder = finish(tmp_path)
    read_h5md(folder / "trajectory.h5")
    stress, _, steps = stress_and_ids(folder)
    assert np.all(np.isnan(stress[0]))  # no step before the start
    for k, step in list(enumerate(steps))[1:]:
        total = total_of_series(folder, step) * volume_of(folder)
        assert np.linalg.norm(total) > 0
        assert np.allclose(stress[k].sum(axis=0), total, rtol=0, atol=1e-12 * np.abs(stress[k]).sum())
    assert command(tmp_path, "verify", "run").returncode == 0


def test_orientation_stress_of_every_rod(tmp_path):
    """At the frame's axes, which are single precision; it sums to that of the series."""
    write_scene(tmp_path, WITH_STRESS)
    folder = finish(tmp_path)
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        stress, axis, steps = (rods[name][()] for name in ("stress_orientation/value", "orientation/value", "position/step"))
    b = 2.0
    B = 5 * b * (2 * b + 1) * (2 * b + 3) / (20 * b**3 + 40 * b**2 + 45 * b + 16)
    expected = -3 * B * (axis[..., :, None] * axis[..., None, :] - np.eye(3) / 3)
    assert np.allclose(stress, expected, rtol=0, atol=1e-6)
    for k, step in list(enumerate(steps))[1:]:
        total = tensor_of_series(folder, step) * volume_of(folder)
        assert np.linalg.norm(total) > 1 and np.allclose(stress[k].sum(axis=0), total, rtol=0, atol=1e-5)


def test_nothing_else_changes(tmp_path):
    """The same series, contacts and rods with it and without."""
    for name, scene in (("with", WITH_STRESS), ("without", changed(WITH_STRESS, output={"stress_per_rod": False}))):
        write_scene(tmp_path / name, scene)
        finish(tmp_path / name)
    for name in ("series.csv", "contacts.csv", "summary.json"):
        assert (tmp_path / "with/run" / name).read_bytes() == (tmp_path / "without/run" / name).read_bytes()
    with h5py.File(tmp_path / "without/run/trajectory.h5") as file:
        assert not {"stress_collision", "stress_orientation"} & set(file["particles/rods"])


def test_stopped_killed_and_resumed(tmp_path):
    scene = with_steps(WITH_STRESS, 400)
    write_scene(tmp_path / "whole", scene)
    whole = finish(tmp_path / "whole")
    folder = tmp_path / "parts"
    write_scene(folder, scene)
    stop_and_kill(folder, (30, signal.SIGTERM), (120, signal.SIGKILL))
    require_same_results(finish(folder, threads=2), whole, same_command=False)


def test_cells_that_divide_and_die(tmp_path):
    """Cells born after the step have no stress yet; those that died since take theirs with them."""
    scene = changed(CELLS, output={"stress_per_rod": True, "series_every": 1, "trajectory_every": 1})
    write_scene(tmp_path, changed(scene, time={"production": 6.0}))
    folder = finish(tmp_path)
    stress, ids, steps = stress_and_ids(folder)
    births = {(step, id) for step, id, birth in zip(*(column(folder / "lineage.csv", name)
                                                      for name in ("step", "id", "birth"))) if birth}
    assert len(births) > 5
    changes = set(column(folder / "lineage.csv", "step"))
    told = 0
    for k, step in list(enumerate(steps))[1:]:
        there = ids[k] >= 0
        newborn = np.array([(step, id) in births for id in ids[k][there]], dtype=bool)
        unknown = np.isnan(stress[k][there]).all(axis=(1, 2))
        assert np.array_equal(unknown, newborn)
        assert np.all(np.isnan(stress[k][~there]))
        if step not in changes and k % 20 == 1:
            total = total_of_series(folder, step) * volume_of(folder)
            assert np.allclose(stress[k][there].sum(axis=0), total, rtol=0, atol=1e-12 * np.abs(total).sum() + 1e-300)
            told += np.linalg.norm(total) > 0
    assert told > 3


def test_without_frames_it_is_refused(tmp_path):
    scene = changed(WITH_STRESS, output={"trajectory_every": 0})
    at = place_of(scene_text(scene), "output", "stress_per_rod")
    require_refused(tmp_path, scene, f"scene.toml:{at}: output.stress_per_rod = true",
                     "is not used with output.trajectory_every = 0", "Set trajectory_every")
