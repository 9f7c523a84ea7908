"""How a random start was made is told on the terminal and in run.json, and kept when a run goes on."""

import json

import pytest

from jostle_command import BAD_INPUT, DONE, RODS, changed, command, finish, require_one_line, run, with_steps, write_scene

DENSE = changed(with_steps(RODS, 20), box={"volume_fraction": 0.35})
DILUTE = changed(DENSE, box={"volume_fraction": 0.02})
NEMATIC = changed(DENSE, box={"volume_fraction": 0.44}, rods={"length": 5.0})


def entry(folder):
    return json.loads((folder / "run/run.json").read_text())["start"]


def test_an_annealed_start_is_told(tmp_path):
    write_scene(tmp_path, DENSE)
    done = run(tmp_path)
    assert done.returncode == DONE
    record = entry(tmp_path)
    assert record["kind"] == "random" and record["annealed"] is True
    assert record["sweeps"] > 10 and 600 <= record["steps"] <= 1800
    assert record["settled"] in (True, False) and record["Z"] > 3.0 and 0.0 < record["nematic_order"] < 0.6
    assert "warning" not in record
    assert record["in_words"] in done.stderr and "jostle: start in " in done.stderr


def test_a_run_that_goes_on_keeps_its_start(tmp_path):
    write_scene(tmp_path, DENSE)
    finish(tmp_path)
    first = entry(tmp_path)
    write_scene(tmp_path, with_steps(DENSE, 40))
    done = run(tmp_path)
    assert done.returncode == DONE and "start in" not in done.stderr
    assert entry(tmp_path) == first


def test_dilute_and_ordered_starts_are_not_annealed(tmp_path):
    write_scene(tmp_path, DILUTE)
    assert "start in" not in run(tmp_path).stderr
    assert entry(tmp_path) == {"kind": "random", "annealed": False,
                               "in_words": "random, each rod drawn anew until it overlapped no other"}
    write_scene(tmp_path, changed(DENSE, rods={"start": "aligned"}))
    finish(tmp_path, "--fresh")
    assert entry(tmp_path) == {"kind": "aligned"}


def test_rods_that_should_order_are_warned_of(tmp_path):
    write_scene(tmp_path, NEMATIC)
    done = run(tmp_path)
    warning = entry(tmp_path)["warning"]
    assert "beyond a volume fraction of about 0.41 rods of L/D = 5 order" in warning
    assert f"jostle: WARNING: {warning}\n" in done.stderr
    assert warning in command(tmp_path, "check", "scene.toml").stdout
    write_scene(tmp_path, changed(NEMATIC, box={"volume_fraction": 0.40}))
    assert "WARNING" not in command(tmp_path, "check", "scene.toml").stdout


@pytest.mark.parametrize("options", [[], ["--fresh"]])
def test_a_folder_that_cannot_be_taken_is_refused_before_the_start(tmp_path, options):
    """A dense start takes a while: its notice is not there."""
    write_scene(tmp_path, DENSE)
    (tmp_path / "run").mkdir()
    (tmp_path / "run/letter.txt").write_text("mine")
    refused = run(tmp_path, *options)
    require_one_line(refused, "--out", "no run of jostle made it")
    assert refused.stderr.count("\n") == 1, refused.stderr


def test_a_start_that_takes_longer_than_the_wall_time_leaves_nothing(tmp_path):
    write_scene(tmp_path, changed(DENSE, rods={"count": 3000, "length": 5.0}))
    done = run(tmp_path, "--walltime", "0:00:01")
    assert done.returncode == BAD_INPUT  # 75 would have it tried again and again
    assert done.stderr.endswith("jostle: --walltime: was over before the start was made, of which nothing is kept. "
                                "Give more, or more --threads\n")
    assert not (tmp_path / "run").exists()
