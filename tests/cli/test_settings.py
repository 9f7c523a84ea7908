"""`--set KEY=VALUE` of run and check: what is run, what the folder says, what is refused."""

import json
import tomllib

import pytest

from jostle_command import BAD_INPUT, DONE, SPHERES, command, require_one_line, run, snapshot, write_scene


@pytest.fixture(scope="module")
def dense(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dense")
    write_scene(folder, SPHERES)
    result = run(folder, "--set", "box.volume_fraction=0.35", "--set", "rods.start=aligned", "--set=title=a run")
    assert result.returncode == DONE, result.stderr
    return folder


def test_the_folder_tells_what_was_run(dense):
    for name in ("scene.toml", "resolved.toml"):
        scene = tomllib.loads((dense / "run" / name).read_text())
        assert (scene["box"]["volume_fraction"], scene["rods"]["start"], scene["title"]) == (0.35, "aligned", "a run"), name
        assert scene["rods"]["count"] == 64
    assert command(dense, "verify", "run").returncode == DONE
    summary = json.loads((dense / "run/summary.json").read_text())
    assert (summary["title"], summary["seed"], summary["L_over_D"], summary["volume_fraction"]) == ("a run", 8, 0.0, 0.35)
    assert summary["box"]["periodic"] == [True] * 3 and summary["self_propulsion"]["mean"] == 0.0
    version = json.loads((dense / "run/run.json").read_text())
    assert (summary["version"], summary["git"]) == (version["version"], version["git"])


def test_going_on_takes_the_same_settings(dense):
    before = snapshot(dense)
    require_one_line(run(dense), "the checkpoint is of another scene", "--out")
    require_one_line(run(dense, "--set", "box.volume_fraction=0.3"), "the checkpoint is of another scene")
    assert snapshot(dense) == before
    again = run(dense, "--set", "box.volume_fraction=0.35", "--set", "rods.start=aligned", "--set", "title=a run")
    assert again.returncode == DONE and "going on from step" in again.stderr


def test_check_shows_what_is_set(spheres):
    told = command(spheres, "check", "scene.toml", "--set", "box.edges=[20, 20, 30]", "--set", "seed=5").stdout
    scene = tomllib.loads(told.partition("# what follows")[0])
    assert scene["box"]["edges"] == [20, 20, 30] and scene["seed"] == 5 and "volume_fraction" not in scene["box"]


@pytest.mark.parametrize("setting, parts", [
    ("box.volume_fracton=0.3", ("--set: box.volume_fracton = 0.3: is an unknown key", 'Did you mean "volume_fraction"?')),
    ("box.volume_fraction=0.9", ("--set: box.volume_fraction = 0.9:", "cannot be packed")),
    ("box.volume_fraction=0.1,0.2", ('--set: box.volume_fraction = "0.1,0.2": is a text',)),
    ("rods.count", ("is not of the form KEY=VALUE",)),
])
def test_bad_settings(spheres, setting, parts):
    before = snapshot(spheres)
    for name in ("run", "check"):
        require_one_line(command(spheres, name, "scene.toml", "--set", setting), *parts)
    assert snapshot(spheres) == before


def test_a_dense_start_is_refused_by_what_was_set(spheres):
    """This is found when the start is made, from the file that still says 0.3."""
    result = run(spheres, "--set", "box.volume_fraction=0.7")
    assert result.returncode == BAD_INPUT
    assert result.stderr.startswith("jostle: --set: box.volume_fraction = 0.7: "), result.stderr


def test_a_sweep_in_the_scene_is_not_run_by_run(spheres):
    scene = (spheres / "scene.toml").read_text()
    write_scene(spheres, scene + "[sweep]\nbox.volume_fraction = [0.1, 0.2]\n")
    result = run(spheres)
    assert result.returncode == DONE and "`jostle sweep`" in result.stderr
