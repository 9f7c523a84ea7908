"""Too little memory, for the start or for a step: the run says so, and with enough the same command does all that it was to do."""

import resource
import time

import pytest

from jostle_command import (DONE, changed, command, finish, require_one_line, require_same_results, run, with_steps,
                            write_scene)

INTERNAL = 1
DILUTE = with_steps({"seed": 5, "box": {"volume_fraction": 0.05}, "rods": {"count": 20_000, "length": 5.0},
                     "time": {"step": 1e-4, "equilibration": 0.0}}, 30)


def at_most(megabytes):
    return lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))


@pytest.mark.parametrize("threads", [1, 2])
def test_out_of_memory(tmp_path, threads):
    for name in ("reference", "short"):
        write_scene(tmp_path / name, DILUTE)
    reference = finish(tmp_path / "reference", threads=threads)
    failures = 0
    for megabytes in range(28, 400, 2 * threads):
        if command(tmp_path, "--version", preexec_fn=at_most(megabytes)).returncode != DONE:
            continue  # not even the libraries fit
        result = run(tmp_path / "short", threads=threads, preexec_fn=at_most(megabytes))
        if result.returncode == DONE:
            break
        if "the system does not start so many threads" in result.stderr:
            continue
        assert (result.returncode, result.stdout) == (INTERNAL, ""), result.stderr
        assert "jostle: out of memory; `jostle check SCENE.toml` estimates what a scene needs\n" in result.stderr
        failures += 1
    assert result.returncode == DONE and failures >= 3
    require_same_results(tmp_path / "short/run", reference, same_command=False)


@pytest.mark.parametrize("name, table", [("check", {"rods": {"length_deviation": 0.1}}),
                                         ("check", {"motion": {"self_propulsion": 0.1, "self_propulsion_deviation": 0.01}}),
                                         ("run", {"rods": {"diameter_deviation": 0.01}})])
def test_rods_that_would_never_fit_are_not_drawn(tmp_path, name, table):
    """It took half a minute and all the memory there was."""
    write_scene(tmp_path, changed(changed(DILUTE, rods={"count": 1_000_000_000}), **table))
    began = time.monotonic()
    result = command(tmp_path, name, "scene.toml", preexec_fn=at_most(2000))
    assert time.monotonic() - began < 5.0
    require_one_line(result, "scene.toml:", "rods.count = 1000000000", "needs 480 GB of memory at least", "gives 2.1 GB")
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]
