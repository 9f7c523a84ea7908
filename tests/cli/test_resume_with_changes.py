"""What may be otherwise when a run goes on: the end, limits, and what else is written and when. Results stay the same."""

import json
import shutil
from pathlib import Path

import h5py
import pytest

from jostle_command import DONE, RODS, changed, checkpoint_step, command, finish, require_one_line, run, with_steps, write_scene

ROOT = Path(__file__).resolve().parents[2]
HALF, WHOLE, LONGER = 50, 100, 150  # steps


@pytest.fixture(scope="module")
def half(tmp_path_factory):
    folder = tmp_path_factory.mktemp("half")
    write_scene(folder, with_steps(RODS, HALF))
    finish(folder)
    return folder


@pytest.fixture
def half_copy(half, tmp_path):
    return shutil.copytree(half, tmp_path / "copy")


def steps_of(path):
    return sorted({int(line.split(",")[0]) for line in path.read_text().splitlines()[1:]})


def frames(folder):
    with h5py.File(folder / "run/trajectory.h5") as file:
        return list(file["particles/rods/position/step"])


def go_on(folder, steps=WHOLE, **changes):
    write_scene(folder, changed(with_steps(RODS, steps), **changes))
    result = run(folder)
    assert result.returncode == DONE, result.stderr
    assert checkpoint_step(folder / "run") == steps
    verified = command(folder, "verify", "run")
    assert verified.returncode == DONE, verified.stderr


@pytest.mark.parametrize("changes", [
    {"title": "another"}, {"contact": {"overlap_limit": 0.5}}, {"solver": {"max_iterations": 20000}},
    {"output": {"checkpoint_every": 7}}, {"output": {"trajectory_every": 5}}, {"output": {"trajectory_every": 0}},
    {"output": {"contacts": False}}, {"output": {"field_every": 10, "field_spacing": 2.0}}], ids=str)
def test_the_series_does_not_depend_on_it(half_copy, finished, changes):
    go_on(half_copy, **changes)
    assert (half_copy / "run/series.csv").read_bytes() == (finished / "run/series.csv").read_bytes()
    summary = json.loads((half_copy / "run/summary.json").read_text())
    assert summary["title"] == changes.get("title", "")


def test_frames_at_other_steps(half_copy):
    go_on(half_copy, output={"trajectory_every": 5})
    assert frames(half_copy) == [0, 12, 24, 36, 48, *range(55, 101, 5)]


def test_frames_end_and_begin_again(half_copy):
    go_on(half_copy, output={"trajectory_every": 0})
    assert frames(half_copy) == [0, 12, 24, 36, 48]
    go_on(half_copy, LONGER, output={"trajectory_every": 20})
    assert frames(half_copy) == [0, 12, 24, 36, 48, 120, 140]


def test_frames_of_a_run_that_had_none(tmp_path):
    """The first is where the run went on: no step led to it."""
    write_scene(tmp_path, changed(with_steps(RODS, HALF), output={"trajectory_every": 0}))
    finish(tmp_path)
    assert not (tmp_path / "run/trajectory.h5").exists()
    go_on(tmp_path, output={"trajectory_every": 20, "stress_per_rod": True})
    assert frames(tmp_path) == [50, 60, 80, 100]
    with h5py.File(tmp_path / "run/trajectory.h5") as file:
        stress = file["particles/rods/stress_collision/value"][()]
    assert (stress[0] != stress[0]).all() and (stress[1:] == stress[1:]).all()
    go_on(tmp_path, LONGER, output={"trajectory_every": 0})
    write_scene(tmp_path, changed(with_steps(RODS, 200), output={"trajectory_every": 20}))
    require_one_line(run(tmp_path), "output.stress_per_rod = false: the frames that the run has are with it")


def test_contacts_and_fields_begin_and_end_where_they_are_asked_to(half_copy):
    go_on(half_copy, output={"contacts": False, "field_every": 30})
    assert max(steps_of(half_copy / "run/contacts.csv")) == HALF
    assert steps_of(half_copy / "run/field.csv") == [60, 90]
    go_on(half_copy, LONGER, output={"contacts": True, "field_every": 20})
    assert steps_of(half_copy / "run/contacts.csv") == [*range(5, 51, 5), *range(105, 151, 5)]
    assert steps_of(half_copy / "run/field.csv") == [60, 90, 120, 140]
    described = json.loads((half_copy / "run/field.json").read_text())["columns"]
    assert ",".join(column["name"] for column in described) == (half_copy / "run/field.csv").read_text().splitlines()[0]


def test_a_step_that_failed_goes_on_with_another_limit(tmp_path):
    """What post_mortem.json and the message advise: a larger solver.max_iterations, and the same command again."""
    scene = changed(with_steps(RODS, HALF), solver={"method": "bbpgd", "max_iterations": 3})
    write_scene(tmp_path, scene)
    failed = run(tmp_path)
    assert failed.returncode == 3 and "max_iterations" in failed.stderr
    write_scene(tmp_path, changed(scene, solver={"max_iterations": 5000}))
    finish(tmp_path)
    assert checkpoint_step(tmp_path / "run") == HALF


def test_the_keys_that_may_change_are_those_of_the_guide(tmp_path):
    listed = {key["key"] for key in json.loads(command(tmp_path, "keys", "--json").stdout) if key["may_change"]}
    text = (ROOT / "docs/guide/stopping.md").read_text()
    paragraph = next(part for part in text.split("\n\n") if "may have other values when a run goes on" in part)
    assert listed == set(paragraph.split("`")[1::2])
