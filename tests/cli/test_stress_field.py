"""output.field_every: field.csv holds means over steps, sums to the series, and goes on to the same bits."""

import json
import signal

import numpy as np
import pytest

from jostle_command import (BAD_INPUT, RODS, changed, column, command, finish, flip_bit, place_of, require_one_line,
                            require_same_results, run, scene_text, stop_and_kill, with_steps, write_scene)
from test_dividing_population import CELLS

NAMES = [f"stress_{a}{b}" for a in "xyz" for b in "xyz"]
ORIENTATION = [f"stress_orientation_{ab}" for ab in ("xx", "xy", "xz", "yy", "yz", "zz")]
FIELD = changed(RODS, output={"field_every": 20, "field_spacing": 1.5})
EDGE = (50 * np.pi * (2 / 4 + 1 / 6) / 0.25) ** (1 / 3)


def fields(folder):
    """step -> rows of field.csv."""
    rows = np.genfromtxt(folder / "field.csv", delimiter=",", names=True)
    return {step: rows[rows["step"] == step] for step in np.unique(rows["step"])}


def means_of_series(folder, steps, every, names=NAMES):
    """Means of the rows that end within the last `every` steps before each of `steps`."""
    row_steps = np.array(column(folder / "series.csv", "step"))
    stress = np.array([column(folder / "series.csv", name) for name in names])
    return {step: stress[:, (row_steps > step - every) & (row_steps <= step)].mean(axis=1) for step in steps}


def test_sums_to_the_series(tmp_path):
    write_scene(tmp_path, FIELD)
    folder = finish(tmp_path)
    found = fields(folder)
    assert list(found) == [20, 40, 60, 80, 100]
    cells = int(EDGE // 1.5)
    expected = means_of_series(folder, found, 20)
    for step, rows in found.items():
        assert len(rows) == cells**3
        stress = np.array([rows[name].mean() for name in NAMES])
        assert np.linalg.norm(stress) > 0
        assert np.allclose(stress, expected[step], rtol=0, atol=1e-12 * np.linalg.norm(stress))
        assert rows["number_density"].mean() == pytest.approx(50 / EDGE**3, rel=1e-12)
        assert np.allclose(rows["x"][:1], EDGE / cells / 2)
    described = [entry["name"] for entry in json.loads((folder / "field.json").read_text())["columns"]]
    assert described == ["step", "time", "x", "y", "z", "number_density"] + NAMES + ORIENTATION
    checked = command(tmp_path, "check", "scene.toml")
    assert f"{cells} x {cells} x {cells} cells" in checked.stdout


def test_orientation_stress_sums_to_the_series(tmp_path):
    """The field is a mean over steps, the series holds values at its rows: the same where both are due at every step."""
    write_scene(tmp_path, changed(FIELD, output={"field_every": 1, "series_every": 1}))
    folder = finish(tmp_path)
    found = fields(folder)
    expected = means_of_series(folder, found, 1, ORIENTATION)
    for step, rows in found.items():
        stress = np.array([rows[name].mean() for name in ORIENTATION])
        assert np.linalg.norm(stress) > 0
        assert np.allclose(stress, expected[step], rtol=0, atol=1e-12 * np.linalg.norm(stress))


def test_nothing_else_changes(tmp_path):
    for name, scene in (("with", FIELD), ("without", RODS)):
        write_scene(tmp_path / name, scene)
        finish(tmp_path / name)
    for name in ("series.csv", "contacts.csv", "summary.json", "trajectory.journal"):
        assert (tmp_path / "with/run" / name).read_bytes() == (tmp_path / "without/run" / name).read_bytes()
    assert not (tmp_path / "without/run/field.csv").exists()


def test_stopped_killed_and_resumed(tmp_path):
    """Between two fields: the sums so far are in the checkpoint, and rows beyond it are written once."""
    scene = changed(with_steps(FIELD, 400), motion={"self_propulsion": 1.0},
                    output={"field_every": 37, "checkpoint_every": 50, "series_every": 1})
    write_scene(tmp_path / "whole", scene)
    whole = finish(tmp_path / "whole")
    folder = tmp_path / "parts"
    write_scene(folder, scene)
    stop_and_kill(folder, (30, signal.SIGTERM), (120, signal.SIGKILL), (240, signal.SIGKILL))
    require_same_results(finish(folder, threads=2), whole, same_command=False)


def test_damage_is_told(tmp_path):
    write_scene(tmp_path, FIELD)
    folder = finish(tmp_path)
    flip_bit(folder / "field.csv", 8 * 5000 + 1)
    for result in (command(tmp_path, "verify", "run"), run(tmp_path)):
        assert result.returncode == BAD_INPUT and "field.csv" in result.stderr


def test_open_box_of_dividing_cells(tmp_path):
    """Cells that leave the box are told in a row of their own; all rows together are V Sigma_col and N."""
    scene = changed(CELLS, box={"edges": [6.0, 9.0, 9.0], "periodic": [False, True, True]},
                    time={"production": 5.0},
                    output={"field_every": 1, "series_every": 1, "field_spacing": "auto"})
    write_scene(tmp_path, scene)
    folder = finish(tmp_path)
    found = fields(folder)
    expected = means_of_series(folder, found, 1)
    counts = dict(zip(column(folder / "series.csv", "step"), column(folder / "series.csv", "N")))
    outside = 0
    for step, rows in list(found.items())[::50]:
        assert len(rows) == 2 and np.isnan(rows["x"][1])  # cells of division_length + D: one, and outside
        volume = 6.0 * 9.0 * 9.0
        stress = np.array([rows[name].sum() for name in NAMES])
        assert np.allclose(stress, expected[step], rtol=0, atol=1e-12 * np.abs(stress).sum() + 1e-300)
        assert rows["number_density"].sum() * volume == pytest.approx(counts[step], rel=1e-12)
        outside += rows["number_density"][1] > 0
    assert outside > 0


REFUSED = [
    ({"field_every": 0}, "field_spacing", "is not used without output.field_every"),
    ({"field_every": -1}, "field_every", "is negative"),
    ({"field_spacing": 0.0}, "field_spacing", "is zero"),
    ({"field_spacing": 0.01}, "field_spacing", " = 0.01: makes too many cells (allowed: at most 1000000 cells"),
]


@pytest.mark.parametrize("changes, key, told", REFUSED, ids=[str(entry[0]) for entry in REFUSED])
def test_refused(tmp_path, changes, key, told):
    scene = changed(FIELD, output=changes)
    write_scene(tmp_path, scene)
    place = f"scene.toml:{place_of(scene_text(scene), 'output', key)}: output.{key}"
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), place, told)
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["scene.toml"]
