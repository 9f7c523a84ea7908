"""Runs of several ranks, started by mpirun: every file has the bytes of a run of one process, for any number of ranks and
threads, also when a run stops, is killed, and goes on with another number."""

import json
import os
import resource
import shutil
import signal
import subprocess

import pytest

from jostle_command import (BAD_INPUT, DISK, DONE, JOSTLE, STOPPED, changed, checkpoint_step, finish, kill, run, rows_of,
                            start, wait_until, with_steps, write_scene)
from ranks_command import (CROWD, MPIRUN, SCENES, launcher, lines_of_jostle, on_ranks, pid_of_rank, require_same_files,
                           start_on_ranks, words)

needs_mpi = pytest.mark.skipif(not MPIRUN, reason="MPI was not found when this was configured")


@needs_mpi
@pytest.mark.parametrize("name", SCENES)
def test_files_are_those_of_a_run_alone(tmp_path, name):
    """The first scene on several numbers of ranks, threads and colours between two exchanges, the others on one of them; with
    JOSTLE_ALL_RANKS=1 in the environment all scenes on all numbers, which takes half an hour. Where there are several
    colours, every rank writes its part of frames and checkpoints, else the first rank all of them."""
    write_scene(tmp_path / "alone", SCENES[name])
    reference = finish(tmp_path / "alone")
    some = [(1, 1, 1), (2, 1, 2), (2, 2, 64), (3, 2, 1), (4, 1, 3)]
    place = list(SCENES).index(name)
    numbers = some if name == "dense" else [some[1 + place % 4]]
    if os.environ.get("JOSTLE_ALL_RANKS"):
        numbers = [(ranks, threads, colours) for ranks in (1, 2, 3, 4, 8) for threads in (1, 2) for colours in (1, 3, 64)]
    for ranks, threads, colours in numbers:
        folder = tmp_path / f"{ranks}_{threads}_{colours}"
        write_scene(folder, SCENES[name])
        result = on_ranks(folder, ranks, "--colours-per-exchange", str(colours), "--ranks-write-above",
                          "0" if colours > 1 else "1e8", threads=threads)
        assert result.returncode == DONE, result.stderr
        require_same_files(folder / "run", reference)
        session = json.loads((folder / "run/run.json").read_text())["sessions"][-1]
        assert (session["ranks"], session["threads"]) == (ranks, threads)
        assert ("hosts" in session) == (ranks > 1)
        assert session.get("colours_per_exchange") == (colours if ranks > 1 else None)
        assert result.stdout.count("files in run") == 1


@needs_mpi
@pytest.mark.parametrize("name", ["dense", "swimmers", "warm", "dying"])
def test_stopped_and_going_on_with_other_numbers_of_ranks(tmp_path, name):
    """4 ranks, 3, none and 5, stopped by SIGUSR1 to mpirun, which ranks live on with, and to the process."""
    scene = with_steps(SCENES[name], 400)
    scene = changed(scene, output={"checkpoint_every": 10**6})
    write_scene(tmp_path / "alone", scene)
    reference = finish(tmp_path / "alone")
    folder = tmp_path / "stopped"
    write_scene(folder, scene)
    steps = []
    for ranks, rows in [(4, 4), (3, 14), (0, 22), (5, 30)]:
        process = start_on_ranks(folder, ranks)
        wait_until(lambda rows=rows: rows_of(folder / "run/series.csv") > rows, process, 60.0)
        status, _, stderr = kill(process, signal.SIGUSR1)
        assert status == STOPPED, stderr
        assert sum("stopped at step" in line for line in lines_of_jostle(stderr)) == 1
        assert json.loads((folder / "run/run.json").read_text())["exit_reason"] == f"signal {signal.SIGUSR1.value}"
        steps.append(checkpoint_step(folder / "run"))
    assert steps == sorted(set(steps)) and steps[-1] < 400
    assert on_ranks(folder, 2).returncode == DONE
    require_same_files(folder / "run", reference)


def under_way_on_three_ranks(tmp_path, scene, above):
    """(folder of a run that has some rows, what one process leaves of the same scene, the run's process)."""
    write_scene(tmp_path / "alone", scene)
    reference = finish(tmp_path / "alone")
    folder = tmp_path / "three"
    write_scene(folder, scene)
    process = start_on_ranks(folder, 3, "--ranks-write-above", above)
    wait_until(lambda: rows_of(folder / "run/series.csv") > 8, process)
    return folder, reference, process


@needs_mpi
@pytest.mark.parametrize("rank, above", [(0, "1e8"), (2, "0")])
def test_a_rank_that_is_killed(tmp_path, rank, above):
    """kill -9: the launcher ends the others, and the run goes on from its last checkpoint."""
    scene = changed(with_steps(CROWD, 300), output={"checkpoint_every": 25})
    folder, reference, process = under_way_on_three_ranks(tmp_path, scene, above)
    os.kill(pid_of_rank(process, rank), signal.SIGKILL)
    process.communicate(timeout=60)
    assert process.returncode not in (DONE, STOPPED)
    assert 0 <= checkpoint_step(folder / "run") < 300
    assert on_ranks(folder, 2).returncode == DONE
    require_same_files(folder / "run", reference)


@needs_mpi
def test_the_wall_time_of_the_first_rank_stops_all(tmp_path):
    scene = changed(with_steps(CROWD, 10**6), rods={"start": "aligned"})
    write_scene(tmp_path, scene)
    result = on_ranks(tmp_path, 2, "--walltime", "3s")
    assert result.returncode == STOPPED, result.stderr
    assert json.loads((tmp_path / "run/run.json").read_text())["exit_reason"] == "walltime"
    assert checkpoint_step(tmp_path / "run") > 0


@needs_mpi
@pytest.mark.parametrize("rods, words, line", [
    ({"count": 3000, "start": "random"}, ["--walltime", "2s"], "--walltime: was over before the start was made"),
    ({"count": 12, "start": "aligned"}, [], "could not be placed without overlap")])
def test_a_start_that_does_not_come_about(tmp_path, rods, words, line):
    """All ranks make it, and leave it together: one line of the first, and nothing on the disk."""
    write_scene(tmp_path, changed(CROWD, rods=rods, box={"volume_fraction": 0.3 if words else 0.68}))
    result = on_ranks(tmp_path, 3, *words)
    assert result.returncode == BAD_INPUT, result.stderr
    said = [said for said in lines_of_jostle(result.stderr) if "annealing the start" not in said]
    assert len(said) == 1 and line in said[0], result.stderr
    assert not (tmp_path / "run").exists()


@needs_mpi
@pytest.mark.parametrize("changes, key", [
    ({"growth": {"rate": 0.1, "division_length": 7.0}, "motion": {"self_propulsion": 1.0}}, "growth.rate"),
    ({"solver": {"method": "apgd"}}, "solver.method"), ({"box": {"volume_fraction": 5.0}}, "box.volume_fraction")])
def test_what_is_refused_leaves_no_trace(tmp_path, changes, key):
    """What ranks cannot do, and what nobody can: one line of the first rank, and nothing on the disk."""
    write_scene(tmp_path, changed(CROWD, **changes))
    result = on_ranks(tmp_path, 2)
    assert result.returncode == BAD_INPUT, result.stderr
    lines = lines_of_jostle(result.stderr)
    assert len(lines) == 1 and key in lines[0], result.stderr
    assert not (tmp_path / "run").exists()


@needs_mpi
@pytest.mark.parametrize("above", ["1e8", "0"])
def test_a_full_disk_ends_all(tmp_path, above):
    """A limit of what a file may have stands for it. Nothing that was sound is lost, and the run goes on where there is room."""
    scene = changed(with_steps(CROWD, 300), output={"trajectory_every": 2, "checkpoint_every": 25})
    folder, reference, process = under_way_on_three_ranks(tmp_path, scene, above)
    limit = (folder / "run/trajectory.journal").stat().st_size + 9000  # a frame has 8400 bytes
    for rank in range(3):
        resource.prlimit(pid_of_rank(process, rank), resource.RLIMIT_FSIZE, (limit, limit))
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == DISK, stderr
    lines = lines_of_jostle(stderr)
    assert 1 <= len(lines) <= 3 and all("trajectory.journal: cannot write" in line for line in lines), stderr
    assert 0 <= checkpoint_step(folder / "run") < 300
    assert on_ranks(folder, 2, "--ranks-write-above", above).returncode == DONE
    require_same_files(folder / "run", reference)


@needs_mpi
def test_an_error_of_the_first_rank_ends_all(tmp_path):
    """Its folder is taken away while it runs."""
    write_scene(tmp_path, with_steps(CROWD, 10**6))
    process = start_on_ranks(tmp_path, 2)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 2, process)
    shutil.rmtree(tmp_path / "run")
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == DISK, stderr
    assert len(lines_of_jostle(stderr)) == 1 and "rank" not in lines_of_jostle(stderr)[0]


@needs_mpi
def test_an_error_of_another_rank_ends_all(tmp_path):
    """Its number of threads is none. The run goes on without that."""
    write_scene(tmp_path, CROWD)
    one = [JOSTLE, "run", "scene.toml", "--out", "run"]
    result = subprocess.run(launcher(2) + one + [":", "-n", "1", "-x", "OMP_NUM_THREADS=0", *one], cwd=tmp_path,
                            capture_output=True, text=True, timeout=120)
    assert result.returncode == BAD_INPUT, result.stderr
    assert [line for line in lines_of_jostle(result.stderr) if "OMP_NUM_THREADS" in line][0].startswith("jostle: rank 2 of 3: ")
    assert not (tmp_path / "run").exists()  # no start is made without that rank
    assert on_ranks(tmp_path, 2).returncode == DONE


@needs_mpi
def test_other_words_are_other_runs(tmp_path):
    """Processes that a launcher started for runs of their own are told from ranks by their words."""
    write_scene(tmp_path, CROWD)
    result = subprocess.run(words(1) + [":", "-n", "1", *words(0, "--quiet")], cwd=tmp_path, capture_output=True, text=True,
                            timeout=120)
    assert result.returncode == BAD_INPUT
    assert len(lines_of_jostle(result.stderr)) == 1 and "--alone" in lines_of_jostle(result.stderr)[0]
    for name in "ab":
        write_scene(tmp_path / name, CROWD)
    separate = [JOSTLE, "run", "scene.toml", "--quiet", "--alone"]
    result = subprocess.run(launcher(1) + ["--wdir", str(tmp_path / "a"), *separate, ":", "-n", "1", "--wdir",
                                           str(tmp_path / "b"), *separate], capture_output=True, text=True, timeout=120)
    assert result.returncode == DONE, result.stderr
    assert (tmp_path / "a/scene.run/series.csv").read_bytes() == (tmp_path / "b/scene.run/series.csv").read_bytes()


@pytest.mark.skipif(bool(MPIRUN), reason="MPI was found when this was configured")
@pytest.mark.parametrize("rank", [0, 1])
def test_a_build_without_mpi_refuses_a_launcher(tmp_path, rank):
    """Of several processes the first says it."""
    write_scene(tmp_path, CROWD)
    environment = {**os.environ, "OMPI_COMM_WORLD_SIZE": "2", "OMPI_COMM_WORLD_RANK": str(rank)}
    result = run(tmp_path, env=environment)
    assert result.returncode == BAD_INPUT
    assert ("built without MPI" in result.stderr) == (rank == 0) and result.stderr.count("\n") == (rank == 0)
    assert not (tmp_path / "run").exists()


def test_usr1_stops_a_run_alone(tmp_path):
    """Batch programs send it some time before the end; more than one is as good as one."""
    write_scene(tmp_path, changed(with_steps(CROWD, 10**6), output={"checkpoint_every": 10**6}))
    process = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 2, process)
    process.send_signal(signal.SIGUSR1)
    assert kill(process, signal.SIGUSR1)[0] == STOPPED
    assert checkpoint_step(tmp_path / "run") > 0
