"""jostle.sweep: the sweep of the command, from Python."""

import csv
import os

import numpy as np
import pytest

import jostle
from conftest import command

SCENE = """
[box]
volume_fraction = 0.1
[rods]
count = 30
length = 1.0
[time]
rms_step = 0.1
equilibration = 0.0
production = 2.0
"""


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    folder = tmp_path_factory.mktemp("sweep")
    return jostle.sweep(jostle.Scene.from_toml(SCENE), {"box.volume_fraction": [0.05, 0.1]}, out=folder / "rods.sweep", replicas=2, processes=2)


def test_is_that_of_the_command(swept, tmp_path):
    (tmp_path / "rods.toml").write_text(SCENE)
    assert command(tmp_path, "sweep", "rods.toml", "--set", "box.volume_fraction=0.05,0.1", "--replicas", "2").returncode == 0
    with open(tmp_path / "rods.sweep" / "sweep.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert swept["pressure"].tolist() == [float(row["pressure"]) for row in rows]
    assert swept["seed"].tolist() == [1, 2, 1, 2] and swept["volume_fraction"].tolist() == [0.05, 0.05, 0.1, 0.1]
    assert swept["status"].tolist() == ["done"] * 4 and swept.failed == {} and len(swept) == 4
    assert [run.scene.seed for run in swept.runs] == [1, 2, 1, 2]
    assert swept.runs[2].summary["pressure"]["mean"] == swept["pressure"][2]


def test_columns(swept):
    """An average that no run has an error bar of has a column of NaN; what is no average has none."""
    assert np.isnan(swept["Z_standard_error"]).all() and len(swept["Z_n_eff"]) == 4
    with pytest.raises(jostle.InputError, match="none of the table"):
        swept["Y_standard_error"]


def test_goes_on_with_more_values(swept):
    before = (swept.folder / swept.rows[0]["folder"] / "summary.json").stat().st_mtime_ns
    again = jostle.sweep(jostle.Scene.from_toml(SCENE), {"box.volume_fraction": [0.05, 0.1, 0.15]}, out=swept.folder, replicas=2)
    assert len(again) == 6 and (swept.folder / swept.rows[0]["folder"] / "summary.json").stat().st_mtime_ns == before


def test_scene_with_files_of_its_own(tmp_path):
    """Their names count from the folder of the scene."""
    (tmp_path / "scenes").mkdir()
    (tmp_path / "scenes" / "rods.csv").write_text("x,y,z,nx,ny,nz\n1,1,1,1,0,0\n4,4,4,0,1,0\n")
    (tmp_path / "scenes" / "rods.toml").write_text('[box]\nedges = [9, 9, 9]\n[rods]\nlength = 1.0\nstart = "file"\nfile = "rods.csv"\n'
                                                   "[time]\nequilibration = 0.0\nproduction = 0.2\n")
    scene = jostle.Scene.from_toml(tmp_path / "scenes" / "rods.toml")
    found = jostle.sweep(scene, {"fluid.kT": [0.5, 1.0]}, out=tmp_path / "by_file")
    assert found.failed == {} and found["rods"].tolist() == [2, 2]


def test_run_that_fails_is_told(tmp_path):
    scene = jostle.Scene.from_toml(SCENE)
    scene.contact.overlap_limit = 0.1
    found = jostle.sweep(scene, {"solver.max_iterations": [1, 10000]}, out=tmp_path / "rods", processes=1)
    assert list(found.failed) == [found.rows[0]["folder"]] and found["status"].tolist()[1] == "done"
    assert np.isnan(found["Z"][0]) and found["Z"][1] > 1


@pytest.mark.parametrize("values, options, words", [
    ({"box.volume_fracton": [1, 2]}, {}, "unknown key"), ({"rods.length": []}, {}, "no list of values"), ({"rods.length": 3}, {}, "no list of values"),
    ({"rods.length": "3,4"}, {}, "no list of values"), ({"rods.length": [1, 2], "rods.count": [9, 8, 7]}, {"zip": True}, "--zip"),
    ({"rods.length": [1]}, {}, "nothing to vary"), ({"rods.length": [1, 2]}, {"replicas": 0}, "at least 1"),
    ({"rods.length": [1, 2]}, {"plot": "Y"}, "is no average"), ({"rods.length": [1, {}]}, {}, "is a dict")])
def test_refuses(tmp_path, values, options, words):
    with pytest.raises(jostle.InputError, match=words):
        jostle.sweep(jostle.Scene.from_toml(SCENE), values, out=tmp_path / "rods", **options)
    assert not list(tmp_path.iterdir())


def test_needs_a_folder_and_a_command(tmp_path, monkeypatch):
    with pytest.raises(jostle.InputError, match="out: is missing"):
        jostle.sweep(jostle.Scene.from_toml(SCENE), {"rods.length": [1, 2]})
    (tmp_path / "rods.toml").write_text("mine")
    with pytest.raises(jostle.InputError, match="another file"):
        jostle.sweep(jostle.Scene.from_toml(SCENE), {"rods.length": [1, 2]}, out=tmp_path / "rods")
    assert (tmp_path / "rods.toml").read_text() == "mine"
    monkeypatch.setattr(os, "access", lambda *_: False)
    with pytest.raises(jostle.InputError, match="no such command"):
        jostle.sweep(tmp_path / "rods.toml", {"rods.length": [1, 2]})
