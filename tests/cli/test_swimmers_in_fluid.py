"""Swimmers that stir the fluid: their columns, their summary, and what is refused."""

import json
import math

import h5py
import pytest

from jostle_command import changed, column, finish, run, write_scene

VOLUME, DIPOLE = 10.0 * 11.0 * 12.0, -3.0
ALONE = {"seed": 1, "box": {"edges": [10.0, 11.0, 12.0]}, "rods": {"count": 1, "length": 3.0, "start": "aligned"},
         "mobility": {"model": "hydrodynamic"},
         "motion": {"brownian": False, "self_propulsion": 1.0, "force_dipole": DIPOLE},
         "time": {"step": 0.01, "equilibration": 0.0, "production": 0.4}, "output": {"series_every": 10}}
CROWD = {"seed": 2, "box": {"volume_fraction": 0.15}, "rods": {"count": 30, "length": 3.0}, "mobility": {"model": "hydrodynamic"},
         "motion": {"self_propulsion": 2.0, "force_dipole": 20.0, "tumble_rate": 1.0},
         "time": {"step": 0.005, "equilibration": 0.05, "production": 0.3}, "output": {"series_every": 4}}


def test_a_swimmer_alone(tmp_path):
    """It swims straight on at its speed, and its stress is p (n n - I/3)/V."""
    write_scene(tmp_path, ALONE)
    folder = finish(tmp_path)
    for kind, expected in (("xx", 2 / 3), ("yy", -1 / 3), ("zz", -1 / 3), ("xy", 0), ("xz", 0), ("yz", 0)):
        dipoles, thermal = (column(folder / "series.csv", f"stress_{part}_{kind}") for part in ("dipoles", "thermal"))
        assert len(dipoles) > 3 and dipoles == pytest.approx([DIPOLE / VOLUME * expected] * len(dipoles), rel=1e-9, abs=1e-12)
        assert thermal == pytest.approx([0.0] * len(thermal), abs=1e-15)  # not Brownian
    active = json.loads((folder / "summary.json").read_text())["stress_dipoles"]
    assert active["mean"][0][0] == pytest.approx(2 / 3 * DIPOLE / VOLUME) and active["unit"] == "kT D-3"


def test_a_crowd(tmp_path):
    """Traceless rows; the thermal stress beside them; no columns without a dipole."""
    write_scene(tmp_path / "stirs", CROWD)
    folder = finish(tmp_path / "stirs")
    for kind in ("dipoles", "thermal"):
        diagonal = [column(folder / "series.csv", f"stress_{kind}_{k}{k}") for k in "xyz"]
        assert all(abs(sum(row)) < 1e-12 for row in zip(*diagonal)) and any(abs(value) > 1e-4 for value in diagonal[0])
    assert {"stress_dipoles", "stress_thermal"} <= set(json.loads((folder / "summary.json").read_text()))
    write_scene(tmp_path / "still", changed(CROWD, motion={"force_dipole": None}))
    still = finish(tmp_path / "still")
    assert "stress_dipoles_xx" not in (still / "series.csv").read_text()


def test_two_spheres_turn_each_other(tmp_path):
    """Each turns by half the vorticity 3 p (n.R) n x R/(8 pi mu R^5) of the other's dipole; images of the box change 1 % of it."""
    dipole, end = 40.0, 0.02
    swims = changed(ALONE, rods={"count": None, "length": 0.0, "start": "file", "file": "rods.csv"}, motion={"force_dipole": dipole},
                    time={"step": 0.001, "production": end}, output={"series_every": 10, "trajectory_every": 10})
    write_scene(tmp_path, swims)
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n4,5,6,1,1,0\n6,5,6,0,1,0\n")
    with h5py.File(finish(tmp_path) / "trajectory.h5") as file:
        first, second = file["particles/rods/orientation/value"][-1] - file["particles/rods/orientation/value"][0]
    # n = (1, 1, 0)/sqrt(2) and R = (2, 0, 0): (n.R) n x R = (0, 0, -2), which turns (0, 1, 0) towards x.
    turn = end * 3 * dipole * 2 / (8 * math.pi * 2**5)
    assert second == pytest.approx([turn, 0, 0], abs=0.05 * turn)
    assert first == pytest.approx([0, 0, 0], abs=0.05 * turn)  # the axis of the second is at right angles to R


@pytest.mark.parametrize("change, parts", [
    ({"motion": {"force_dipole": "strong"}}, ["motion.force_dipole", "number"]),
    ({"motion": {"force_dipole": 1e9}}, ["motion.force_dipole", "drags a rod through others", "a weaker dipole"]),
    ({"motion": {"self_propulsion": 0.0, "tumble_rate": None}}, ["motion.force_dipole", "nothing swims"]),
    ({"mobility": {"model": "capsule"}}, ["motion.force_dipole", "is not used with mobility.model"]),
    ({"rods": {"length": 0.0}, "mobility": {"model": "capsule"}}, ["motion.force_dipole", "is not used with mobility.model"]),
], ids=["word", "too strong", "still", "dry", "dry spheres"])
def test_refused(tmp_path, change, parts):
    write_scene(tmp_path, changed(CROWD, **change))
    result = run(tmp_path)
    assert result.returncode == 2
    assert all(part in result.stderr for part in parts), result.stderr
