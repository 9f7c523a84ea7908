"""Where results go, and what `jostle run` says while it makes them."""

import json
import os
import pty
import re
import shutil
import signal
import subprocess

from jostle_command import (DONE, JOSTLE, RODS, SPHERES, STOPPED, changed, command, finish, kill,
                            lines_but_notices, require_one_line, require_same_results, rows_of, run, snapshot, start, wait_until,
                            with_steps, write_scene)

ENDLESS = changed(with_steps(RODS, 10**6), output={"checkpoint_every": 10**7})
PROGRESS = re.compile(r"^step \d+  t \S+  phi \S+  Z \S+  overlap \S+ D  iterations \d+  contacts \d+  \d+ steps/s  "
                      r"(?P<left>(more than )?\S+) left(  \S.*)?$")


def test_fresh_moves_the_old_run_aside(finished_copy, finished):
    for number in (1, 2):
        result = run(finished_copy, "--fresh")
        assert result.returncode == DONE
        assert "jostle: the run that was in run is now in " in result.stderr and f"run.{number}\n" in result.stderr
        require_same_results(finished_copy / f"run.{number}", finished / "run", same_command=number == 1)
        require_same_results(finished_copy / "run", finished / "run", same_command=False)
    assert sorted(entry.name for entry in finished_copy.iterdir()) == ["run", "run.1", "run.2", "scene.toml"]
    old = snapshot(finished / "run")
    moved = snapshot(finished_copy / "run.1")
    assert {name: entry[0] for name, entry in moved.items()} == {name: entry[0] for name, entry in old.items()}


def test_fresh_takes_the_scene_from_the_folder_that_it_moves(finished_copy, finished):
    result = command(finished_copy, "run", "run/scene.toml", "--out", "run", "--fresh")
    assert result.returncode == DONE, result.stderr
    for name in ("run", "run.1"):
        require_same_results(finished_copy / name, finished / "run", same_command=name == "run.1")


def test_fresh_takes_a_changed_scene(finished_copy, finished):
    write_scene(finished_copy, changed(RODS, seed=9))
    finish(finished_copy, "--fresh")
    assert (finished_copy / "run/series.csv").read_bytes() != (finished / "run/series.csv").read_bytes()
    assert (finished_copy / "run.1/series.csv").read_bytes() == (finished / "run/series.csv").read_bytes()


def test_fresh_without_an_old_run(spheres):
    result = run(spheres, "--fresh")
    assert result.returncode == DONE and "is now in" not in result.stderr
    assert not (spheres / "run.1").exists()


def test_finished_run_again(finished_copy, finished):
    for _ in range(2):
        result = run(finished_copy)
        assert result.returncode == DONE
        assert result.stdout.endswith("files in run; to look at them: jostle report run\n")
        require_same_results(finished_copy / "run", finished / "run")
    sessions = json.loads((finished_copy / "run/run.json").read_text())["sessions"]
    assert [session["last_step"] for session in sessions] == [100, 100, 100]


def test_two_runs_in_one_folder(tmp_path):
    write_scene(tmp_path, ENDLESS)
    first = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 2, first)
    for options in ([], ["--fresh"]):
        require_one_line(run(tmp_path, *options), "jostle: --out = ", f"run: another jostle (process {first.pid}) runs "
                         "in this folder", "Wait for it, stop it, or give another folder")
    assert first.poll() is None, "the first was disturbed"
    rows = rows_of(tmp_path / "run/series.csv")
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > rows, first)
    assert kill(first, signal.SIGTERM)[0] == STOPPED
    assert not (tmp_path / "run.1").exists()
    assert command(tmp_path, "verify", "run").returncode == DONE
    result = run(tmp_path, "--walltime", "0:00:01")
    assert result.returncode == STOPPED, "the folder is free again"


def test_folder_that_is_no_run(spheres):
    (spheres / "run").mkdir()
    (spheres / "run/thesis.tex").write_text("years of work\n")
    before = snapshot(spheres)
    for options in ([], ["--fresh"]):
        require_one_line(run(spheres, *options), "--out = ", "run: the folder is not empty, and no run of jostle made "
                         "it", "Give a new or an empty folder")
    require_one_line(command(spheres, "verify", "run"), "run: this is not the folder of a run")
    assert snapshot(spheres) == before
    assert not (spheres / "run/lock").exists()


def test_file_in_place_of_the_folder(spheres):
    (spheres / "run").write_text("a file\n")
    for options in ([], ["--fresh"]):
        require_one_line(run(spheres, *options), "run: is a file, a run needs a folder")
    assert (spheres / "run").read_text() == "a file\n"


def test_default_folder(spheres):
    (spheres / "sub").mkdir()
    shutil.move(spheres / "scene.toml", spheres / "sub/dense.toml")
    result = command(spheres, "run", "sub/dense.toml", "--threads", "1")
    assert result.returncode == DONE
    assert (spheres / "dense.run/summary.json").exists()
    assert result.stdout.endswith("files in dense.run; to look at them: jostle report dense.run\n")


def test_empty_folder_and_new_folders_above(spheres):
    (spheres / "empty").mkdir()
    for out in ("empty", "a/b/c", "slash/"):
        assert command(spheres, "run", "scene.toml", "--out", out, "--quiet", "--threads", "1").returncode == DONE
        assert (spheres / out / "summary.json").exists()


def test_json(spheres):
    result = run(spheres, "--json")
    assert result.returncode == DONE and result.stderr == ""
    assert json.loads(result.stdout) == json.loads((spheres / "run/summary.json").read_text())
    again = run(spheres, "--json")
    assert again.returncode == DONE and again.stdout == result.stdout and again.stderr == ""
    fresh = run(spheres, "--json", "--fresh")
    assert fresh.stdout == result.stdout


def test_quiet(spheres):
    for options in (["--quiet"], ["--quiet"], ["--quiet", "--fresh"]):
        result = run(spheres, *options)
        assert (result.returncode, result.stdout, result.stderr) == (DONE, "", "")
    write_scene(spheres / "stopped", changed(SPHERES, rods={"start": "lattice"}))  # begins at once
    result = run(spheres / "stopped", "--quiet", "--walltime", "0:00:01")
    assert (result.returncode, result.stdout, result.stderr) == (STOPPED, "", "")
    write_scene(spheres, changed(SPHERES, seed=-1))
    assert run(spheres, "--quiet").stderr != "", "errors are told all the same"


def test_plain_text_without_a_terminal(spheres):
    result = run(spheres)
    assert result.returncode == DONE
    for text in (result.stdout, result.stderr):
        assert "\r" not in text and "\x1b" not in text and text.isascii()
    assert PROGRESS.match(result.stderr.splitlines()[-1]), result.stderr
    assert len(lines_but_notices(result.stderr)) == 1
    for name in ("Z", "pressure", "collision pressure", "nematic order S", "stress anisotropy", "  of collisions", "equilibration time",
                 "largest overlap"):
        assert re.search(rf"^{name} += ", result.stdout, re.MULTILINE), result.stdout


def live_lines(folder, scene):
    """What a run that is stopped after its third live line writes to a terminal, cut at the beginnings of live lines."""
    write_scene(folder, scene)
    ours, theirs = pty.openpty()
    process = subprocess.Popen([JOSTLE, "run", "scene.toml", "--out", "run", "--threads", "1"], cwd=folder,
                               stdout=subprocess.DEVNULL, stderr=theirs)
    os.close(theirs)
    text, told = b"", False
    try:
        while block := os.read(ours, 4096):
            text += block
            if text.count(b"\r\x1b[K") > 2 and not told:
                process.terminate()  # once: the second signal is not waited for
                told = True
    except OSError:  # the other end was closed
        pass
    os.close(ours)
    assert process.wait(timeout=30) == STOPPED
    return text.decode().split("\r\x1b[K")


def test_one_live_line_on_a_terminal(tmp_path):
    """On a terminal the line is written over; once it is left, nothing is glued to its end."""
    live = live_lines(tmp_path, ENDLESS)
    assert len(live) > 3
    for line in live[1:-1]:
        assert PROGRESS.match(line), repr(line)
    assert "\njostle: stopped at step" in live[-1].replace("\r\n", "\n")


def test_a_run_whose_cells_grow_says_that_more_time_is_left_than_steps_of_now_would_take(tmp_path):
    for line in live_lines(tmp_path, changed(ENDLESS, growth={"rate": 1e-4, "division_length": 6.0}))[1:-1]:
        assert PROGRESS.match(line)["left"].startswith("more than "), repr(line)


def test_names_that_are_not_utf_8(tmp_path):
    """run.json holds the command line, with a sign in place of what is no text."""
    write_scene(tmp_path, SPHERES)
    name = os.fsdecode(b"sc\xe9ne.toml")
    (tmp_path / "scene.toml").rename(tmp_path / name)
    result = subprocess.run([JOSTLE, "run", name, "--out", "run", "--quiet"], cwd=tmp_path, capture_output=True, timeout=60)
    assert result.returncode == DONE and result.stderr == b""
    assert "sc\ufffdne.toml" in (tmp_path / "run/run.json").read_text(encoding="utf-8")
    assert b"sound" in subprocess.run([JOSTLE, "verify", "run"], cwd=tmp_path, capture_output=True, timeout=60).stdout
