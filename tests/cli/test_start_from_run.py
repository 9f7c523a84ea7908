"""rods.start = "run": another run, its last state or one of its frames, is where a run begins."""

import json
import shutil

import numpy as np
import pytest

from jostle_command import BAD_INPUT, DONE, command, finish, require_one_line, snapshot

SCENE = """seed = {seed}
[box]
volume_fraction = 0.25
[rods]
count = 60
length = 2.0
{rods}
[motion]
{motion}
[time]
step = 0.01
equilibration = 0.0
production = {production}
[output]
series_every = 5
trajectory_every = 10
{more}
"""


def write(folder, name="scene.toml", seed=1, rods="", motion="", production=1.0, more=""):
    folder.mkdir(exist_ok=True, parents=True)
    (folder / name).write_text(SCENE.format(seed=seed, rods=rods, motion=motion, production=production, more=more))


def frames(folder):
    import h5py
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        return {name: rods[f"{name}/value"][()] for name in ("position", "orientation", "length", "diameter", "id")}


@pytest.fixture(scope="module")
def first(tmp_path_factory):
    """A run of swimmers with speeds, lengths and diameters of their own."""
    folder = tmp_path_factory.mktemp("first")
    write(folder, rods="length_deviation = 0.3\ndiameter_deviation = 0.05", motion="self_propulsion = 0.5\nself_propulsion_deviation = 0.1")
    finish(folder)
    return folder


OF_FIRST = {"rods": 'start = "run"\nrun = "run"', "motion": "self_propulsion = 0.5\nself_propulsion_deviation = 0.1"}


def begun(tmp_path, first, run="second", **scene):
    shutil.copytree(first, tmp_path / "there")
    write(tmp_path / "there", "again.toml", **{**OF_FIRST, **scene})
    done = command(tmp_path / "there", "run", "again.toml", "--out", run, "--quiet")
    assert done.returncode == DONE, done.stderr
    return tmp_path / "there" / run


def test_begins_where_the_other_ended(tmp_path, first):
    """Places, directions and sizes of all rods."""
    there, here = frames(first / "run"), frames(begun(tmp_path, first, seed=7))
    for name, values in there.items():
        assert np.array_equal(values[-1], here[name][0]), name
    assert not np.array_equal(here["position"][0], here["position"][-1])


def test_begins_at_a_frame(tmp_path, first):
    there, here = frames(first / "run"), frames(begun(tmp_path, first, rods='start = "run"\nrun = "run"\nframe = 3'))
    for name, values in there.items():
        assert np.allclose(values[3], here[name][0], rtol=0, atol=1e-6), name
    assert np.array_equal(there["length"][3], here["length"][0])


def test_swimmers_keep_their_speeds(tmp_path, first):
    """Without noise each rod goes along its axis by its own speed: where nothing is in the way, as far a step as in the first run."""
    motion = "brownian = false\nself_propulsion = 0.5\nself_propulsion_deviation = 0.1"
    far = "[contact]\noverlap_limit = 0.5"
    write(tmp_path / "a", motion=motion, production=0.2, more=far)
    finish(tmp_path / "a")
    write(tmp_path / "a", "again.toml", seed=9, rods='start = "run"\nrun = "run"', motion=motion, production=0.2, more=far)
    assert command(tmp_path / "a", "run", "again.toml", "--out", "second", "--quiet").returncode == DONE
    write(tmp_path / "a", "other.toml", seed=9, rods='start = "run"\nrun = "run"', motion=motion.replace("0.1", "0.11"), production=0.2, more=far)
    assert command(tmp_path / "a", "run", "other.toml", "--out", "third", "--quiet").returncode == DONE

    def speeds(name):
        of = frames(tmp_path / "a" / name)
        step = of["position"][1] - of["position"][0]
        return np.einsum("ia,ia->i", step, of["orientation"][0]) / 0.1
    first_run, second, third = speeds("run"), speeds("second"), speeds("third")
    free = (abs(first_run) < 1.0) & (abs(second) < 1.0) & (abs(third) < 1.0)
    assert np.median(abs(first_run - second)[free]) < 1e-4, "the same speeds, with another seed"
    assert np.median(abs(first_run - third)[free]) > 0.02, "another law draws anew"


def test_goes_on_by_itself(tmp_path, first):
    """Once begun, it needs the other run no more, and goes on to the same bits."""
    whole = begun(tmp_path, first, production=1.0)
    write(tmp_path / "there", "part.toml", production=0.4, **OF_FIRST)
    assert command(tmp_path / "there", "run", "part.toml", "--out", "part", "--quiet").returncode == DONE
    shutil.rmtree(tmp_path / "there" / "run")
    write(tmp_path / "there", "part.toml", production=1.0, **OF_FIRST)
    assert command(tmp_path / "there", "run", "part.toml", "--out", "part", "--quiet").returncode == DONE
    assert (whole / "series.csv").read_bytes() == (tmp_path / "there/part/series.csv").read_bytes()


def test_springs_hold_the_copies_that_they_held(tmp_path):
    """A chain through the faces of the box: springs are as long at the start as at the end of the first run."""
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n" + "".join(f"{x},2,2,1,0,0\n" for x in (1, 3.2, 5.4, 7.6)))
    (tmp_path / "springs.csv").write_text("rod_1,rod_2,s_1,s_2,rest_length,stiffness\n" +
                                          "".join(f"{k},{(k + 1) % 4},0.5,-0.5,1.0,20\n" for k in range(4)))
    text = ('[box]\nedges = [8.8, 4, 4]\n[rods]\nlength = 1.0\n{}\n[springs]\nfile = "springs.csv"\n[time]\nstep = 0.002\n'
            'equilibration = 0.0\nproduction = 4.0\n[output]\nseries_every = 1\n')
    (tmp_path / "scene.toml").write_text(text.format('start = "file"\nfile = "rods.csv"'))
    finish(tmp_path)
    (tmp_path / "again.toml").write_text(text.format('start = "run"\nrun = "run"'))
    assert command(tmp_path, "run", "again.toml", "--out", "second", "--quiet").returncode == DONE
    series = [np.genfromtxt(tmp_path / name / "series.csv", delimiter=",", names=True) for name in ("run", "second")]
    last, begin = series[0]["pressure_springs"][-1], series[1]["pressure_springs"][0]
    step = abs(np.diff(series[0]["pressure_springs"])).max()
    assert abs(begin - last) < 3 * step < 0.5 * abs(series[0]["pressure_springs"]).max() + 3 * step
    assert abs(series[1]["pressure_springs"]).max() < 3 * abs(series[0]["pressure_springs"]).max(), "no spring reaches through the box"
    assert command(tmp_path, "run", "again.toml", "--out", "second", "--quiet").returncode == DONE, "goes on with the same springs"


def test_a_colony_goes_on_as_another(tmp_path):
    """Ids count anew; dead cells are left out."""
    text = ("[box]\nedges = [40, 40, 40]\nperiodic = [false, false, false]\n[rods]\n{}length = 2.0\n[fluid]\nkT = 0.01\n[growth]\nrate = 1.0\n"
            "division_length = 5.0\ndeath_rate = 0.05\n[time]\nstep = 0.01\nproduction = 9.0\n")
    (tmp_path / "scene.toml").write_text(text.format("count = 3\n"))
    finish(tmp_path)
    (tmp_path / "again.toml").write_text(text.format('start = "run"\nrun = "run"\n'))
    assert command(tmp_path, "run", "again.toml", "--out", "second", "--quiet").returncode == DONE
    there, here = frames(tmp_path / "run"), frames(tmp_path / "second")
    alive = there["id"][-1] >= 0
    count = alive.sum()
    order = np.argsort(there["id"][-1][alive])
    assert count > 5 and here["id"][0][:count].tolist() == list(range(count))
    assert np.allclose(there["length"][-1][alive][order], here["length"][0][:count])


def test_check_tells_of_it(tmp_path, first):
    shutil.copytree(first, tmp_path / "there")
    write(tmp_path / "there", "again.toml", **OF_FIRST)
    told = command(tmp_path / "there", "check", "again.toml")
    assert told.returncode == DONE and 'start = "run"' in told.stdout and "N                            60" in told.stdout


@pytest.mark.parametrize("change, words", [
    ({"rods": 'start = "run"\nrun = "run"\ncount = 61'}, "rods.count = 61: the run run holds 60 rods"),
    ({"rods": 'start = "run"\nrun = "run"\nframe = 11'}, "rods.frame = 11: the run has no such frame (allowed: 0 to 10)"),
    ({"rods": 'start = "run"\nrun = "nowhere"'}, 'rods.run = "nowhere": there is no such folder'),
    ({"rods": 'start = "run"\nrun = "empty"'}, "is not the folder of a run: it holds no checkpoint"),
    ({"rods": 'start = "run"'}, "rods.run: is missing"),
    ({"rods": 'start = "run"\nrun = "run"\nlength_deviation = 0.3'}, "rods keep their sizes"),
    ({"rods": 'count = 60 \nstart = "random"\nrun = "run"'}, 'rods.run = "run": is not used with rods.start = "random"'),
    ({"rods": 'start = "run"\nrun = "run"\nframe = -1'}, "is negative"),
    ({"fraction": "0.4"}, 'rods.run = "run": its rods overlap by up to'),
    ({"rods": 'start = "run"\nrun = "run"\ndiameter = 2.0'}, "rods.diameter = 2.0: is no diameter of the rods in the run run"),
    ({"more": '[units]\nsystem = "micro"\n[fluid]\nviscosity = 1.0\nkT = 1.0', "rods": 'start = "run"\nrun = "run"\ndiameter = 1.0'},
     "is a run in other units"),
])
def test_refuses(tmp_path, first, change, words):
    shutil.copytree(first, tmp_path / "there")
    (tmp_path / "there" / "empty").mkdir()
    fraction = change.pop("fraction", "0.25")
    write(tmp_path / "there", "again.toml", **{**OF_FIRST, **change})
    text = (tmp_path / "there/again.toml").read_text().replace("count = 60\n", "").replace("0.25", fraction)
    (tmp_path / "there/again.toml").write_text(text)
    before = snapshot(tmp_path)
    for name in ("check", "run"):
        done = command(tmp_path / "there", name, "again.toml", *(["--out", "second"] if name == "run" else []))
        assert done.returncode == BAD_INPUT
        require_one_line(done, words)
    assert snapshot(tmp_path) == before


def test_a_run_without_frames_gives_its_last_state(tmp_path):
    write(tmp_path, more="", production=0.2)
    text = (tmp_path / "scene.toml").read_text().replace("trajectory_every = 10", "trajectory_every = 0")
    (tmp_path / "scene.toml").write_text(text)
    finish(tmp_path)
    write(tmp_path, "again.toml", rods='start = "run"\nrun = "run"', production=0.2)
    assert command(tmp_path, "run", "again.toml", "--out", "second", "--quiet").returncode == DONE
    write(tmp_path, "third.toml", rods='start = "run"\nrun = "run"\nframe = 0', production=0.2)
    require_one_line(command(tmp_path, "check", "third.toml"), "rods.frame = 0: the run has no frames")
    assert json.loads((tmp_path / "second/run.json").read_text())["exit_reason"] == "done"
