"""Whole runs of each kind of scene, and what every run leaves."""

import json
import math
import re

import pytest

from jostle_command import DONE, RODS, SPHERES, changed, column, command, finish, mean, run, with_steps, write_scene
from read_h5md import read as read_h5md

SERIES = (["step", "time", "N", "phi", "Z", "pressure", "pressure_collision"]
          + [f"stress_{a}{b}" for a in "xyz" for b in "xyz"]
          + [f"stress_orientation_{ab}" for ab in ("xx", "xy", "xz", "yy", "yz", "zz")] + ["nematic_order"]
          + [f"order_{ab}" for ab in ("xx", "xy", "xz", "yy", "yz", "zz")]
          + ["contacts", "active_contacts", "iterations", "residual", "max_overlap"])
AVERAGE = {"mean", "standard_error", "n_eff", "standard_deviation"}
ACTIVE = ["pressure_active"] + [f"stress_active_{a}{b}" for a in "xyz" for b in "xyz"]
MICRO = {
    "seed": 4,
    "units": {"system": "micro"},
    "box": {"edges": ["9 um", 9, "9000 nm"]},
    "rods": {"count": 40, "length": "2.5 um", "diameter": "1 um"},
    "fluid": {"viscosity": "1e-3 Pa s", "kT": "0.00411 pN um"},
    "mobility": {"model": "slender_body"},
    "time": {"step": "1 ms", "equilibration": 0, "production": "0.1 s"},
    "output": {"series_every": 2, "trajectory_every": 25},
}


# Checkpoints are synced, which takes longer than the steps between them.
LONG = changed(with_steps(SPHERES, 12000), output={"checkpoint_every": 5000})


def read(folder, name):
    """A JSON file, strictly: NaN and Infinity are no JSON."""
    def refuse(word):
        raise AssertionError(f"{name}: {word} is no JSON")
    return json.loads((folder / name).read_text(), parse_constant=refuse)


def complete(folder, scene, columns=SERIES):
    """Runs the scene, checks what every run promises, and returns folder and summary."""
    write_scene(folder, scene)
    result = finish(folder)
    summary = read(result, "summary.json")
    promised = {"pressure", "pressure_collision", "stress", "stress_collision", "stress_orientation", "nematic_order", "anisotropy",
                "anisotropy_collision", "equilibration_time", "equilibrated", "equilibrium",
                "max_overlap", "checks"}
    assert promised <= set(summary)
    for name in ("Z", "pressure", "pressure_collision", "nematic_order"):
        if name in summary:
            assert AVERAGE <= set(summary[name]), name
            assert (summary[name]["standard_error"] is None) == ("no_standard_error_because" in summary[name])
            few = summary[name]["n_eff"] < 25 or not summary["equilibrated"]
            assert few == (summary[name]["standard_error"] is None), name
    for entry in ("mean", "standard_error"):
        for name in ("stress", "stress_collision", "stress_orientation"):
            assert [len(row) for row in summary[name][entry]] == [3, 3, 3]
    record = read(result, "run.json")
    for name in ("version", "git", "compiler", "seed", "exit_reason", "sessions"):
        assert record[name] not in ("", None), name
    assert record["exit_reason"] == "done"
    for name in ("started", "command", "host", "processor", "threads", "wall_seconds"):
        assert name in record["sessions"][0], name
    description = read(result, "series.json")
    assert [entry["name"] for entry in description["columns"]] == columns
    for entry in description["columns"]:
        assert entry["unit"] and entry["definition"]
    assert (result / "series.csv").read_text().splitlines()[0] == ",".join(columns)
    assert (result / "scene.toml").read_text() == (folder / "scene.toml").read_text()
    return result, summary


def test_summary_is_that_of_the_series(tmp_path):
    """Without equilibration the means are those of all rows; and the series keeps its own relations."""
    folder, summary = complete(tmp_path, LONG)  # 2.5 diffusion times
    assert summary["equilibrated"] and summary["equilibrium"]["verdict"] == "reached"
    assert summary["equilibrium"]["diffusion_times"] == pytest.approx(24 / (3 * math.pi), rel=1e-9)
    for name in ("Z", "pressure", "pressure_collision", "nematic_order"):
        assert summary[name]["mean"] == pytest.approx(mean(folder, name), rel=1e-12), name
    for a in range(3):
        for b in range(3):
            assert summary["stress_collision"]["mean"][a][b] == pytest.approx(
                mean(folder, f"stress_{'xyz'[a]}{'xyz'[b]}"), rel=1e-12, abs=1e-14)
    assert summary["Z"]["n_eff"] >= 25 and summary["Z"]["standard_error"] > 0
    assert summary["max_overlap"] >= max(column(folder / "series.csv", "max_overlap"))
    lines = {name: column(folder / "series.csv", name) for name in SERIES}
    edge3 = 64 * math.pi / 6 / 0.3
    for row in range(400):
        trace = lines["stress_xx"][row] + lines["stress_yy"][row] + lines["stress_zz"][row]
        assert lines["pressure_collision"][row] == pytest.approx(trace / 3, rel=1e-12)
        assert lines["pressure"][row] == pytest.approx(trace / 3 + 64 / edge3, rel=1e-12)
        assert lines["Z"][row] == pytest.approx(lines["pressure"][row] * edge3 / 64, rel=1e-12)
        assert lines["phi"][row] == pytest.approx(0.3, rel=1e-12) and lines["N"][row] == 64
        assert lines["time"][row] == pytest.approx(0.002 * lines["step"][row], rel=1e-12)
        for ab, ba in (("xy", "yx"), ("xz", "zx"), ("yz", "zy")):
            assert lines[f"stress_{ab}"][row] == pytest.approx(lines[f"stress_{ba}"][row], rel=1e-9, abs=1e-12)
        assert 0 < lines["active_contacts"][row] <= lines["contacts"][row] and lines["iterations"][row] >= 1
        assert lines["residual"][row] <= 1e-5
        assert lines["max_overlap"][row] <= 0.01  # a third of the rms step of two spheres (theory, section 3)


def test_equilibration_is_left_out(tmp_path):
    scene = changed(SPHERES, time={"equilibration": 0.08, "production": 0.12})
    folder, summary = complete(tmp_path, scene)
    values = column(folder / "series.csv", "Z")
    assert len(values) == 25 and summary["production_rows"] == 15
    assert summary["Z"]["mean"] == pytest.approx(sum(values[10:]) / 15, rel=1e-12)
    assert summary["equilibration_time"] == 0.08


def test_equilibration_is_found(tmp_path):
    """From a lattice, and for as long as it takes: until the window covers two diffusion times, 18.8."""
    scene = changed(LONG, rods={"start": "lattice"}, time={"equilibration": "auto", "production": 8.0})
    folder, summary = complete(tmp_path, scene)
    rows = len(column(folder / "series.csv", "Z"))
    assert summary["equilibrated"] and summary["Z"]["standard_error"] > 0
    assert 1000 < 18.84 / 0.008 <= summary["production_rows"] <= rows <= 10000
    first = rows - summary["production_rows"]
    assert summary["Z"]["mean"] == pytest.approx(sum(column(folder / "series.csv", "Z")[first:])
                                                 / summary["production_rows"], rel=1e-12)


def test_isotropic_stress_has_no_ratio_to_speak_of(tmp_path):
    """The largest over the smallest principal stress of spheres is above 1 by noise: no error bar, but the three values."""
    _, summary = complete(tmp_path, LONG)
    principal = summary["principal_stresses_collision"]
    assert principal["differ"] is False and principal["mean"] == sorted(principal["mean"])
    assert all(error > 0.0 for error in principal["standard_error"])
    assert summary["anisotropy"]["standard_error"] is None
    assert "isotropic within its error" in summary["anisotropy"]["no_standard_error_because"]
    assert principal["mean"][2] - principal["mean"][0] < 8 * max(principal["standard_error"])


def test_micro_units(tmp_path):
    """The same scene in um, s, pN and, by hand, in reduced units: same Z, and stress in Pa."""
    folder, summary = complete(tmp_path / "micro", MICRO)
    assert summary["pressure"]["unit"] == "pN um-2" and "unit" not in summary["Z"]
    kinetic = 40 / 9**3 * 0.00411
    assert summary["pressure"]["mean"] - summary["pressure_collision"]["mean"] == pytest.approx(kinetic, rel=1e-9)
    assert summary["Z"]["mean"] == pytest.approx(summary["pressure"]["mean"] / kinetic, rel=1e-9)
    trajectory = read_h5md(folder / "trajectory.h5")
    assert (trajectory["length_unit"], trajectory["time_unit"], trajectory["stress_unit"]) == ("um", "s", "pN um-2")
    assert trajectory["frames"] == 5 and trajectory["rods"] == [40] * 5 and trajectory["seed"] == 4
    assert trajectory["times"] == pytest.approx([0, 0.025, 0.05, 0.075, 0.1])
    assert trajectory["scene"] == (folder / "scene.toml").read_text()

    time_unit = 1e-3 / 0.00411  # mu D^3/kT
    reduced = changed(MICRO, units={"system": "reduced"}, box={"edges": [9.0, 9.0, 9.0]},
                      rods={"length": 2.5, "diameter": 1.0}, fluid={"viscosity": 1.0, "kT": 1.0},
                      time={"step": 1e-3 / time_unit, "production": 0.1 / time_unit})
    _, other = complete(tmp_path / "reduced", reduced)
    # Rounding grows from step to step; over 100 steps it stays far below this.
    assert other["Z"]["mean"] == pytest.approx(summary["Z"]["mean"], rel=1e-6)
    assert other["pressure"]["mean"] * 0.00411 == pytest.approx(summary["pressure"]["mean"], rel=1e-6)


@pytest.mark.parametrize("start", ["random", "lattice", "aligned", "file"])
def test_starts(tmp_path, start):
    scene = changed(RODS, rods={"start": start, "length": 4.0}, output={"contacts": False})
    if start in ("lattice", "aligned"):
        scene = changed(scene, rods={"axis": [0, 0, 1]})
    if start == "file":
        scene = changed(scene, rods={"count": None, "file": "lines.csv"},
                        box={"volume_fraction": None, "edges": [8.0, 8.0, 8.0]})
        lines = [f"{x + 0.5},{y + 0.5},{z},0,0,2" for x in range(0, 8, 2) for y in range(0, 8, 2) for z in (1.0, 9.5)]
        tmp_path.mkdir(exist_ok=True)
        (tmp_path / "lines.csv").write_text("x,y,z,nx,ny,nz\n" + "\n".join(lines[::2]) + "\n")
    folder, summary = complete(tmp_path, scene)
    assert summary["rods"] == (16 if start == "file" else 50)
    order = column(folder / "series.csv", "nematic_order")[0]
    assert order < 0.5 if start == "random" else order > 0.9
    trajectory = read_h5md(folder / "trajectory.h5")
    assert trajectory["steps"] == list(range(0, 101, 12))
    assert summary["max_overlap"] < 0.05


def test_first_frame_is_the_file(tmp_path):
    """Rods of two lengths, given out of the box: read, wrapped, kept in order, single precision in the trajectory."""
    h5py = pytest.importorskip("h5py")
    (tmp_path / "rods.csv").write_text("length,x,y,z,nx,ny,nz\n2,-1,5,5,3,0,0\n0,5,5,5,0,0,-1\n")
    scene = changed(with_steps(RODS, 12), rods={"count": None, "start": "file", "file": "rods.csv"},
                    box={"volume_fraction": None, "edges": [10.0, 10.0, 10.0]})
    folder, _ = complete(tmp_path, scene)
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        assert rods["position/value"][0].tolist() == [[9, 5, 5], [5, 5, 5]]
        assert rods["orientation/value"][0].tolist() == [[1, 0, 0], [0, 0, -1]]
        assert rods["length/value"][0].tolist() == [2, 0]
        assert rods["id/value"][0].tolist() == [0, 1]


def test_only_self_propulsion(tmp_path):
    """Without thermal energy there is no Z; the rods still collide."""
    scene = changed(with_steps(RODS, 300), fluid={"kT": 0.0}, motion={"brownian": False, "self_propulsion": 1.0})
    folder, summary = complete(tmp_path, scene, SERIES + ACTIVE)
    assert "Z" not in summary and summary["checks"] == {}
    assert all(math.isnan(value) for value in column(folder / "series.csv", "Z"))
    assert summary["pressure"]["mean"] == pytest.approx(summary["pressure_collision"]["mean"], rel=1e-12)
    assert summary["pressure_collision"]["mean"] > 0
    other = changed(scene, fluid={"kT": 1.0})  # brownian = false alone does the same
    write_scene(tmp_path / "other", other)
    assert (finish(tmp_path / "other") / "series.csv").read_bytes() == (folder / "series.csv").read_bytes()


SWIMMERS = changed(RODS, rods={"count": 1, "length": 2.0}, box={"volume_fraction": None, "edges": [5.0, 5.0, 5.0]},
                   mobility={"model": "finite_aspect_ratio"}, motion={"brownian": False, "self_propulsion": 1.0},
                   output={"series_every": 5, "contacts": False})


def test_active_stress_of_one_swimmer(tmp_path):
    """Without noise x F is (U n)(U n) age/mu_par: by hand, through the faces of the box."""
    scene = changed(with_steps(SWIMMERS, 1000), output={"active_stress_lag": 2.0})
    folder, summary = complete(tmp_path, scene, SERIES + ACTIVE)
    p = 3.0
    bracket = math.log(p) - 0.207 + 0.980 / p - 0.133 / p**2 + (2 / 3 + 0.207 - 0.980 + 0.133) / p**4
    mobility = bracket / (2 * math.pi * 3.0)
    pressure = column(folder / "series.csv", "pressure_active")
    for row, value in enumerate(pressure, 1):
        age = (20 + row % 20) * 0.1  # a lag is 20 rows of 5 steps
        assert math.isnan(value) if row < 20 else value == pytest.approx(age / mobility / 3 / 125, rel=1e-6), row
    rows = {ab: column(folder / "series.csv", f"stress_active_{ab}")[40] for ab in ("xx", "yy", "zz", "xy", "yx")}
    assert rows["xx"] + rows["yy"] + rows["zz"] == pytest.approx(3 * pressure[40], rel=1e-9)
    assert rows["xy"] == pytest.approx(rows["yx"], rel=1e-6)
    assert summary["pressure_active"]["mean"] == pytest.approx(sum(pressure[19:]) / len(pressure[19:]), rel=1e-9)
    assert summary["pressure_active"]["unit"] == summary["stress_active"]["unit"] == "kT D-3"
    assert [len(row) for row in summary["stress_active"]["mean"]] == [3, 3, 3]


def test_active_stress_of_a_run_that_is_too_short(tmp_path):
    _, summary = complete(tmp_path, changed(SWIMMERS, output={"active_stress_lag": 100.0}), SERIES + ACTIVE)
    assert summary["pressure_active"]["mean"] is None and "stress_active" not in summary
    assert "output.active_stress_lag" in summary["pressure_active"]["no_standard_error_because"]


def test_one_rod(tmp_path):
    """Nothing to collide with."""
    _, summary = complete(tmp_path, changed(RODS, rods={"count": 1}, box={"volume_fraction": 0.01}))
    assert summary["Z"]["mean"] == pytest.approx(1.0, abs=1e-12)
    assert summary["pressure_collision"]["mean"] == 0.0
    assert summary["anisotropy_collision"]["mean"] is None


def test_seed_decides(tmp_path):
    """Same seed, same run; another seed, another run."""
    series = []
    for name, seed in (("a", 7), ("b", 7), ("c", 8)):
        write_scene(tmp_path / name, changed(RODS, seed=seed))
        series.append((finish(tmp_path / name) / "series.csv").read_bytes())
    assert series[0] == series[1] != series[2]


def test_contacts_are_those_of_the_stress(tmp_path):
    """In the rows of contacts.csv: ids in order, forces positive, as many as the series counts."""
    scene = changed(RODS, output={"series_every": 1})
    folder, _ = complete(tmp_path, scene)
    steps = column(folder / "contacts.csv", "step")
    counts = [steps.count(step) for step in range(1, 101)]
    assert counts == column(folder / "series.csv", "active_contacts")
    assert all(force > 0 for force in column(folder / "contacts.csv", "force"))
    for i, j in zip(column(folder / "contacts.csv", "id_i"), column(folder / "contacts.csv", "id_j")):
        assert 0 <= i <= j < 50
    for axes in zip(*(column(folder / "contacts.csv", f"normal_{a}") for a in "xyz")):
        assert math.hypot(*axes) == pytest.approx(1.0, abs=1e-12)
    columns = [entry["name"] for entry in read(folder, "contacts.json")["columns"]]
    assert (folder / "contacts.csv").read_text().splitlines()[0] == ",".join(columns)
