"""What surrounds a run: closed descriptors, full standard output, folders that are moved, links, pipes, signals."""

import os
import shutil
import signal
import subprocess
import time

import pytest

from jostle_command import (BAD_INPUT, DISK, DONE, JOSTLE, NUMERICS, RODS, STOPPED, changed, checkpoint_step, column,
                            command, finish, kill, lines_but_notices, require_one_line, require_same_results, rows_of, run, run_arguments,
                            start, started, wait_until, with_steps, write_scene)

ENDLESS = changed(with_steps(RODS, 10**6), output={"checkpoint_every": 10**7})
# A step that never ends: no solution is as good as that.
UNSOLVABLE = changed(RODS, solver={"tolerance": 1e-30, "max_iterations": 10**18})


@pytest.mark.parametrize("closed", [(1, 2), (0, 1, 2), (1,), (2,)])
def test_closed_descriptors(tmp_path, finished, closed):
    """What is printed goes nowhere, and above all into no file of the run."""
    write_scene(tmp_path, RODS)
    process = subprocess.Popen([JOSTLE, *run_arguments()], cwd=tmp_path, close_fds=False, stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=lambda: [os.close(number) for number in closed])
    started.append(process)
    assert process.wait(timeout=60) == DONE
    require_same_results(tmp_path / "run", finished / "run")
    assert (tmp_path / "run/lock").read_text() == f"jostle runs here as process {process.pid}\n"


@pytest.mark.parametrize("arguments", [["check", "scene.toml"], ["verify", "run"], ["--help"], ["--version"],
                                       run_arguments(), run_arguments("--json")], ids=" ".join)
def test_output_that_cannot_be_written(finished_copy, arguments):
    with open("/dev/full", "w") as full:
        result = subprocess.run([JOSTLE, *arguments], cwd=finished_copy, stdout=full, stderr=subprocess.PIPE, text=True,
                                timeout=60)
    assert result.returncode == DISK
    lines = [line for line in result.stderr.splitlines() if line.startswith("jostle: ") and "going on" not in line]
    assert len(lines) == 1 and lines[0].startswith("jostle: standard output: cannot write"), result.stderr
    assert lines[0].endswith("; what was printed is not whole")


def test_fresh_in_the_current_folder(finished_copy, finished):
    """`.` would follow the folder that is moved aside, and the new run overwrite the old one."""
    folder = finished_copy / "run"
    write_scene(finished_copy, changed(RODS, seed=9))
    result = command(folder, "run", "../scene.toml", "--out", ".", "--fresh")
    assert result.returncode == DONE, result.stderr
    assert result.stdout.endswith(f"files in {folder}; to look at them: jostle report {folder}\n")
    require_same_results(finished_copy / "run.1", finished / "run")
    assert (folder / "series.csv").read_bytes() != (finished / "run/series.csv").read_bytes()
    assert command(finished_copy, "verify", "run").returncode == DONE
    write_scene(folder / "below", RODS)
    result = command(folder / "below", "run", "scene.toml", "--out", "..", "--fresh")
    assert result.returncode == DONE, result.stderr
    assert (finished_copy / "run.2/below/scene.toml").exists()
    assert (folder / "series.csv").read_bytes() == (finished / "run/series.csv").read_bytes()


def test_a_link_to_nothing(spheres):
    (spheres / "run").symlink_to("nowhere")
    for options in ([], ["--fresh"]):
        require_one_line(run(spheres, *options), "run: is a link to a folder that is not there")
    (spheres / "nowhere").mkdir()
    assert run(spheres).returncode == DONE
    assert (spheres / "nowhere/summary.json").exists()


def test_a_folder_that_is_moved_takes_its_run_along(tmp_path):
    """The run goes on in the folder that it has locked, and leaves alone what takes its old name."""
    write_scene(tmp_path, ENDLESS)
    first = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 8, first)
    (tmp_path / "run").rename(tmp_path / "moved")
    write_scene(tmp_path, changed(ENDLESS, seed=9))
    second = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 8, second)
    status, _, stderr = kill(first, signal.SIGTERM)
    assert status == STOPPED
    step = checkpoint_step(tmp_path / "moved")
    assert step > 40
    assert f"stopped at step {step} (signal 15); its folder was moved: to go on give --out {tmp_path}/moved\n" in stderr
    assert (tmp_path / "moved/trajectory.h5").exists() and not (tmp_path / "run/trajectory.h5").exists()
    assert checkpoint_step(tmp_path / "run") == 0
    assert kill(second)[0] == -signal.SIGKILL
    assert run(tmp_path, "--walltime", "0:00:01").returncode == STOPPED, "the second one was not disturbed"
    write_scene(tmp_path, ENDLESS)
    result = command(tmp_path, "run", "scene.toml", "--out", "moved", "--walltime", "0:00:01")
    assert result.returncode == STOPPED and f"going on from step {step}\n" in result.stderr
    for name in ("run", "moved"):
        assert command(tmp_path, "verify", name).returncode == DONE


def test_a_folder_that_is_removed(tmp_path):
    write_scene(tmp_path, changed(ENDLESS, output={"checkpoint_every": 50}))
    process = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 2, process)
    (tmp_path / "run").rename(tmp_path / "gone")
    shutil.rmtree(tmp_path / "gone")
    stdout, stderr = process.communicate(timeout=60)
    assert process.returncode == DISK and stdout == ""
    assert lines_but_notices(stderr) == ["jostle: run: cannot go on in this folder: it, or its file lock, was removed while the run went on"]
    assert not (tmp_path / "run").exists()


def test_an_overlap_in_the_last_state(tmp_path):
    """Steps are judged by the overlap with which they begin; that of the end is looked at, too."""
    write_scene(tmp_path / "all", changed(RODS, output={"series_every": 1}))
    overlap = column(finish(tmp_path / "all") / "series.csv", "max_overlap")
    last = max(k for k in range(5, len(overlap)) if overlap[k] > max(overlap[:k]))
    limit = 0.5 * (overlap[last] + max(overlap[:last]))
    write_scene(tmp_path, changed(with_steps(RODS, last), contact={"overlap_limit": limit}, output={"series_every": 1}))
    for _ in range(2):
        result = run(tmp_path)
        assert result.returncode == NUMERICS, (result.returncode, result.stdout)
        assert f"step {last} failed: rods overlap by {overlap[last]:.3g}" in result.stderr
        assert not (tmp_path / "run/summary.json").exists()
        assert command(tmp_path, "verify", "run").returncode == DONE
    write_scene(tmp_path / "one less", changed(with_steps(RODS, last - 1), contact={"overlap_limit": limit},
                                               output={"series_every": 1}))
    finish(tmp_path / "one less")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_step_is_interrupted(tmp_path, number):
    write_scene(tmp_path, UNSOLVABLE)
    process = start(tmp_path)
    wait_until((tmp_path / "run/run.json").exists, process)
    time.sleep(0.2)
    status, stdout, stderr = kill(process, number)
    assert (status, stdout) == (STOPPED, "")
    assert f"stopped at step 0 (signal {int(number)})" in stderr
    assert command(tmp_path, "verify", "run").returncode == DONE


def test_walltime_is_kept_within_a_step(tmp_path):
    """Within what a whole run of 100 steps takes here, which on a machine that is busy with others may be long."""
    write_scene(tmp_path / "whole", RODS)
    began = time.monotonic()
    finish(tmp_path / "whole")
    lasted = time.monotonic() - began
    write_scene(tmp_path, UNSOLVABLE)
    began = time.monotonic()
    result = run(tmp_path, "--walltime", "0:00:02")
    assert time.monotonic() - began < 2.0 + lasted
    assert result.returncode == STOPPED and "stopped at step 0 (walltime)" in result.stderr


def test_a_signal_before_the_program_has_begun(tmp_path):
    """It waits until it is known what to do about it."""
    write_scene(tmp_path, ENDLESS)
    process = start(tmp_path, preexec_fn=lambda: (signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGTERM]),
                                                  os.kill(os.getpid(), signal.SIGTERM)))
    assert process.communicate(timeout=60) == ("", "jostle: stopped before a step was made\n")
    assert process.returncode == STOPPED and not (tmp_path / "run").exists()


def test_a_terminal_that_is_closed(tmp_path):
    write_scene(tmp_path, ENDLESS)
    process = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 2, process)
    assert kill(process, signal.SIGHUP)[0] == STOPPED
    step = checkpoint_step(tmp_path / "run")
    assert step > 0
    process = start(tmp_path, preexec_fn=lambda: signal.signal(signal.SIGHUP, signal.SIG_IGN))  # as nohup does
    rows = rows_of(tmp_path / "run/series.csv")
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > rows, process)
    process.send_signal(signal.SIGHUP)
    rows = rows_of(tmp_path / "run/series.csv")
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > rows + 8, process)
    assert kill(process, signal.SIGTERM)[0] == STOPPED


def test_pipes_that_nobody_writes_to(tmp_path):
    os.mkfifo(tmp_path / "scene.toml")
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "scene.toml:1:1: scene: is empty")
    (tmp_path / "scene.toml").unlink()
    os.mkfifo(tmp_path / "rods.csv")
    write_scene(tmp_path, changed(RODS, rods={"count": None, "start": "file", "file": "rods.csv"},
                                  box={"volume_fraction": None, "edges": [12.0, 12.0, 12.0]}))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "rods.csv: the file holds no rods")


@pytest.mark.parametrize("name", ["checkpoint", "series.csv", "trajectory.journal", "trajectory.h5", "scene.toml",
                                  "resolved.toml", "series.json", "run.json", "summary.json"])
def test_a_pipe_or_a_device_in_the_folder(finished_copy, name):
    path = finished_copy / "run" / name
    path.unlink()
    os.mkfifo(path)
    result = command(finished_copy, "verify", "run")
    assert result.returncode == BAD_INPUT and f"jostle: run/{name}" in result.stderr, result.stderr
    path.unlink()
    path.symlink_to("/dev/zero")
    result = command(finished_copy, "verify", "run")
    assert result.returncode == BAD_INPUT and f"run/{name}" in result.stderr and "is a device" in result.stderr


def test_a_scene_from_a_pipe(tmp_path, finished):
    path = write_scene(tmp_path, RODS)
    result = subprocess.run(["bash", "-c", '"$0" run <(cat scene.toml) --out run --threads 1', JOSTLE], cwd=tmp_path,
                            capture_output=True, text=True, timeout=60)
    assert result.returncode == DONE, result.stderr
    require_same_results(tmp_path / "run", finished / "run", same_command=False)
    assert (tmp_path / "run/scene.toml").read_bytes() == path.read_bytes()
