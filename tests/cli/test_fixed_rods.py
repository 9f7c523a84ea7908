"""rods.fixed: files that are refused, runs that go on to the same bits, and what a run leaves of the fixed rods."""

import json
import signal

import pytest

from jostle_command import (DONE, RODS, changed, column, command, finish, require_one_line, require_same_results, run,
                            snapshot, stop_and_kill, with_steps, write_scene)

HEADER = "x,y,z,nx,ny,nz,length,diameter"
FIXED = [HEADER, "1,1,1,0,0,1,4,1.5", "4,4,4,1,0,0,0,2", "9,1,4,1,1,0,3,1"]
AMONG = changed(RODS, rods={"fixed": "fixed.csv"}, box={"volume_fraction": 0.1})


def write_fixed(folder, lines, scene=AMONG):
    write_scene(folder, scene)
    (folder / "fixed.csv").write_text("\n".join(lines) + "\n")


def test_what_a_run_leaves(tmp_path):
    write_fixed(tmp_path, FIXED, changed(AMONG, output={"contacts": True}))
    checked = command(tmp_path, "check", "scene.toml")
    assert checked.returncode == DONE and "fixed rods" in checked.stdout and "3, volume fraction" in checked.stdout
    folder = finish(tmp_path)
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["fixed_rods"]["count"] == 3 and len(summary["fixed_rods"]["force"]["mean"]) == 3
    assert "Z" not in summary and summary["checks"] == {}
    met = set(column(folder / "contacts.csv", "fixed"))
    assert {-1.0, 0.0} <= met <= {-1.0, 0.0, 1.0, 2.0}
    same = [i == j for i, j in zip(column(folder / "contacts.csv", "id_i"), column(folder / "contacts.csv", "id_j"))]
    alone = [number >= 0 for number in column(folder / "contacts.csv", "fixed")]
    assert all(a <= b for a, b in zip(alone, same))
    assert len(set(column(folder / "series.csv", "fixed_rod_force_x"))) > 1


def test_stopped_and_resumed(tmp_path):
    scene = changed(with_steps(AMONG, 700), output={"series_every": 1, "checkpoint_every": 40})
    write_fixed(tmp_path / "whole", FIXED, scene)
    whole = finish(tmp_path / "whole")
    folder = tmp_path / "parts"
    write_fixed(folder, FIXED, scene)
    stop_and_kill(folder, (60, signal.SIGTERM), (400, signal.SIGKILL))
    require_same_results(finish(folder, threads=2), whole, same_command=False)


def test_other_fixed_rods_do_not_go_on(tmp_path):
    write_fixed(tmp_path, FIXED)
    finish(tmp_path)
    for lines, told in ((FIXED[:-1], "the run began with other fixed rods"),
                        (FIXED[:-1] + ["9,1,4,1,1,0,-3,1"], "fixed.csv:4: length = -3 is negative")):
        (tmp_path / "fixed.csv").write_text("\n".join(lines) + "\n")
        before = snapshot(tmp_path)
        require_one_line(run(tmp_path), "fixed", told)
        assert snapshot(tmp_path) == before


@pytest.mark.parametrize("line, told", [
    ("1,1,1,0,0,0,4,1", "fixed.csv:3: the axis (nx, ny, nz) has no direction"),
    ("1,1,1,0,0,1,4,0", "fixed.csv:3: diameter = 0 is not positive"),
    ("1,1,nan,0,0,1,4,1", 'fixed.csv:3: z = "nan" is not a finite number'),
    ("1,1,1,0,0,1,4", "fixed.csv:3: 7 cells, but the header names 8"),
    ("1e30,1,1,0,0,1,4,1", "lies far outside the box"),
])
def test_malformed_lines(tmp_path, line, told):
    write_fixed(tmp_path, FIXED[:2] + [line] + FIXED[3:])
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), told)
    assert not (tmp_path / "scene.run").exists()


@pytest.mark.parametrize("lines, told", [
    ([HEADER], "fixed.csv: the file holds no rods"),
    ([HEADER + ",speed", "1,1,1,0,0,1,4,1,3"], "fixed rods do not swim"),
])
def test_malformed_files(tmp_path, lines, told):
    write_fixed(tmp_path, lines)
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), told)


@pytest.mark.parametrize("change, told", [
    ({"contact": {"model": "wca"}}, "fixed rods are hard"),
    ({"mobility": {"model": "hydrodynamic"}}, "no flow is known past rods that stand still"),
    ({"schedule": {"volume_fraction": [[1.0, 0.2]]}}, "fixed rods stay where they are"),
    ({"rods": {"fixed": "nowhere.csv"}}, "nowhere.csv"),
])
def test_what_does_not_go_with_them(tmp_path, change, told):
    write_fixed(tmp_path, FIXED, changed(AMONG, **change))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), told)


def test_rods_of_a_file_keep_off_them(tmp_path):
    scene = changed(AMONG, rods={"start": "file", "file": "rods.csv", "count": None}, box={"volume_fraction": None, "edges": [9, 9, 9]})
    write_fixed(tmp_path, FIXED, scene)
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n7,7,7,1,0,0\n4,4,5.2,1,0,0\n")
    require_one_line(run(tmp_path), "rod 1 (row 2) overlaps a fixed rod by 0.3")
