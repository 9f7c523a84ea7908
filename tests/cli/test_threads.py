"""One thread and two give the same bits, with enough rods that the loops are shared out (from 512 on); how they wait."""

import json
import os
from pathlib import Path

import pytest

from jostle_command import (BAD_INPUT, DONE, JOSTLE, STOPPED, changed, checkpoint_step, command, finish, kill, require_one_line,
                            require_same_results, rows_of, run, start, wait_until, with_steps, write_scene)
from test_out_of_memory import at_most

OUTPUT = {"series_every": 2, "trajectory_every": 3, "checkpoint_every": 4, "contacts": True}
SCENES = {
    "rods": {"seed": 11, "box": {"volume_fraction": 0.3}, "rods": {"count": 1500, "length": 5.0},
             "time": {"step": 0.01, "equilibration": 0.0, "production": 0.06}, "output": OUTPUT},
    "spheres": {"seed": 12, "box": {"volume_fraction": 0.4}, "rods": {"count": 2000, "length": 0.0},
                "time": {"step": 0.002, "equilibration": 0.0, "production": 0.012}, "output": OUTPUT},
}


def environment_without(*names):
    return {name: value for name, value in os.environ.items() if name not in names}


def threads_of(folder):
    return [session["threads"] for session in json.loads((folder / "run.json").read_text())["sessions"]]


@pytest.mark.parametrize("name", SCENES)
def test_threads(tmp_path, name):
    folder = {}
    for threads in (1, 2):
        write_scene(tmp_path / str(threads), SCENES[name])
        folder[threads] = finish(tmp_path / str(threads), threads=threads)
        assert threads_of(folder[threads]) == [threads]
    require_same_results(folder[2], folder[1], same_command=False)


def test_threads_may_change_when_a_run_goes_on(tmp_path):
    for name in ("reference", "changed"):
        write_scene(tmp_path / name, changed(SCENES["rods"], rods={"start": "lattice"}))
    reference = finish(tmp_path / "reference")
    assert run(tmp_path / "changed", "--walltime", "0:00:01", threads=2).returncode == STOPPED
    assert checkpoint_step(tmp_path / "changed/run") == 1
    result = run(tmp_path / "changed")
    assert result.returncode == DONE, result.stderr
    assert threads_of(tmp_path / "changed/run") == [2, 1]
    require_same_results(tmp_path / "changed/run", reference)


LIMITED = {"GOMP_SPINCOUNT": "10000"}


@pytest.mark.parametrize("environment, options, expected", [
    ({}, [], LIMITED), ({"OMP_WAIT_POLICY": "active"}, [], {"OMP_WAIT_POLICY": "active"}), ({"GOMP_SPINCOUNT": "7"}, [], {"GOMP_SPINCOUNT": "7"}),
    ({}, ["--spin-waiting"], {}), ({"OMPI_COMM_WORLD_RANK": "0"}, [], LIMITED)])
def test_threads_wait_briefly_unless_told_otherwise(tmp_path, environment, options, expected):
    """By the environment, or an option; ranks of MPI, too, wait briefly."""
    write_scene(tmp_path, with_steps(changed(SCENES["spheres"], rods={"count": 100}), 10**6))
    process = start(tmp_path, *options, env={**environment_without("OMP_WAIT_POLICY", "GOMP_SPINCOUNT"), **environment})
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 0, process)
    seen = dict(entry.split("=", 1) for entry in Path(f"/proc/{process.pid}/environ").read_text().split("\0") if entry)
    assert Path(f"/proc/{process.pid}/comm").read_text() == Path(JOSTLE).name + "\n"
    kill(process)
    assert {name: seen[name] for name in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT") if name in seen} == expected


@pytest.mark.parametrize("count, environment, expected", [
    (3999, {}, 1), (4000, {}, min(2, len(os.sched_getaffinity(0)))), (100, {"OMP_NUM_THREADS": "2"}, 2)])
def test_threads_are_started_where_they_are_worth_it(tmp_path, count, environment, expected):
    write_scene(tmp_path, with_steps(changed(SCENES["spheres"], box={"volume_fraction": 0.01}, rods={"count": count}), 2))
    result = command(tmp_path, "run", "scene.toml", "--out", "run",
                     env={**environment_without("OMP_NUM_THREADS"), **environment})
    assert result.returncode == DONE, result.stderr
    assert threads_of(tmp_path / "run") == [expected]


@pytest.mark.parametrize("count", ["0", "-1", "4097", "99999999999", "two", "2x", ""])
def test_numbers_of_threads_that_are_none(tmp_path, count):
    """On the command line and in the environment; OpenMP's library may have said a line of its own about the latter."""
    write_scene(tmp_path, SCENES["spheres"])
    option = command(tmp_path, "run", "scene.toml", "--out", "run", f"--threads={count}")
    require_one_line(option, "--threads")
    if count:
        environment = command(tmp_path, "run", "scene.toml", "--out", "run", env={**os.environ, "OMP_NUM_THREADS": count})
        assert environment.returncode == BAD_INPUT
        expected = f"jostle: OMP_NUM_THREADS = {count}: is no number of threads (allowed: 1 to 4096)"
        assert [line for line in environment.stderr.splitlines() if line and "libgomp" not in line] == [expected]
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("by_option", [True, False])
def test_more_threads_than_can_be_started(tmp_path, by_option):
    """OpenMP's library would end the program."""
    write_scene(tmp_path, SCENES["spheres"])
    options = ("--threads", "4096") if by_option else ()
    environment = os.environ if by_option else {**os.environ, "OMP_NUM_THREADS": "4096"}
    result = command(tmp_path, "run", "scene.toml", "--out", "run", *options, env=environment, preexec_fn=at_most(1000))
    name = "--threads" if by_option else "OMP_NUM_THREADS"
    require_one_line(result, f"{name} = 4096: the system does not start so many threads (allowed: 1 to ")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("value", ["2", " 2 ", "2,1"])
def test_numbers_of_threads_as_openmp_writes_them(tmp_path, value):
    write_scene(tmp_path, with_steps(changed(SCENES["spheres"], rods={"count": 50}), 2))
    result = command(tmp_path, "run", "scene.toml", "--out", "run", env={**os.environ, "OMP_NUM_THREADS": value})
    assert result.returncode == DONE, result.stderr
    assert threads_of(tmp_path / "run") == [2]
