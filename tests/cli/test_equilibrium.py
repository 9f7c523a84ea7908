"""What a run says of equilibrium, before and after: states that are not, though nothing in their series shows it, and the scenes of this project, which last."""

import json
import math
import re
from pathlib import Path

import pytest

from fenced_blocks import fenced_blocks
from jostle_command import DONE, RODS, changed, command, finish, run, write_scene


ROOT = Path(__file__).resolve().parents[2]


def summary_of(folder):
    return json.loads((folder / "run/summary.json").read_text())


def require_no_error_bar(folder, reason):
    """No error bar in the summary, which says why."""
    summary = summary_of(folder)
    assert summary["equilibrated"] is False
    assert re.match(reason, summary["equilibrium"]["in_words"])
    for name in ("pressure", "pressure_collision", "nematic_order", "anisotropy"):
        assert summary[name]["standard_error"] is None and re.search(reason, summary[name]["no_standard_error_because"])
    return summary


def test_too_short_to_tell(tmp_path):
    """Said before the run, at the end of the live line, in the summary and on the terminal; and there is no error bar,
    however many independent rows there seem to be. A fifteenth of a rotation time of rods of L/D = 3 at volume fraction 0.5 gave
    21.9 +- 0.2 where 19.05(4) is right."""
    short = changed(RODS, rods={"length": 3.0}, box={"volume_fraction": 0.5},
                    time={"step": 0.009, "production": 2.0, "equilibration": None})
    write_scene(tmp_path, short)
    told = r"too short to tell: covers 0\.0[5-9]\d? of a rotation time"
    assert re.search(rf"^production +{told}, 0\.\d+ of a diffusion time, 0\.\d+ of a passing time; at least 4 ", command(tmp_path, "check", "scene.toml").stdout,
                     re.MULTILINE)
    result = run(tmp_path)
    assert result.returncode == DONE
    assert re.search(told, result.stderr.splitlines()[-1])
    assert re.search(f"^equilibrium +=.WARNING: {told}", result.stdout, re.MULTILINE)
    assert "(n_eff" not in result.stdout
    summary = summary_of(tmp_path)
    assert summary["equilibrated"] is False
    assert summary["equilibrium"]["verdict"] == "too short to tell" and re.match(told, summary["equilibrium"]["in_words"])
    assert 0.05 < summary["equilibrium"]["rotation_times"] < 0.1
    for name in ("Z", "pressure", "pressure_collision", "nematic_order", "anisotropy"):
        assert summary[name]["standard_error"] is None and re.search(told, summary[name]["no_standard_error_because"])
    assert summary["Z"]["n_eff"] >= 10 and summary["stress_collision"]["standard_error"] == 3 * [3 * [None]]
    assert summary["time"] < 6.0, "ten times as long would be too short, too: the run ends where production does"


def test_a_fixed_equilibration_is_tested_all_the_same(tmp_path):
    """Rods that began aligned and are becoming isotropic, over some rotation times: the order drifts."""
    scene = changed(RODS, rods={"start": "aligned"}, time={"equilibration": 1.0, "production": 80.0})
    write_scene(tmp_path, scene)
    finish(tmp_path)
    summary = summary_of(tmp_path)
    assert summary["equilibrated"] is False
    assert summary["equilibrium"]["verdict"] in ("not reached", "too short to tell")
    assert summary["Z"]["standard_error"] is None


# Rods by default in a box by volume fraction, whose mean was 4 to 16 % off, with an error bar, where production was as short as this.
STATES = {"L/D 10": (10.0, 0.25, 1000, 40.0, 0.11), "L/D 20": (20.0, 0.10, 1000, 40.0, 0.021), "L/D 3": (3.0, 0.5, 1000, 2.0, 0.07),
          "L/D 5": (5.0, 0.35, 400, 24.0, 0.31)}


@pytest.mark.parametrize("length, phi, count, production, covered", STATES.values(), ids=STATES)
def test_four_states_are_told_to_be_too_short_before_they_run(tmp_path, length, phi, count, production, covered):
    """Of a rotation time 1/(2 D_R) of capsules; and the production that is proposed covers four, slow as the crowd is."""
    write_scene(tmp_path, {"box": {"volume_fraction": phi}, "rods": {"count": count, "length": length}, "time": {"production": production}})
    told = command(tmp_path, "check", "scene.toml").stdout
    assert f"too short to tell: covers {covered:g} of a rotation time" in told
    alone = float(re.search(r"^rotation time, alone +(\S+)", told, re.MULTILINE)[1])
    assert production / alone == pytest.approx(covered, rel=0.05)
    assert float(re.search(r"^production for error bars +about (\S+)", told, re.MULTILINE)[1]) > 8 * alone


SPHERES_IN_A_SLIT = {"box": {"edges": [8.0, 8.0, 60.0], "periodic": [True, True, False]}, "walls": {"faces": [False, False, True]},
                     "rods": {"count": 300, "length": 0.0}, "time": {"equilibration": 1.0, "production": 24.0}}


def test_rods_that_sink(tmp_path):
    """They take 4000 to sink from the upper wall to the lower one; in 24 nothing drifts that noise would not hide."""
    write_scene(tmp_path, changed(SPHERES_IN_A_SLIT, forces={"on_rods": [0.0, 0.0, -0.15]}))
    assert "at least 2 spreading times are needed" in command(tmp_path, "check", "scene.toml").stdout
    finish(tmp_path)
    assert require_no_error_bar(tmp_path, "too short to tell: covers 0.0[01]")["equilibrium"]["spreading_times"] < 0.02


def test_rods_at_one_end_of_a_slit(tmp_path):
    """They take thousands to spread."""
    places = [(1.1 * i + 0.6, 1.1 * j + 0.6, 1.1 * k + 0.6) for i in range(7) for j in range(7) for k in range(6)]
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n" + "".join(f"{x},{y},{z},1,0,0\n" for x, y, z in places))
    write_scene(tmp_path, changed(SPHERES_IN_A_SLIT, rods={"count": len(places), "start": "file", "file": "rods.csv"}))
    finish(tmp_path)
    require_no_error_bar(tmp_path, "too short to tell: covers 0.0[01]")


def test_a_box_that_has_not_found_its_volume(tmp_path):
    """At an eighth of the pressure of its bath, which it follows in 9000."""
    write_scene(tmp_path, {"box": {"volume_fraction": 0.1}, "rods": {"count": 200, "length": 0.0}, "time": {"equilibration": 1.0, "production": 40.0},
                           "pressure": {"external": 2.277, "relaxation_time": 20000.0}})
    finish(tmp_path)
    assert require_no_error_bar(tmp_path, "too short to tell: covers 0.0")["equilibrium"]["volume_relaxation_times"] < 0.1


def write_pairs_on_springs(folder, stiffness, **times):
    """48 pairs of spheres on soft springs, 1.3 D apart at the start."""
    pairs = [(2.6 * i + 1.3, 2.6 * j + 1.3, 2.8 * k + 1.4) for i in range(4) for j in range(4) for k in range(3)]
    lines = [f"{x + half},{y},{z},1,0,0\n" for x, y, z in pairs for half in (-0.65, 0.65)]
    (folder / "rods.csv").write_text("x,y,z,nx,ny,nz\n" + "".join(lines))
    springs = [f"{2 * pair},{2 * pair + 1},0,0,0,{stiffness}\n" for pair in range(len(pairs))]
    (folder / "springs.csv").write_text("rod_1,rod_2,s_1,s_2,rest_length,stiffness\n" + "".join(springs))
    write_scene(folder, {"box": {"edges": [10.4, 10.4, 8.4]}, "rods": {"start": "file", "file": "rods.csv", "length": 0.0},
                         "springs": {"file": "springs.csv"}, "time": {"rms_step": 0.08, **times}})


def test_soft_springs_that_have_not_stretched(tmp_path):
    """They stretch to 55 D, in 1/(k (mu_1 + mu_2)) = 4700; in 24 the pressure was 0.132(1), and 0.082 is right."""
    write_pairs_on_springs(tmp_path, 0.001, equilibration=100.0, production=60.0)
    told = command(tmp_path, "check", "scene.toml").stdout
    alone = 3 * math.pi / (2 * 0.001)
    assert float(re.search(r"^springs relax in +(\S+)", told, re.MULTILINE)[1]) == pytest.approx(alone, rel=1e-3)
    assert re.search(r"^production +too short to tell: .*; at least 2 spring relaxation times are needed", told, re.MULTILINE)
    assert float(re.search(r"^production for error bars +about (\S+)", told, re.MULTILINE)[1]) == pytest.approx(2.5 * alone, rel=0.05)
    finish(tmp_path)
    summary = require_no_error_bar(tmp_path, r"too short to tell: covers 0\.013 of a spring relaxation time")
    assert summary["equilibrium"]["spring_relaxation_times"] == pytest.approx(60 / alone, rel=0.02)


def test_a_pressure_that_springs_are_part_of_has_an_error_bar_only_if_theirs_has(tmp_path):
    """The window covers three of their relaxation times: enough for the clock, and too few values for an error of their pressure."""
    write_pairs_on_springs(tmp_path, 0.1, equilibration=100.0, production=150.0)
    finish(tmp_path)
    summary = summary_of(tmp_path)
    assert summary["equilibrium"]["spring_relaxation_times"] == pytest.approx(150 * 2 * 0.1 / (3 * math.pi), rel=0.01)
    assert summary["pressure_springs"]["standard_error"] is None
    assert summary["equilibrated"] is True and summary["pressure_collision"]["standard_error"] is not None
    for name in ("Z", "pressure", "stress", "principal_stresses"):
        assert summary[name]["standard_error"] in (None, 3 * [None], 3 * [3 * [None]])
        assert "springs, a part of it" in summary[name]["no_standard_error_because"]


def test_swimmers_that_nothing_turns(tmp_path):
    """But their neighbours, seldom: without noise and tumbles they would never forget how they lay."""
    write_scene(tmp_path, {"fluid": {"kT": 0.0}, "box": {"volume_fraction": 0.1}, "rods": {"count": 100, "length": 3.0},
                           "motion": {"self_propulsion": 1.0}, "time": {"equilibration": 1.0, "production": 40.0}})
    finish(tmp_path)
    require_no_error_bar(tmp_path, "too short to tell: ")


SPHERES_THAT_SWIM = {"fluid": {"kT": 0.0}, "box": {"volume_fraction": 0.15}, "rods": {"count": 60, "length": 0.0},
                     "motion": {"self_propulsion": 1.0}, "time": {"equilibration": 1.0, "production": 40.0}}


@pytest.mark.parametrize("tumble_rate, reason", [(0.001, "too short to tell: covers 0.04 of a rotation time"), (0.0, "too short to tell: covers 0 of a rotation time")])
def test_spheres_that_swim_and_hardly_tumble(tmp_path, tumble_rate, reason):
    """The pressure is that of the headings that they began with."""
    write_scene(tmp_path, changed(SPHERES_THAT_SWIM, motion={"tumble_rate": tumble_rate}))
    checked = command(tmp_path, "check", "scene.toml").stdout
    assert "too short to tell" in checked if tumble_rate else "without end: there is no steady state" in checked
    finish(tmp_path)
    require_no_error_bar(tmp_path, reason)


def test_an_open_box(tmp_path):
    write_scene(tmp_path, {"box": {"edges": [20.0, 20.0, 20.0], "periodic": [True, True, False]}, "rods": {"count": 64, "length": 0.0},
                           "time": {"rms_step": 0.08, "equilibration": 20.0, "production": 20.0}})
    finish(tmp_path)
    require_no_error_bar(tmp_path, "not reached: the box is open along z, where rods spread without end")


def test_dense_spheres_that_begin_at_random(tmp_path):
    """Seeds differed by forty of their errors: some began to freeze. A second run that begins where the first ended is no better."""
    write_scene(tmp_path, {"box": {"volume_fraction": 0.58}, "rods": {"count": 64, "length": 0.0}, "time": {"production": 24.0}})
    told = command(tmp_path, "check", "scene.toml").stdout
    assert re.search(r"^production +too short to tell: covers 0\.00\d+ of a diffusion time; at least 2 diffusion times are needed", told, re.MULTILINE)
    finish(tmp_path)
    write_scene(tmp_path, {"box": {"volume_fraction": 0.58}, "rods": {"length": 0.0, "start": "run", "run": "run"}, "time": {"production": 24.0}})
    assert "too short to tell" in command(tmp_path, "check", "scene.toml").stdout
    write_scene(tmp_path, {"box": {"volume_fraction": 0.58}, "rods": {"count": 64, "length": 0.0, "start": "lattice"}, "time": {"production": 24.0}})
    assert "too short" not in command(tmp_path, "check", "scene.toml").stdout


def scenes_of_the_project():
    """Those of scenes/, and those on its pages that are whole; the key of a page is its name and the number of the scene on it."""
    found = {path.name: path.read_text() for path in sorted((ROOT / "scenes").glob("*.toml"))}
    for page in (ROOT / "README.md", *sorted((ROOT / "docs/guide").glob("*.md"))):
        whole = [text for language, text in fenced_blocks(page) if language == "toml" and "production" in text and "[box]" in text]
        found |= {f"{page.name}-{number}": text for number, text in enumerate(whole)}
    return found


@pytest.mark.parametrize("name, text", scenes_of_the_project().items(), ids=scenes_of_the_project())
def test_scenes_of_the_project_last(tmp_path, name, text):
    """As long as `jostle check` proposes for error bars, and without its warnings."""
    folder = ROOT / "scenes" if name.endswith(".toml") else tmp_path
    if folder == tmp_path:
        write_scene(tmp_path, text, name)
    checked = command(folder, "check", name)
    assert checked.returncode == DONE, checked.stderr
    assert "WARNING" not in checked.stdout and "too short" not in checked.stdout
    proposed = re.search(r"^production for error bars +about (\S+)", checked.stdout, re.MULTILINE)
    asked = float(re.search(r"^production += +(\S+)", checked.stdout, re.MULTILINE)[1])
    assert proposed is None or asked >= float(proposed[1])
