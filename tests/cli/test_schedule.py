"""Scenes with a table [schedule]: the box of every frame and picture, the same files after a stop and for any threads, and what is refused."""

import json
import re
import sys
from pathlib import Path

import h5py
import numpy as np
import pytest

from jostle_command import (DONE, RODS, TIME_STEP, Verbatim, changed, column, command, finish, require_one_line,
                            require_refused, require_same_results, with_steps, write_scene)

ROOT = Path(__file__).resolve().parents[2]
END = 60 * TIME_STEP
SQUEEZED = changed(RODS, schedule={"volume_fraction": Verbatim(f"[[{END}, 0.4]]"), "kT": Verbatim(f"[[{END / 2}, 2.0], [{END}, 1.0]]")},
                   output={"field_every": 10, "field_spacing": 2.0, "stress_per_rod": True})
SWIMMERS = changed(SQUEEZED, motion={"self_propulsion": 1.0}, schedule={"self_propulsion": Verbatim(f"[[{END}, 3.0]]")})


@pytest.fixture(scope="module")
def squeezed(tmp_path_factory):
    folder = tmp_path_factory.mktemp("squeezed")
    write_scene(folder, SQUEEZED)
    finish(folder)
    return folder / "run"


def frames(folder):
    """Times, edges and numbers of edges that each rod has crossed, of the frames."""
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        return rods["position/time"][()], rods["box/edges/value"][()], file["particles/rods/stress_orientation/value"][()]


def test_every_frame_has_its_box(squeezed):
    times, edges, _ = frames(squeezed)
    volume = 50 * np.pi * (2.0 / 4 + 1 / 6)
    first, last = np.cbrt(volume / 0.25), np.cbrt(volume / 0.4)
    expected = np.where(times < END, first + (last - first) * times / END, last)
    assert np.allclose(edges, expected[:, None], rtol=1e-13, atol=0)
    assert column(squeezed / "series.csv", "phi")[-1] == pytest.approx(0.4, rel=1e-14)
    summary = json.loads((squeezed / "summary.json").read_text())
    assert summary["volume_fraction"] == 0.4 and summary["equilibrated"] is False
    assert summary["schedule"] == {"keys": "schedule.kT, schedule.volume_fraction", "end": END, "in_averages": True}
    assert command(squeezed.parent, "verify", "run").returncode == DONE


def test_orientation_stress_of_rods_is_that_of_their_kT(squeezed):
    times, _, stress = frames(squeezed)
    kT = np.interp(times, [0, END / 2, END], [1.0, 2.0, 1.0])
    largest = np.abs(np.linalg.eigvalsh(stress)).max(axis=2)  # 2 kT B of every rod
    assert np.allclose(largest / kT[:, None], largest[0, 0], rtol=1e-5)


@pytest.mark.parametrize("scene", [SQUEEZED, SWIMMERS], ids=["rods", "swimmers"])
def test_stop_and_go_on_and_threads(tmp_path, scene):
    for name, threads in (("whole", 1), ("threads", 3), ("halves", 1)):
        (tmp_path / name).mkdir()
        if name == "halves":  # in the middle of a ramp, of a row, of a field
            write_scene(tmp_path / name, with_steps(scene, 25))
            finish(tmp_path / name)
        write_scene(tmp_path / name, scene)
        finish(tmp_path / name, threads=threads)
    for name in ("threads", "halves"):
        require_same_results(tmp_path / name / "run", tmp_path / "whole/run", same_command=name == "halves")


def test_check_names_the_ramps(tmp_path):
    write_scene(tmp_path, SWIMMERS)
    told = command(tmp_path, "check", "scene.toml").stdout
    assert re.search(r"ramp of kT +1 kT, at 0.6 mu D3/kT 2 kT, at 1.2 mu D3/kT 1 kT\n", told)
    assert re.search(r"ramp of phi +0.25, at 1.2 mu D3/kT 0.4\n", told)
    assert re.search(r"ramp of box edges +7.48\d+ x 7.48\d+ x 7.48\d+ D, at 1.2 mu D3/kT 6.39\d+ x", told)
    assert re.search(r"ramp of self_propulsion +1 kT/\(mu D2\), at 1.2 mu D3/kT 3 kT", told)
    assert "averages                     take in the schedule" in told
    write_scene(tmp_path, changed(with_steps(SQUEEZED, 50)))
    assert "the run ends at 1 mu D3/kT, before the schedule does" in command(tmp_path, "check", "scene.toml").stdout


def test_ramps_in_units(tmp_path):
    write_scene(tmp_path, {"units": {"system": "micro"}, "box": {"edges": ["9 um", 9, "9000 nm"]},
                           "rods": {"count": 40, "length": "2.5 um", "diameter": "1 um"},
                           "fluid": {"viscosity": "1e-3 Pa s", "kT": "0.00411 pN um"},
                           "schedule": {"kT": Verbatim('[["100 ms", "0.005 pN um"]]'), "edges": Verbatim('[[0.2, ["8 um", 9.0, 9.0]]]')},
                           "time": {"step": "1 ms", "production": "0.1 s"}})
    told = command(tmp_path, "check", "scene.toml").stdout
    assert "kT = [[0.1, 0.005]]  # s, pN um\n" in told and "edges = [[0.2, [8.0, 9.0, 9.0]]]  # s, um\n" in told


REFUSED = [
    ({"kT": "2.0"}, "schedule.kT = 2.0: is a number with a decimal point or exponent, the wrong type", "[[50.0, 0.2], [80.0, 0.2]]"),
    ({"kT": "[]"}, "schedule.kT = []", "points [time, value]"),
    ({"kT": "[1.0, 2.0]"}, "is no point of a ramp", "[time, value]"),
    ({"kT": "[[1.0, 2.0, 3.0]]"}, "is no point of a ramp"),
    ({"kT": "[[1.0, 2.0], [1.0, 3.0]]"}, "is no later than the time of the point before, 1", "times that increase"),
    ({"kT": "[[-1.0, 2.0]]"}, "is no time after 0", "times that increase"),
    ({"kT": "[[1.0, -2.0]]"}, "is negative", "at least 0"),
    ({"kT": '[["1 s", 2.0]]'}, "carries a unit, and the scene is in reduced units"),
    ({"viscosity": "[[1.0, 2.0]]"}, "schedule.viscosity", "is an unknown key", "fluid.viscosity cannot be ramped"),
    ({"volume_fracton": "[[1.0, 0.3]]"}, "is an unknown key", 'Did you mean "volume_fraction"?'),
    ({"volume_fraction": "[[1.0, 0.88]]"}, "cannot be packed at time 1", "a volume fraction of at most 0.8"),
    ({"edges": "[[1.0, [0.5, 50, 50]]]"}, "makes the box thinner than a rod's diameter: edge x is 0.5", "edges of at least 1"),
    ({"edges": "[[1.0, [7, 7]]]"}, "has 2 elements", "three elements"),
    ({"edges": "[[0.05, [6.5, 6.5, 6.5]]]"}, "closes gaps so far that contacts cannot follow", "a step of at most"),
    ({"self_propulsion": "[[1.0, 60.0]]"}, "takes a rod through others", "a step of at most"),
]


@pytest.mark.parametrize("entry", REFUSED, ids=lambda entry: str(entry[0]))
def test_what_is_refused(tmp_path, entry):
    schedule, *parts = entry
    require_refused(tmp_path, changed(RODS, schedule={key: Verbatim(value) for key, value in schedule.items()}), *parts)
    require_one_line(command(tmp_path, "run", "scene.toml"), *parts)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scene.toml"]


def test_rods_with_speeds_of_their_own(tmp_path):
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz,speed\n2,2,2,1,0,0,1\n6,6,6,1,0,0,2\n")
    scene = changed(RODS, box={"volume_fraction": None, "edges": [9.0, 9.0, 9.0]}, rods={"count": None, "start": "file", "file": "rods.csv"},
                    motion={"self_propulsion": 1.0}, schedule={"self_propulsion": Verbatim("[[1.0, 3.0]]")})
    write_scene(tmp_path, scene)
    for name in ("run", "check"):
        require_one_line(command(tmp_path, name, "scene.toml"), "schedule.self_propulsion", "the rods have speeds of their own")


def test_another_schedule_is_another_scene(squeezed):
    folder = squeezed.parent
    write_scene(folder, changed(SQUEEZED, schedule={"kT": Verbatim(f"[[{END / 2}, 2.5], [{END}, 1.0]]")}))
    require_one_line(command(folder, "run", "scene.toml", "--out", "run"), "the checkpoint is of another scene: schedule.kT was [[0.6, 2], [1.2, 1]] and is")
    write_scene(folder, SQUEEZED)


def test_a_sweep_over_ramps(tmp_path):
    write_scene(tmp_path, changed(with_steps(RODS, 20), output={"contacts": False}))
    swept = command(tmp_path, "sweep", "scene.toml", "--set", "schedule.volume_fraction=[[0.2, 0.3]],[[0.2, 0.35]]", "--out", "sweep", "--processes", "1")
    assert swept.returncode == DONE, swept.stderr
    rows = (tmp_path / "sweep/sweep.csv").read_text().splitlines()
    assert len(rows) == 3 and rows[0].startswith("schedule.volume_fraction,")
    refused = command(tmp_path, "sweep", "scene.toml", "--set", "schedule.volume_fraction=0.3,0.35", "--out", "other")
    assert refused.returncode == 2 and "points [time, value]" in refused.stderr
    assert not (tmp_path / "other").exists()


def test_pictures_show_the_box_of_each_frame(squeezed):
    sys.path.append(str(ROOT / "presentation"))
    import rods_of_page
    from run_folder import read_run
    from trajectory import Trajectory

    trajectory = Trajectory(squeezed, None)
    made = rods_of_page.rods_of(read_run(squeezed), trajectory, 20, rods_of_page.Seen())
    _, edges, _ = frames(squeezed)
    assert [high for _, high in made.told["boxes"]] == edges.tolist()
    assert np.array(made.told["seen"]).max() == edges.max()
    exported = command(squeezed.parent, "export", "run", "--to", "vtk", "--out", "paraview")
    assert exported.returncode == DONE, exported.stderr
    folder = squeezed.parent / "paraview"
    assert len(list(folder.glob("box_*.vtp"))) == len(edges) == len(list(folder.glob("frame_*.vtp")))
    assert "box.pvd" in (folder / "view.py").read_text()
