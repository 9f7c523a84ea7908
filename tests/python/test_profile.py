"""Run.profile: layers of a field that is known, and the balance of forces in a slit."""

import numpy as np
import pytest
from conftest import finished_run

import jostle
from jostle.profile import profile_of

NAMES = ("step", "time", "x", "y", "z", "number_density", *(f"stress_{a}{b}" for a in "xyz" for b in "xyz"),
         *(f"stress_orientation_{ab}" for ab in ("xx", "xy", "xz", "yy", "yz", "zz")))


def test_layers_of_a_known_field():
    """Two layers along y of two cells each, 64 fields; a row beyond the box is left out, and fields too early."""
    generator = np.random.default_rng(3)
    rows = []
    for step in range(1, 65):
        for x in (1.0, 3.0):
            for y in (0.5, 1.5):
                row = dict.fromkeys(NAMES, 0.0)
                row.update(step=step, time=0.1 * step, x=x, y=y, number_density=y + x - 2.0, stress_yy=10.0 * y + generator.normal(),
                           stress_orientation_yy=1.0, stress_xy=2.0, stress_orientation_xy=0.5)
                rows.append(tuple(row[name] for name in NAMES))
        rows.append(tuple({**dict.fromkeys(NAMES, 9.0), "step": step, "time": 0.1 * step, "x": np.nan}[name] for name in NAMES))
    field = np.array(rows, [(name, float) for name in NAMES])
    found = profile_of(field, "y", 2.0, 3, after=0.35)
    assert list(found["y"]) == [0.5, 1.5] and np.allclose(found["number_density"], [0.5, 1.5])
    expected = 2.0 * np.array([0.5, 1.5]) + 10.0 * np.array([0.5, 1.5]) + 1.0
    assert np.all(found["stress_yy_error"] > 0.04) and np.all(found["stress_yy_error"] < 0.2)  # 1/sqrt(2 x 61) = 0.09
    assert np.all(np.abs(found["stress_yy"] - expected) < 5.0 * found["stress_yy_error"])
    assert np.allclose(found["stress_xy"], 2.5) and np.allclose(found["stress_yx"], 0.5)
    assert np.isnan(found["stress_zz_error"]).all()  # constant: no error bar
    late = profile_of(field, "y", 0.0, 3, after=6.35)
    assert np.isnan(late["stress_yy_error"]).all() and np.allclose(late["stress_xx"], 0.0)


SLIT = """
seed = 5
[box]
edges = [6.5, 6.5, 8.0]
periodic = [true, true, false]
[walls]
faces = [false, false, true]
[rods]
count = 60
length = 2.0
[time]
rms_step = 0.1
equilibration = 20.0
production = 320.0
[output]
field_every = 20
field_spacing = 1.0
trajectory_every = 0
"""


def test_the_stress_along_the_normal_is_the_wall_pressure_at_every_height(tmp_path):
    run = jostle.load(finished_run(tmp_path, SLIT))
    found = run.profile("z", after=20.0)
    pressure = jostle.average(run.series["wall_pressure_z"][run.series["time"] > 20.0])
    inside = found[1:-1]  # the cells at the walls are smoothed over what lies beyond them
    error = np.hypot(inside["stress_zz_error"], pressure.standard_error)
    off = (inside["stress_zz"] - pressure.mean) / error
    assert len(found) == 8 and np.all(error < 0.05 * pressure.mean)
    assert np.all(np.abs(off) < 4.0), off  # false alarm 4e-4 for six layers
    lateral = 0.5 * (found["stress_xx"] + found["stress_yy"])
    assert np.abs(lateral - found["stress_zz"]).max() > 4.0 * found["stress_zz_error"].max()  # rods lie at the walls
    with pytest.raises(jostle.InputError, match="is none"):
        run.profile("r")
    with pytest.raises(jostle.InputError, match="leaves no field"):
        run.profile("z", after=1e6)


def test_a_run_without_fields(run_of_rods):
    with pytest.raises(jostle.InputError, match="keeps no field"):
        jostle.load(run_of_rods).profile("z")
