"""The orientation stress in the series, the whole stress in the summary, and what equilibrium is checked by."""

import csv
import json

import h5py
import numpy as np
import pytest

from jostle_command import RODS, SPHERES, changed, column, finish, run, with_steps, write_scene
from test_dividing_population import CELLS

SIX = ("xx", "xy", "xz", "yy", "yz", "zz")


def moment_anisotropy(b):
    return 5 * b * (2 * b + 1) * (2 * b + 3) / (20 * b**3 + 40 * b**2 + 45 * b + 16)


def tensors(folder, prefix):
    """(rows, 3, 3) of the series, from six or nine columns."""
    nine = prefix not in ("stress_orientation", "order")
    return np.array([[column(folder / "series.csv", f"{prefix}_{''.join(ab) if nine else ''.join(sorted(ab))}")
                      for ab in ((a, b) for b in "xyz")] for a in "xyz"]).transpose(2, 0, 1)


def summary_of(folder):
    return json.loads((folder / "summary.json").read_text())


def volume_of(summary, length=2.0):
    return summary["rods"] * np.pi * (length / 4 + 1 / 6) / summary["volume_fraction"]


def test_equal_rods(tmp_path):
    """-2 n kT B Q row by row; the whole is the sum of its parts, and its trace the pressure."""
    write_scene(tmp_path, RODS)
    folder = finish(tmp_path)
    summary = summary_of(folder)
    n = summary["rods"] / volume_of(summary)
    orientation = tensors(folder, "stress_orientation")
    assert np.allclose(orientation, -2 * n * moment_anisotropy(2.0) * tensors(folder, "order"), rtol=0, atol=1e-14)
    parts = orientation.mean(axis=0) + tensors(folder, "stress").mean(axis=0) + n * np.eye(3)
    assert np.allclose(summary["stress"]["mean"], parts, rtol=1e-12)
    assert np.allclose(summary["stress_orientation"]["mean"], orientation.mean(axis=0), rtol=0, atol=1e-15)
    assert np.trace(summary["stress"]["mean"]) / 3 == pytest.approx(summary["pressure"]["mean"], rel=1e-12)
    assert summary["principal_stresses"]["mean"] == pytest.approx(np.linalg.eigvalsh(parts), rel=1e-9)
    assert summary["stress_kinetic"]["mean"] == pytest.approx(n, rel=1e-12)


def test_every_rod_has_its_own_B(tmp_path):
    """Lengths from a distribution: the sum over the rods of the last frame is that of the row of its step."""
    scene = changed(with_steps(RODS, 120), rods={"length_deviation": 0.4})
    write_scene(tmp_path, scene)
    folder = finish(tmp_path)
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        axis, length, diameter = (rods[f"{name}/value"][-1].astype(float) for name in ("orientation", "length", "diameter"))
        assert rods["position/step"][-1] == column(folder / "series.csv", "step")[-1] == 120
        volume = np.prod(rods["box/edges"][()])
    assert length.std() > 0.1
    traceless = axis[:, :, None] * axis[:, None, :] - np.eye(3) / 3
    expected = -3 / volume * np.einsum("i,iab->ab", moment_anisotropy(length / diameter), traceless)
    assert np.allclose(tensors(folder, "stress_orientation")[-1], expected, rtol=0, atol=1e-8)
    checks = summary_of(folder)["checks"]  # eq. (1.8) needs one B, the whole stress none
    assert list(checks) == ["total_stress_ratio"]


@pytest.mark.parametrize("scene", [SPHERES, changed(CELLS, motion={"brownian": False})], ids=["spheres", "no temperature"])
def test_exactly_zero(tmp_path, scene):
    write_scene(tmp_path, scene)
    folder = finish(tmp_path)
    with open(folder / "series.csv") as file:
        for row in csv.DictReader(file):
            assert {row[f"stress_orientation_{ab}"] for ab in SIX} == {"0"}
    summary = summary_of(folder)
    assert np.array_equal(summary["stress_orientation"]["mean"], np.zeros((3, 3)))
    kinetic = summary["stress_kinetic"]["mean"] * np.eye(3)
    assert np.allclose(summary["stress"]["mean"], summary["stress_collision"]["mean"] + kinetic, rtol=1e-12)


def test_check_of_the_whole_stress(tmp_path):
    """Along the mean director over across it, of the mean tensor; swimmers are in no equilibrium."""
    write_scene(tmp_path / "passive", with_steps(RODS, 20000))
    result = run(tmp_path / "passive")
    folder = tmp_path / "passive/run"
    summary = summary_of(folder)
    stress, director = np.array(summary["stress"]["mean"]), np.array(summary["director"])
    along = director @ stress @ director
    check = summary["checks"]["total_stress_ratio"]
    assert check["measured"]["mean"] == pytest.approx(2 * along / (np.trace(stress) - along), rel=1e-9)
    assert check["in_equilibrium"] == {"from": 1.0, "to": 1.0} and check["agree"] is True
    assert check["difference"] == pytest.approx(check["measured"]["mean"] - 1)
    assert "stress ratio along/across the director, measured and in equilibrium\n  total stress " in result.stdout
    assert ", in equilibrium 1: agrees" in result.stdout
    assert summary["checks"]["collision_stress_ratio"]["in_equilibrium"]["from"] == 1.0
    write_scene(tmp_path / "active", changed(RODS, motion={"self_propulsion": 1.0}))
    result = run(tmp_path / "active")
    assert "pressure" in result.stdout and "in equilibrium" not in result.stdout
    assert summary_of(tmp_path / "active/run")["checks"] == {}
