"""`jostle report`: one page with plots, averages and the rods; what is missing is said, not an error. In a browser:
test_report_page.py."""

import html
import json
import os
import re
import shutil
import struct
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import trajectory_by_hand
from jostle_command import (DISK, DONE, JOSTLE, RODS, SPHERES, STOPPED, changed, command, finish, kill,
                            require_one_line, rows_of, snapshot, start, wait_until, with_steps, write_scene)
from test_full_disk import file_size_limit

PRESENTATION = Path(__file__).resolve().parents[2] / "presentation"
sys.path.insert(0, str(PRESENTATION))

import povray_scene  # noqa: E402  (the path comes first)
from trajectory import Trajectory  # noqa: E402

PLOTS = {"Z.png", "nematic_order.png", "max_overlap.png", "iterations.png"}  # number and volume fraction do not change
SMALL = ("--width", "120")


def report(folder, *options, path=None):
    """The page, and what was said on standard error; path: where programs are looked for."""
    environment = {**os.environ, "PATH": path} if path else None
    result = subprocess.run([shutil.which(JOSTLE), "report", "run", *(options or SMALL)], cwd=folder, env=environment,
                            capture_output=True, text=True, check=False, timeout=120)
    assert result.returncode == DONE, result.stderr
    assert result.stdout.endswith("report.html\n")
    assert not list((folder / "run").glob(".*"))
    return (folder / result.stdout.strip()).read_text(), result.stderr


def size_of(png):
    content = png.read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    return struct.unpack(">II", content[16:24])


def require_self_contained(page):
    assert re.findall(r'<[a-z]+ [^>]*(?:src|href)="(?!data:)', page) == []
    assert page.startswith("<!DOCTYPE html>") and page.endswith("</html>\n")


def numbers_after(page, words):
    """The cells of the row that begins with the words."""
    row = re.search(rf"<tr><td[^>]*>{re.escape(words)}</td>(.*)</tr>", page)[1]
    return re.findall(r"<td[^>]*>(.*?)</td>", row)


@pytest.fixture(scope="module")
def averaged(tmp_path_factory):
    """A run long enough for error bars."""
    folder = tmp_path_factory.mktemp("averaged")
    write_scene(folder, changed(with_steps(RODS, 20000), title="rods & <spheres>", output={"trajectory_every": 10000}))
    finish(folder)
    return folder


def test_a_done_run(averaged):
    before = snapshot(averaged / "run")
    page, errors = report(averaged)
    assert errors == ""
    require_self_contained(page)
    folder = averaged / "run/report"
    assert {path.name for path in folder.iterdir()} == PLOTS | {"view.png", "view.pov", "report.html"}
    assert page.count('<img alt=') == len(PLOTS) + 1
    assert size_of(folder / "view.png")[0] == 120
    assert html.escape("rods & <spheres>") in page and "rods & <spheres>" not in page
    summary = json.loads((averaged / "run/summary.json").read_text())
    mean, error, n_eff, _ = numbers_after(page, "compressibility factor Z")
    assert float(mean) == pytest.approx(summary["Z"]["mean"], abs=summary["Z"]["standard_error"])
    assert float(error) == pytest.approx(summary["Z"]["standard_error"], rel=0.05)
    assert float(n_eff) == pytest.approx(summary["Z"]["n_eff"], abs=0.5)
    assert numbers_after(page, "pressure")[-1] == "kT/D³"
    principal = summary["principal_stresses"]
    for shown, value, error in zip(numbers_after(page, "principal"), principal["mean"], principal["standard_error"], strict=True):
        assert float(shown.split(" ± ")[0]) == pytest.approx(value, abs=error)
    assert page.count(">principal<") == 2 and ">Orientation stress<" in page
    for words, check in (("stress", "total_stress_ratio"), ("collision stress", "collision_stress_ratio")):
        ratio, error, _, verdict = numbers_after(page, f"{words} along/across the director")
        measured = summary["checks"][check]["measured"]
        assert float(ratio) == pytest.approx(measured["mean"], abs=measured["standard_error"])
        assert float(error) == pytest.approx(measured["standard_error"], rel=0.05) and verdict == "agrees"
    assert "The run is not done" not in page
    after = snapshot(averaged / "run")
    assert {name: after[name] for name in before} == before


def test_a_run_too_short_to_tell(finished_copy):
    page, _ = report(finished_copy)
    assert re.search(r'<li class="bad">.*Too short to tell whether this is equilibrium.*covers 0\.\d+ of a rotation time; at least 4 are needed', page)
    assert numbers_after(page, "compressibility factor Z")[1] == "–"


def test_again_and_elsewhere(averaged):
    first = (averaged / "run/report").stat().st_ino if (averaged / "run/report").exists() else None
    report(averaged)  # takes the place of the first
    assert (averaged / "run/report").stat().st_ino != first
    before = snapshot(averaged / "run")
    (averaged / "talk").mkdir(exist_ok=True)  # empty: taken
    report(averaged, *SMALL, "--out", "talk")
    assert (averaged / "talk/view.png").exists() and snapshot(averaged / "run") == before


def frames_in(page):
    return len(json.loads(re.search(r'"times": (\[[^\]]*\])', page)[1]))


def test_without_a_trajectory(finished_copy):
    """The rods are those of the journal, else of the checkpoint; without both one line says so, and everything else is there."""
    whole, _ = report(finished_copy)
    (finished_copy / "run/trajectory.h5").unlink()
    page, errors = report(finished_copy)
    assert errors == "" and frames_in(page) == frames_in(whole) > 5
    (finished_copy / "run/trajectory.journal").unlink()
    page, errors = report(finished_copy)
    assert errors == "jostle: The run kept no trajectory: shown are the rods of its last checkpoint.\n"
    assert frames_in(page) == 1 and (finished_copy / "run/report/view.png").exists()
    checkpoint = (finished_copy / "run/checkpoint").read_bytes()
    (finished_copy / "run/checkpoint").write_bytes(checkpoint[:-20])
    _, errors = report(finished_copy)
    assert errors.startswith("jostle: run/checkpoint: the checkpoint is truncated") and errors.count("\n") == 2
    for path in (finished_copy / "run").glob("checkpoint*"):
        path.unlink()
    page, errors = report(finished_copy)
    assert errors.startswith("jostle: No view of the rods: ") and errors.count("\n") == 1
    assert "trajectory.h5" in errors and "No view of the rods" in page and 'id="rods-x"' not in page
    assert {path.name for path in (finished_copy / "run/report").iterdir()} == PLOTS | {"report.html"}


def test_without_povray(finished_copy):
    """The rods turn all the same."""
    page, errors = report(finished_copy, path="/nowhere")
    assert errors == "jostle: No still picture of the rods: povray is not installed (apt-get install povray)\n"
    assert "No still picture" in page and 'id="rods-x"' in page
    assert {path.name for path in (finished_copy / "run/report").iterdir()} == PLOTS | {"report.html"}


def test_without_dygraphs(finished_copy):
    """Plots stay pictures, and one line says what to install."""
    program = ("import sys, pathlib; sys.path.insert(0, sys.argv.pop(1)); import viewer_parts, report; "
               "viewer_parts.PLACES = (pathlib.Path('/nowhere'),); report.report()")
    result = subprocess.run([sys.executable, "-B", "-c", program, str(PRESENTATION), "--width=120", "run"], cwd=finished_copy,
                            capture_output=True, text=True, check=False, timeout=120)
    assert result.returncode == 0
    assert result.stderr.startswith("jostle: Plots do not zoom") and "apt-get install libjs-dygraphs" in result.stderr
    page = (finished_copy / "run/report/report.html").read_text()
    assert "apt-get install libjs-dygraphs" in page and page.count("<img alt=") == len(PLOTS) + 1


def test_a_povray_that_fails(finished_copy):
    programs = finished_copy / "programs"
    programs.mkdir()
    (programs / "povray").write_text("#!/bin/sh\necho 'no such scene' >&2\nexit 3\n")
    (programs / "povray").chmod(0o755)
    _, errors = report(finished_copy, path=f"{programs}:/bin")
    assert errors == "jostle: No still picture of the rods: povray failed with status 3: no such scene\n"


def test_a_report_that_is_stopped(finished_copy):
    """Exit 75, what it began is gone, and so is the povray that it started."""
    programs = finished_copy / "programs"
    programs.mkdir()
    (programs / "povray").write_text(f"#!/bin/sh\necho $$ > {programs}/number\nexec /bin/sleep 600\n")
    (programs / "povray").chmod(0o755)
    before = snapshot(finished_copy / "run")
    process = subprocess.Popen([shutil.which(JOSTLE), "report", "run"], cwd=finished_copy, stderr=subprocess.PIPE,
                               stdout=subprocess.PIPE, text=True, env={**os.environ, "PATH": f"{programs}:/bin"})
    number = programs / "number"
    wait_until(lambda: number.exists() and number.read_text().endswith("\n"), process)
    status, _, errors = kill(process, 15)
    assert status == STOPPED and errors.count("\n") == 1 and "stopped" in errors
    end = time.monotonic() + 20.0
    while Path(f"/proc/{number.read_text().strip()}").exists():
        assert time.monotonic() < end, "povray runs on"
        time.sleep(0.01)
    assert snapshot(finished_copy / "run") == before


def test_what_a_kill_left_is_removed_by_the_next(finished_copy):
    """But nothing that another command still works on, and nothing of the user's."""
    programs = finished_copy / "programs"
    programs.mkdir()
    (programs / "povray").write_text(f"#!/bin/sh\necho $$ > {programs}/number\nexec /bin/sleep 600\n")
    (programs / "povray").chmod(0o755)
    run, number = finished_copy / "run", programs / "number"
    (run / ".jostle-notes.tmp").write_text("mine")
    before = snapshot(run)

    def started():
        number.unlink(missing_ok=True)
        process = subprocess.Popen([shutil.which(JOSTLE), "report", "run"], cwd=finished_copy, stderr=subprocess.PIPE,
                                   stdout=subprocess.PIPE, text=True, env={**os.environ, "PATH": f"{programs}:/bin"})
        wait_until(lambda: number.exists() and number.read_text().endswith("\n"), process)
        return process

    def left():
        return {path.name for path in run.glob(".jostle-????????.tmp")}

    killed = started()
    kill(killed, 9)
    os.kill(int(number.read_text()), 9)
    after_kill = left()
    assert after_kill
    working = started()
    own = left()
    assert own and not own & after_kill
    export = command(finished_copy, "export", "run", "--to", "xyz")
    assert export.returncode == DONE and left() == own
    assert kill(working, 15)[0] == STOPPED
    (run / "trajectory.xyz").unlink()
    assert snapshot(run) == before


@pytest.mark.parametrize("home", ["home", "nowhere"])
def test_fonts_are_listed_in_no_shared_place(finished_copy, home):
    """What TMPDIR holds while the view is drawn."""
    for name in ("home", "tmp", "programs"):
        (finished_copy / name).mkdir()
    seen = finished_copy / "seen"
    (finished_copy / "programs/povray").write_text(f"#!/bin/sh\nls -A $TMPDIR > {seen}\nexit 3\n")
    (finished_copy / "programs/povray").chmod(0o755)
    environment = {"PATH": f"{finished_copy}/programs:/bin", "TMPDIR": str(finished_copy / "tmp"),
                   "HOME": str(finished_copy / home)}
    result = subprocess.run([shutil.which(JOSTLE), "report", "run"], cwd=finished_copy, capture_output=True, text=True,
                            env=environment, check=False, timeout=120)
    assert result.returncode == DONE and result.stderr.count("\n") == 1, result.stderr
    assert seen.read_text() == "" and list((finished_copy / "tmp").iterdir()) == []
    assert not list((finished_copy / "run").glob(".*"))


def test_a_run_that_was_stopped(tmp_path):
    """No averages yet, and the page says so."""
    write_scene(tmp_path, with_steps(RODS, 10**6))
    process = start(tmp_path)
    wait_until(lambda: rows_of(tmp_path / "run/series.csv") > 700, process)
    assert kill(process, 15)[0] == STOPPED
    page, _ = report(tmp_path)
    require_self_contained(page)
    assert "The run is not done" in page and "Averages</h2>" not in page


def test_swimmers_without_noise(spheres):
    """kT = 0: the collision pressure takes the place of Z; heads are marked."""
    write_scene(spheres, changed(SPHERES, fluid={"kT": 0.0}, motion={"brownian": False, "self_propulsion": 1.0}))
    finish(spheres)
    page, errors = report(spheres)
    assert errors == ""
    folder = spheres / "run/report"
    assert (folder / "pressure_collision.png").exists() and not (folder / "Z.png").exists()
    assert "ompressibility factor" not in page
    scene = (folder / "view.pov").read_text()
    heads = scene.count(povray_scene.vector(povray_scene.HEAD))
    assert heads == SPHERES["rods"]["count"] and scene.count("\nBall(") == 2 * heads


def test_the_camera_sees_every_rod_and_no_mirror_image(tmp_path):
    run = trajectory_by_hand.write(tmp_path / "run", [trajectory_by_hand.rods(40, seed=3)])
    frame = Trajectory(run).frame(0)
    for edges in ((10, 8, 6), (6, 8, 10), (10, 2, 10), (7, 7, 7), (3, 30, 3)):
        frame.edges = np.array(edges, float)
        camera = povray_scene.Camera(frame)
        assert np.allclose(np.cross(camera.right, camera.up), -camera.direction)  # right-handed, towards the viewer
        seen = frame.ends().reshape(-1, 3) - camera.location
        depth = seen @ camera.direction
        half_width = np.tan(povray_scene.FIELD_OF_VIEW / 2)
        assert np.all(depth > 0)
        assert np.all(np.abs(seen @ camera.right) + 0.5 < depth * half_width)
        assert np.all(np.abs(seen @ camera.up) + 0.5 < depth * half_width / camera.aspect)


def test_what_is_refused(finished_copy):
    (finished_copy / "notes").mkdir()
    (finished_copy / "notes/mine.txt").write_text("keep")
    before = snapshot(finished_copy)

    def refused(*arguments):
        return command(finished_copy, "report", *arguments)

    require_one_line(refused("absent"), "absent", "there is no such folder")
    require_one_line(refused("notes"), "not the folder of a run")
    require_one_line(refused("run", "--width", "wide"), "wide", "100 to 8000")
    require_one_line(refused("run", "--width", "99"), "100 to 8000")
    require_one_line(refused("run", "--megabytes", "much"), "much", "0.1 to 1000")
    for taken in ("notes", "run"):
        require_one_line(refused("run", "--out", taken), "is not replaced")
    require_one_line(refused("run", "--out", "nowhere/report"), "nowhere", "there is no such folder")
    assert snapshot(finished_copy) == before
    # What depends on the frames is refused when they have been read; of what was begun nothing is left.
    require_one_line(refused("run", "--frame", "99"), "99", "0 to 8")
    require_one_line(refused("run", "--view", "w"), "w", "x, y, z")
    require_one_line(refused("run", "--colour", "age"), "age", "direction, angle, speed, id, plain")
    assert snapshot(finished_copy).keys() == before.keys()


def test_a_report_with_something_of_the_users_in_it_is_kept(averaged):
    report(averaged)
    notes = averaged / "run/report/notes.txt"
    notes.write_text("keep")
    require_one_line(command(averaged, "report", "run"), "is not replaced")
    assert notes.read_text() == "keep"
    notes.unlink()


def test_damaged_series_and_full_disk(finished_copy):
    before = snapshot(finished_copy / "run")
    full = command(finished_copy, "report", "run", *SMALL, preexec_fn=file_size_limit(3000))
    assert full.returncode == DISK and "File too large" in full.stderr
    assert snapshot(finished_copy / "run") == before
    series = finished_copy / "run/series.csv"
    series.write_text(series.read_text().replace(",", ";", 40))
    require_one_line(command(finished_copy, "report", "run"), "series.csv", "cannot be used")


def test_what_a_set_up_adds(tmp_path):
    """Moduli of a flow to and fro, the pressure on walls in the place of that of a bulk, the volume in a bath."""
    flow = changed(with_steps(RODS, 300), flow={"strain_amplitude": 0.2, "frequency": 0.5}, rods={"length": 1.0})
    slit = changed(RODS, box={"volume_fraction": None, "edges": [8.0, 8.0, 8.0], "periodic": [True, True, False]}, walls={"faces": [False, False, True]})
    for name, scene, told, absent in (("flow", flow, ("storage modulus G′", "loss modulus G″"), None),
                                      ("slit", slit, ("wall pressure z",), "pressure"),
                                      ("bath", changed(RODS, pressure={"external": 0.8}), ("mean volume fraction", "Z = P V/(N kT)"), None)):
        write_scene(tmp_path / name, scene)
        finish(tmp_path / name)
        page, _ = report(tmp_path / name)
        for words in told:
            assert f"<td>{words}" in page, (name, words)
        assert absent is None or f"<td>{absent}</td>" not in page
