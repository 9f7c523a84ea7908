"""Ctrl-C, SIGTERM and --walltime: the run stops after the step at hand, and the same command goes on from there."""

import json
import shutil
import signal
import subprocess
import time

import pytest

from jostle_command import (BAD_INPUT, DONE, RODS, STOPPED, changed, checkpoint_step, column, command, finish, kill,
                            random_numbers, require_every_row, require_same_results, rows_of, run,
                            start, wait_until, with_steps, write_scene)

ENDLESS = changed(with_steps(RODS, 10**6), output={"checkpoint_every": 10**7, "contacts": False})
STEPS = 3005
BEFORE_STEPS = "jostle: stopped before a step was made\n"


@pytest.fixture(scope="module")
def reference(tmp_path_factory):
    folder = tmp_path_factory.mktemp("reference")
    write_scene(folder, with_steps(RODS, STEPS))
    began = time.monotonic()
    return finish(folder), time.monotonic() - began


def test_a_longer_production_goes_on_from_the_end(tmp_path, reference):
    write_scene(tmp_path, with_steps(RODS, 1000))
    finish(tmp_path)
    write_scene(tmp_path, changed(with_steps(RODS, STEPS - 50), time={"equilibration": 50 * RODS["time"]["step"]}))
    finish(tmp_path)
    record = json.loads((tmp_path / "run/run.json").read_text())
    assert [session["last_step"] for session in record["sessions"]] == [1000, STEPS]
    write_scene(tmp_path, with_steps(RODS, STEPS))  # and now only the averages are others
    finish(tmp_path)
    require_same_results(tmp_path / "run", reference[0])
    require_every_row(tmp_path / "run", 5, STEPS)


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_stop_and_go_on(tmp_path, reference, number):
    folder, lasted = reference
    random = random_numbers()
    write_scene(tmp_path, with_steps(RODS, STEPS))
    stops = 0
    while True:
        process = start(tmp_path)
        try:
            stdout, stderr = process.communicate(timeout=random.uniform(0.1, 0.4) * lasted)
        except subprocess.TimeoutExpired:
            _, stdout, stderr = kill(process, number)
        if process.returncode == DONE and stops == 0:  # the machine has become faster
            shutil.rmtree(tmp_path / "run")
            lasted /= 2
            continue
        if process.returncode == DONE:
            break
        assert process.returncode == STOPPED, (process.returncode, stderr)
        if BEFORE_STEPS in stderr:
            continue
        stops += 1
        assert stdout == ""
        step = checkpoint_step(tmp_path / "run")
        assert f"jostle: stopped at step {step} (signal {int(number)}); run the same command again" in stderr
        record = json.loads((tmp_path / "run/run.json").read_text())
        assert record["exit_reason"] == f"signal {int(number)}" and record["steps"] == step
        assert len(record["sessions"]) == stops
        assert f"checkpoint: sound, step {step}\n" in command(tmp_path, "verify", "run").stdout
        assert rows_of(tmp_path / "run/series.csv") == step // 5
        assert (tmp_path / "run/trajectory.h5").exists()
    assert stops >= 1
    require_same_results(tmp_path / "run", folder)
    require_every_row(tmp_path / "run", 5, STEPS)
    record = json.loads((tmp_path / "run/run.json").read_text())
    assert record["exit_reason"] == "done" and record["steps"] == STEPS
    first = [session["first_step"] for session in record["sessions"]]
    last = [session["last_step"] for session in record["sessions"]]
    assert first == [0, *last[:-1]], "the sessions join"


def test_second_signal_ends_at_once(tmp_path):
    """Two signals that wait for a process that was halted arrive together: no step, no checkpoint between them."""
    write_scene(tmp_path, ENDLESS)
    process = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 2, process)
    process.send_signal(signal.SIGSTOP)
    process.send_signal(signal.SIGTERM)
    process.send_signal(signal.SIGINT)
    status, stdout, stderr = kill(process, signal.SIGCONT)
    assert status == STOPPED
    assert stdout == "" and "stopped at step" not in stderr
    assert checkpoint_step(tmp_path / "run") == 0
    assert json.loads((tmp_path / "run/run.json").read_text())["exit_reason"] == "running"
    assert command(tmp_path, "verify", "run").returncode == DONE


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_start_that_takes_long_is_stopped_at_once(tmp_path, number):
    write_scene(tmp_path, changed(RODS, box={"volume_fraction": 0.35}, rods={"count": 100_000, "length": 5.0}))
    process = start(tmp_path)
    time.sleep(1.0)
    status, stdout, stderr = kill(process, number)
    assert (status, stdout) == (STOPPED, "")
    assert stderr == "jostle: placing 100000 rods without overlap\n" + BEFORE_STEPS
    assert not (tmp_path / "run").exists()


def test_walltime_is_kept(tmp_path):
    write_scene(tmp_path, ENDLESS)
    began = time.monotonic()
    result = run(tmp_path, "--walltime", "0:00:03")
    lasted = time.monotonic() - began
    assert result.returncode == STOPPED, result.stderr
    assert lasted < 3.0, "stopped too late"
    assert lasted > 1.0, "stopped far too early"
    step = checkpoint_step(tmp_path / "run")
    assert f"stopped at step {step} (walltime)" in result.stderr
    # Another run of it that was stopped in between has the same rows, as far as both go.
    write_scene(tmp_path / "other", ENDLESS)
    assert run(tmp_path / "other", "--walltime", "0:00:02").returncode == STOPPED
    first_stop = rows_of(tmp_path / "other/run/series.csv")
    process = start(tmp_path / "other")
    wait_until(lambda: rows_of(tmp_path / "other/run/series.csv") > first_stop + 10, process)
    assert kill(process, signal.SIGTERM)[0] == STOPPED
    ours = (tmp_path / "run/series.csv").read_bytes()
    theirs = (tmp_path / "other/run/series.csv").read_bytes()
    both = min(len(ours), len(theirs))
    assert ours[:both] == theirs[:both]
    for folder in (tmp_path / "run", tmp_path / "other/run"):
        require_every_row(folder, 5, 5 * rows_of(folder / "series.csv"))


def test_walltime_then_to_the_end(tmp_path):
    """A wall time of a second is over after one step; a few of these, then the rest."""
    scene = changed(with_steps(RODS, 60), rods={"start": "aligned"})  # a start that takes no time
    write_scene(tmp_path / "reference", scene)
    reference = finish(tmp_path / "reference")
    write_scene(tmp_path / "stopped", scene)
    for step in range(1, 8):
        assert run(tmp_path / "stopped", "--walltime", "0:00:01").returncode == STOPPED
        assert checkpoint_step(tmp_path / "stopped/run") == step
    assert run(tmp_path / "stopped", "--walltime", "10:00").returncode == DONE
    require_same_results(tmp_path / "stopped/run", reference, same_command=False)
    assert column(tmp_path / "stopped/run/series.csv", "step") == list(range(5, 61, 5))


def test_swimmers_that_tumble_go_on(tmp_path):
    """Stopped in the middle of tumbles, with the positions that the active stress counts from, on two threads."""
    scene = changed(RODS, rods={"count": 600},
                    motion={"self_propulsion": 1.0, "self_propulsion_deviation": 0.3, "tumble_rate": 2.0,
                            "tumble_time": 0.4, "reversal_rate": 1.0},
                    output={"active_stress_lag": 1.0, "contacts": False})
    scene = with_steps(scene, 400)
    for name in ("reference", "stopped"):
        write_scene(tmp_path / name, scene)
    reference = finish(tmp_path / "reference")
    for rows in (7, 33):
        process = start(tmp_path / "stopped", threads=2)
        wait_until(lambda: rows_of(tmp_path / "stopped/run/series.csv") > rows, process)
        assert kill(process, signal.SIGTERM)[0] == STOPPED
    finish(tmp_path / "stopped")
    require_same_results(tmp_path / "stopped/run", reference, same_command=False)
    assert all(value > 0 for value in column(reference / "series.csv", "pressure_active")[9:])


@pytest.mark.parametrize("text", ["3", "1:60", "1:00:60", "-1:00", "1:00 ", "one hour", "", "24", "1h2d", "5h 6h", "-3h", "1-", "1-24:00:00", "1-2-3", "h", "1e3s", "infh",
                                  "1:2:3:4", "99999999h", "3 weeks", "1--2"])
def test_walltime_that_is_none(tmp_path, text):
    write_scene(tmp_path, RODS)
    result = run(tmp_path, "--walltime", text)
    assert result.returncode == BAD_INPUT
    assert "--walltime" in result.stderr
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("text, seconds", [("0:00:01", 1), ("1s", 1), ("1 s", 1), ("0h 0min 1s", 1), ("0.02min", 1.2), ("0-00:00:01", 1)])
def test_walltime_in_other_words(tmp_path, text, seconds):
    """Short ones stop the run; it would last for hours."""
    write_scene(tmp_path, changed(ENDLESS, rods={"start": "aligned"}))  # which takes no time
    began = time.monotonic()
    assert run(tmp_path, "--walltime", text).returncode == STOPPED
    assert time.monotonic() - began < seconds + 5.0


@pytest.mark.parametrize("text", ["24h", "1-00:00:00", "1-12", "90min", "90m", "1h30min", "1h 30m", "2 days", "1d12h", "1.5h", "23:50", "100:00:00"])
def test_walltime_is_no_shorter_than_it_says(tmp_path, text):
    write_scene(tmp_path, with_steps(RODS, 20))
    assert run(tmp_path, "--walltime", text).returncode == DONE
