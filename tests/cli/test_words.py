"""The words that a user reads: units as people write them, all mistakes of a scene at once, other names of keys, headers of NumPy."""

import json

import numpy as np
import pytest

from jostle_command import BAD_INPUT, DONE, RODS, changed, command, finish, snapshot, write_scene

COLONY = """[box]
edges = [40, 40, 40]
periodic = [false, false, false]
[rods]
count = 1
length = 2.0
[fluid]
kT = KT
[growth]
rate = 4.0
division_length = 5.0
[time]
step = 0.001
production = 1.0
"""


def test_units_are_quotients(tmp_path):
    write_scene(tmp_path, RODS)
    told = command(tmp_path, "check", "scene.toml").stdout
    assert "time mu D3/kT" in told and "# mu D3/kT" in told and "kT/(mu D)" in told and "kT-1" not in told and "D-3" not in told
    finish(tmp_path)
    again = command(tmp_path, "run", "scene.toml", "--out", "run")
    assert " kT/D3" in again.stdout and "D-3" not in again.stdout
    assert json.loads((tmp_path / "run/summary.json").read_text())["pressure"]["unit"] == "kT D-3", "files keep the form of H5MD"


@pytest.mark.parametrize("kT", ["0.0", "0.01"])
def test_times_of_a_colony_are_those_of_growth(tmp_path, kT):
    (tmp_path / "scene.toml").write_text(COLONY.replace("KT", kT))
    told = command(tmp_path, "check", "scene.toml").stdout
    assert "energy_unit" not in told and "time time_unit = 4 D/growth rate" in told
    assert "time step                    0.004 D/growth rate" in told
    finish(tmp_path)
    again = command(tmp_path, "run", "scene.toml", "--out", "run")
    assert "mu growth rate/D" in again.stdout and "energy_unit" not in again.stdout
    files = [(tmp_path / "run" / name).read_text() for name in ("summary.json", "series.json", "resolved.toml")]
    assert not any("energy_unit" in text for text in files)
    printed = next(line for line in again.stdout.splitlines() if line.startswith("pressure "))
    mean = json.loads(files[0])["pressure"]
    assert mean["unit"] == "mu time_unit-1" and f"= {mean['mean'] / 4:.5g} mu growth rate/D" in printed


def test_all_mistakes_are_said_at_once(tmp_path):
    (tmp_path / "scene.toml").write_text("random_seed = 3\n[box]\nvolume_fraction = 1.3\n[rods]\nlenght = 5.0\n[time]\ndt = 0.1\n")
    before = snapshot(tmp_path)
    for words in (["check", "scene.toml"], ["run", "scene.toml"], ["sweep", "scene.toml", "--replicas", "2"]):
        done = command(tmp_path, *words)
        assert done.returncode == BAD_INPUT and done.stdout == ""
        lines = done.stderr.splitlines()
        assert lines[0].startswith("jostle: scene.toml:1:1: random_seed = 3: is an unknown key")
        assert [line.split(":")[1] for line in lines[1:]] == ["3", "5", "7", "4", "6"]
        assert lines[-2].startswith("scene.toml:4:1: rods.count: is missing") and lines[-1].startswith("scene.toml:6:1: time.production: is missing")
    assert snapshot(tmp_path) == before


def test_what_does_not_go_together_is_said_at_once(tmp_path):
    write_scene(tmp_path, changed(RODS, box={"volume_fraction": 0.75}, time={"step": 0.01, "rms_step": 0.03}))
    done = command(tmp_path, "check", "scene.toml", "--set", "contact.overlap_limit=1e-6")
    lines = done.stderr.splitlines()
    assert done.returncode == BAD_INPUT and len(lines) == 3
    assert sum("box.volume_fraction = 0.75: is too dense" in line for line in lines) == 1
    assert sum("time.rms_step = 0.03: is given beside" in line for line in lines) == 1
    assert sum("--set: contact.overlap_limit = 1e-6: is not larger" in line for line in lines) == 1


@pytest.mark.parametrize("name, key", [("dt", "time.step"), ("temperature", "fluid.kT"), ("aspect_ratio", "rods.length"), ("random_seed", "seed"),
                                       ("time.dt", "time.step"), ("rods.N", "rods.count")])
def test_other_names_lead_to_the_key(tmp_path, name, key):
    write_scene(tmp_path, RODS)
    done = command(tmp_path, "check", "scene.toml", "--set", f"{name}=1")
    assert done.returncode == BAD_INPUT and f'It is called "{key}"' in done.stderr


def test_header_of_numpy(tmp_path):
    """savetxt puts "# " before it; rods, springs and tables of contacts are read all the same, to the same bits."""
    rows = np.array([[1.0, 1, 1, 0, 0, 1], [4, 4, 4, 1, 0, 0], [7, 7, 7, 0, 1, 0]])
    springs = np.array([[0, 1, 0.5, -0.5, 4.0, 1.0]])
    for name, header in (("plain", ""), ("numpy", "# ")):
        (tmp_path / name).mkdir()
        np.savetxt(tmp_path / name / "rods.csv", rows, delimiter=",", header="x,y,z,nx,ny,nz", comments=header)
        np.savetxt(tmp_path / name / "springs.csv", springs, delimiter=",", header="rod_1,rod_2,s_1,s_2,rest_length,stiffness", comments=header)
        (tmp_path / name / "scene.toml").write_text('[box]\nedges = [9, 9, 9]\n[rods]\nlength = 1.0\nstart = "file"\nfile = "rods.csv"\n'
                                                    '[springs]\nfile = "springs.csv"\n[time]\nequilibration = 0.0\nproduction = 0.1\n')
        finish(tmp_path / name)
    assert (tmp_path / "plain/run/series.csv").read_bytes() == (tmp_path / "numpy/run/series.csv").read_bytes()


def test_header_of_numpy_in_tables_of_contacts(tmp_path):
    told = []
    for header in ("", "# "):
        np.savetxt(tmp_path / "bodies.csv", [[0, 1, 0, 0, 0], [1, 1, 1, 0, 0]], fmt="%g", delimiter=",", header="id,diameter,x,y,z", comments=header)
        np.savetxt(tmp_path / "contacts.csv", [[0, 1, 0.5, 0, 0, 2, 0, 0]], fmt="%g", delimiter=",", comments=header,
                   header="body_1,body_2,point_x,point_y,point_z,force_x,force_y,force_z")
        done = command(tmp_path, "stress", "contacts.csv", "--bodies", "bodies.csv", "--volume", "1", "--json")
        told.append((done.returncode, done.stdout, done.stderr))
    assert told[0] == told[1]
