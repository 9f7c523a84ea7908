"""[springs]: files that are refused, runs that go on to the same bits, and the stress of springs in what a run leaves."""

import json
import signal

import numpy as np
import pytest

from jostle_command import (DONE, RODS, changed, column, command, finish, place_of, require_one_line, require_refused,
                            require_same_results, run, scene_text, snapshot, stop_and_kill, with_steps, write_scene)
from test_dividing_population import CELLS
from test_scenes import complete, SERIES

HEADER = "rod_1,rod_2,s_1,s_2,rest_length,stiffness"
# Neighbours by id are far apart in a random start: springs without rest length draw them together, through the faces.
SPRINGS = [HEADER] + [f"{k},{k + 1},{0.02 * k},-1,1.5,{3 + k % 3}" for k in range(49)]
HELD = changed(RODS, springs={"file": "springs.csv"})
COLUMNS = ["pressure_springs"] + [f"stress_springs_{a}{b}" for a in "xyz" for b in "xyz"]


def write_springs(folder, lines, scene=HELD):
    write_scene(folder, scene)
    (folder / "springs.csv").write_text("\n".join(lines) + "\n")


def test_series_and_summary(tmp_path):
    write_springs(tmp_path, SPRINGS)
    folder, summary = complete(tmp_path, HELD, SERIES + COLUMNS)
    rows = {name: np.array(column(folder / "series.csv", name)) for name in SERIES + COLUMNS}
    assert np.all(rows["pressure_springs"] < 0)  # they pull
    trace = rows["stress_springs_xx"] + rows["stress_springs_yy"] + rows["stress_springs_zz"]
    assert np.allclose(rows["pressure_springs"], trace / 3, rtol=1e-12)
    ideal = rows["N"] / (50 * np.pi * (2 / 4 + 1 / 6) / 0.25)
    assert np.allclose(rows["pressure"], ideal + rows["pressure_collision"] + rows["pressure_springs"], rtol=1e-12)
    assert np.allclose(rows["Z"], rows["pressure"] / ideal, rtol=1e-12)
    assert np.allclose(rows["stress_springs_xy"], rows["stress_springs_yx"], rtol=0, atol=1e-12)
    assert summary["pressure_springs"]["mean"] == pytest.approx(rows["pressure_springs"].mean())
    assert summary["stress_springs"]["mean"][0][1] == pytest.approx(rows["stress_springs_xy"].mean())
    assert summary["checks"] == {}
    whole = np.array(summary["stress"]["mean"])
    parts = [np.array(summary[f"stress_{part}"]["mean"]) for part in ("orientation", "collision", "springs")]
    assert np.allclose(whole, sum(parts) + summary["stress_kinetic"]["mean"] * np.eye(3), rtol=1e-12)
    assert np.trace(whole) / 3 == pytest.approx(summary["pressure"]["mean"], rel=1e-12)
    described = json.loads((folder / "series.json").read_text())["columns"]
    assert "that of springs" in next(entry for entry in described if entry["name"] == "pressure")["definition"]


@pytest.mark.parametrize("motion", [{}, {"self_propulsion": 0.5, "reversal_rate": 1.0}], ids=["still", "turning round"])
def test_stopped_killed_and_resumed(tmp_path, motion):
    """The springs hold the images and points that they began with, and go on to the same bits, also across renumbered rows."""
    scene = changed(with_steps(HELD, 700), output={"series_every": 1, "checkpoint_every": 40}, motion=motion)
    write_springs(tmp_path / "whole", SPRINGS, scene)
    whole = finish(tmp_path / "whole")
    folder = tmp_path / "parts"
    write_springs(folder, SPRINGS, scene)
    stop_and_kill(folder, (60, signal.SIGTERM), (300, signal.SIGKILL), (530, signal.SIGKILL))
    require_same_results(finish(folder, threads=2), whole, same_command=False)


def test_other_springs_do_not_go_on(tmp_path):
    write_springs(tmp_path, SPRINGS)
    finish(tmp_path)
    for lines, told in ((SPRINGS[:-1], "holds 48 springs, and the run began with 49"),
                        (SPRINGS[:3] + ["2,3,0.04,-1,1.5,9"] + SPRINGS[4:], "spring 3 is not the one"),
                        (SPRINGS[:3] + ["2,3,0.04,-1,1.5,-9"] + SPRINGS[4:], "springs.csv:4: stiffness = -9")):
        (tmp_path / "springs.csv").write_text("\n".join(lines) + "\n")
        before = snapshot(tmp_path)
        require_one_line(run(tmp_path), "springs.csv", told)
        assert snapshot(tmp_path) == before
    (tmp_path / "springs.csv").write_text("\n".join(SPRINGS))  # the same without the last line's end
    assert run(tmp_path).returncode == DONE


# A line in the place of the third (line 4 of the file), and what the message says.
LINES = [
    ("2,3,0,0,1", "5 cells, but the header names 6"),
    ("2,3,0,0,1,soft", 'stiffness = "soft" is not a finite number'),
    ("2,3,0,0,1,nan", 'stiffness = "nan" is not a finite number'),
    ("2,3,0,0,1,-3", "stiffness = -3: is negative (allowed: at least 0)"),
    ("2,3,0,0,-1,3", "rest_length = -1: is negative"),
    ("2,3,0,0,1,1e31", "stiffness = 1e31 does not lie within 1e-30 and 1e30"),
    ("2,50,0,0,1,3", "rod_2 = 50: is the id of no rod (allowed: 0 to 49)"),
    ("-1,3,0,0,1,3", "rod_1 = -1: is the id of no rod"),
    ("2.5,3,0,0,1,3", "rod_1 = 2.5: is the id of no rod"),
    ("2,2,0,0,1,3", "rod_2 = 2: is rod_1, too"),
    ("2,3,1.1,0,1,3", "s_1 = 1.1: lies beyond the end of rod 2, of length 2 (allowed: -1 to 1)"),
    ("2,3,0,-1.001,1,3", "s_2 = -1.001: lies beyond the end of rod 3"),
]


@pytest.mark.parametrize("line, told", LINES, ids=[line for line, _ in LINES])
def test_malformed_lines(tmp_path, line, told):
    write_springs(tmp_path, SPRINGS[:3] + [line] + SPRINGS[4:])
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "springs.csv:4: " + told)
    assert not (tmp_path / "scene.run").exists()


@pytest.mark.parametrize("lines, told", [
    ([], 'springs.csv:1: "" is no column of a springs file'),
    ([HEADER], "springs.csv: the file holds no springs"),
    ([HEADER.replace("s_1", "s1"), "0,1,0,0,1,1"], 'springs.csv:1: "s1" is no column of a springs file'),
    (["rod_1,rod_2,s_1,s_2,rest_length", "0,1,0,0,1"], 'springs.csv:1: the column "stiffness" is missing'),
    ([HEADER + ",s_1", "0,1,0,0,1,1,0"], 'springs.csv:1: the column "s_1" stands twice'),
])
def test_malformed_files(tmp_path, lines, told):
    write_springs(tmp_path, lines)
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), told)


def test_no_such_file(tmp_path):
    write_scene(tmp_path, HELD)
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "scene.toml:", "springs.file = \"springs.csv\": there is no such file: springs.csv")


def test_too_stiff_for_the_step(tmp_path):
    write_springs(tmp_path, [HEADER, "0,1,1,-1,1,1000"])
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "scene.toml:17:8: springs.file = \"springs.csv\": names springs that are too stiff",
                         "(allowed: a step of at most ", "Use a shorter time.step or softer springs")
    assert not (tmp_path / "scene.run").exists()
    write_springs(tmp_path, [HEADER, "0,1,1,-1,1,1"])
    checked = command(tmp_path, "check", "scene.toml")
    assert checked.returncode == DONE and "springs relax per step" in checked.stdout, checked.stderr


def test_no_springs_between_cells_that_divide(tmp_path):
    scene = changed(CELLS, springs={"file": "springs.csv"})
    write_springs(tmp_path, [HEADER, "0,1,0,0,1,1"], scene)
    at = place_of(scene_text(scene), "springs", "file")
    require_one_line(command(tmp_path, "check", "scene.toml"), f"scene.toml:{at}: springs.file", "cells divide and die")


def test_a_table_without_a_file(tmp_path):
    scene = changed(RODS, springs={"file": ""})
    require_refused(tmp_path, scene, "springs.file", "names no file")
