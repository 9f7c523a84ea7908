"""`jostle sweep`, `collect` and `extrapolate`: what they run, leave and refuse."""

import csv
import json
import math
import re
import shlex
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from fenced_blocks import fenced_blocks
from jostle_command import (BAD_INPUT, DONE, JOSTLE, NUMERICS, STOPPED, changed, command, require_one_line, scene_text,
                            snapshot, started, wait_until, write_scene)

ROOT = Path(__file__).resolve().parents[2]
sys.path += [str(ROOT / "sweeps"), str(ROOT / "presentation")]

import extrapolate  # noqa: E402  (the path comes first)
import points  # noqa: E402
import refusal  # noqa: E402
import replicas  # noqa: E402
import side_by_side  # noqa: E402
from weighted_fit import WeightedFit  # noqa: E402

SPHERES = {
    "seed": 3,
    "box": {"volume_fraction": 0.2},
    "rods": {"count": 64, "length": 0.0},
    "time": {"rms_step": 0.1, "equilibration": 3.0, "production": 60.0},
    "output": {"series_every": 2},
}
FRACTIONS = ("--set", "box.volume_fraction=0.1,0.3")


def sweep(folder, *options):
    return command(folder, "sweep", "scene.toml", "--processes", "2", *options)


def table(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def summary(folder):
    return json.loads((folder / "summary.json").read_text())


@pytest.fixture(scope="module")
def swept(tmp_path_factory):
    """Two volume fractions, two seeds each; tests copy it."""
    folder = tmp_path_factory.mktemp("swept")
    write_scene(folder, SPHERES)
    result = sweep(folder, *FRACTIONS, "--replicas", "2", "--plot", "Z", "--plot", "stress_xx")
    assert result.returncode == DONE, result.stderr
    (folder / "stdout").write_text(result.stdout)
    return folder


@pytest.fixture
def swept_copy(swept, tmp_path):
    return shutil.copytree(swept, tmp_path / "copy")


@pytest.fixture
def scene(tmp_path):
    write_scene(tmp_path, SPHERES)
    return tmp_path


def test_the_table_holds_what_the_runs_say(swept):
    rows = table(swept / "scene.sweep/sweep.csv")
    assert [(row["box.volume_fraction"], row["seed"], row["status"]) for row in rows] == [
        (phi, seed, "done") for phi in ("0.1", "0.3") for seed in ("3", "4")]
    for row in rows:
        told = summary(swept / "scene.sweep" / row["folder"])
        assert (float(row["Z"]), float(row["Z_standard_error"]), float(row["Z_n_eff"])) == tuple(
            told["Z"][part] for part in ("mean", "standard_error", "n_eff"))
        assert float(row["stress_collision_xy"]) == told["stress_collision"]["mean"][0][1]
        assert (float(row["L_over_D"]), float(row["volume_fraction"]), int(row["rods"])) == (0.0, float(row["box.volume_fraction"]), 64)
        assert command(swept, "verify", f"scene.sweep/{row['folder']}").returncode == DONE
    assert len({row["Z"] for row in rows}) == 4
    for name in ("Z", "stress_xx"):
        assert (swept / f"scene.sweep/{name}.png").read_bytes().startswith(b"\x89PNG")
        assert "<svg" in (swept / f"scene.sweep/{name}.svg").read_text()


def test_means_over_replicas(swept):
    rows, means = table(swept / "scene.sweep/sweep.csv"), table(swept / "scene.sweep/replicas.csv")
    assert [(row["box.volume_fraction"], row["replicas"]) for row in means] == [("0.1", "2"), ("0.3", "2")]
    total = 0.0
    for mean, pair in zip(means, (rows[:2], rows[2:])):
        Z, error = (np.array([float(row[name]) for row in pair]) for name in ("Z", "Z_standard_error"))
        chi_squared = (Z[0] - Z[1])**2 / (error**2).sum()  # of two values
        assert float(mean["Z"]) == pytest.approx(Z.mean())
        assert float(mean["Z_error_within"]) == pytest.approx(math.hypot(*error) / 2)
        assert float(mean["Z_error_scatter"]) == pytest.approx(abs(Z[0] - Z[1]) / 2 * 12.7062 / 1.95996, rel=1e-5)
        assert float(mean["Z_chi_squared"]) == pytest.approx(chi_squared)
        total += chi_squared
    printed = (swept / "stdout").read_text()
    assert f"chi squared of Z {total:.3g} of 2 degrees of freedom" in printed


def test_the_same_command_runs_nothing_again_and_more_values_are_added(swept_copy):
    runs = swept_copy / "scene.sweep"
    before = {name: snapshot(runs / name) for name in ("volume_fraction=0.1_seed=3", "volume_fraction=0.3_seed=4")}
    again = sweep(swept_copy, *FRACTIONS, "--replicas", "2", "--plot", "Z")
    assert again.returncode == DONE and "4 of them done before" in again.stderr
    assert again.stdout == (swept_copy / "stdout").read_text()
    more = sweep(swept_copy, "--set", "box.volume_fraction=0.1,0.2,0.3", "--replicas", "2")
    assert more.returncode == DONE and "6 runs" in more.stderr and "4 of them done before" in more.stderr
    assert len(table(runs / "sweep.csv")) == 6
    assert {name: snapshot(runs / name) for name in before} == before


def test_a_longer_production_goes_on(swept_copy):
    first = swept_copy / "scene.sweep/volume_fraction=0.1_seed=3"
    before = (first / "series.csv").read_text()
    result = sweep(swept_copy, *FRACTIONS, "--replicas", "2", "--set", "time.production=63")
    assert result.returncode == DONE, result.stderr
    after = (first / "series.csv").read_text()
    assert after.startswith(before) and len(after) > len(before)


def test_collect_makes_the_same_table(swept_copy):
    made = command(swept_copy, "collect", "scene.sweep")
    assert made.returncode == DONE, made.stderr
    rows, ours = list(csv.DictReader(made.stdout.splitlines())), table(swept_copy / "scene.sweep/sweep.csv")
    assert len(rows) == 4
    for row, own in zip(rows, ours):
        assert {**row, "folder": ""} == {**own, "folder": ""}
        assert row["folder"] == f"scene.sweep/{own['folder']}"
    drawn = command(swept_copy, "collect", "scene.sweep/volume_fraction=0.1_seed=3", "scene.sweep/volume_fraction=0.3_seed=3", "--out",
                    "curve", "--plot", "Z")
    assert drawn.returncode == DONE, drawn.stderr
    assert sorted(path.name for path in (swept_copy / "curve").iterdir()) == ["Z.png", "Z.svg", "sweep.csv"]
    before = snapshot(swept_copy)
    (swept_copy / "scene.sweep/lock").write_text("")
    require_one_line(command(swept_copy, "collect", "scene.sweep", "--out", "scene.sweep"), "it is not replaced")
    require_one_line(command(swept_copy, "collect", "nowhere"), "nowhere", "there is no such folder")
    require_one_line(command(swept_copy, "collect", "curve"), "there is no run in it")
    require_one_line(command(swept_copy, "collect", "scene.sweep", "--plot", "Z"), "--out DIR")
    assert snapshot(swept_copy) == before


@pytest.mark.parametrize("options, parts", [
    (("--set", "box.volume_fracton=0.1,0.2"), ("box.volume_fracton", "is an unknown key", 'Did you mean "volume_fraction"?')),
    (("--set", "box.volume_fraction=0.1,0.2", "--set", "rods.length=0,1,2", "--zip"),
     ("--zip", "box.volume_fraction: has 2 values and rods.length has 3",)),
    (("--set", "box.volume_fraction=0.1,0.99"), ("point volume_fraction=0.99", "cannot be packed")),
    (("--set", "box.volume_fraction=0.1,0.1"), ("has the value 0.1 twice", "--replicas")),
    (("--set", "box.volume_fraction=0.1,"), ("has an empty value",)),
    (("--set", "box.volume_fraction"), ("is not of the form KEY=VALUE,VALUE",)),
    (("--set", "rods.length=0,1", "--set", "rods.length=2"), ("is given twice",)),
    (("--set", "rods.length=1"), ("nothing to vary",)),
    (("--replicas", "none"), ("--replicas = none", "1 to 10000")),
    (("--replicas", "2", "--set", "seed=1,2"), ("sets the seed",)),
    (("--set", "rods.length=0,1", "--plot", "W"), ("--plot W", "is no average")),
    (("--set", "rods.length=0,1", "--against", "rods.count"), ("--against rods.count", "rods.length")),
    (("--set", "rods.length=0,1", "--out", "no/where"), ("there is no such folder",)),
    (("--set", "rods.length=0,1", "--out", "scene.toml"), ("is not the folder of a sweep",)),
])
def test_bad_requests_change_nothing(scene, options, parts):
    before = snapshot(scene)
    require_one_line(sweep(scene, *options), *parts)
    assert snapshot(scene) == before


def test_a_folder_of_another_sweep_is_left_alone(swept_copy):
    before = snapshot(swept_copy)
    require_one_line(sweep(swept_copy, "--set", "rods.length=0,1"), "holds another sweep: over box.volume_fraction, seed", "over rods.length")
    require_one_line(sweep(swept_copy, *FRACTIONS, "--replicas", "2", "--set", "rods.count=50"),
                     "holds a sweep of another scene: rods.count was 64 and is 50")
    write_scene(swept_copy, changed(SPHERES, rods={"length": 1.0}), "other.toml")
    require_one_line(command(swept_copy, "sweep", "other.toml", *FRACTIONS, "--replicas", "2", "--out", "scene.sweep"),
                     "rods.length was 0.0 and is 1.0")
    (swept_copy / "mine").mkdir()
    (swept_copy / "mine/note").write_text("keep")
    require_one_line(sweep(swept_copy, *FRACTIONS, "--out", "mine"), "is not the folder of a sweep")
    (swept_copy / "mine/note").unlink()
    (swept_copy / "mine").rmdir()
    (swept_copy / "other.toml").unlink()
    assert snapshot(swept_copy) == before
    (swept_copy / "scene.sweep/sweep.json").write_text("{")
    require_one_line(sweep(swept_copy, *FRACTIONS, "--replicas", "2"), "sweep.json", "damaged")


def test_a_point_that_fails_does_not_stop_the_others(scene):
    result = sweep(scene, "--set", "contact.overlap_limit=0.001,0.2", "--set", "box.volume_fraction=0.3", "--set", "time.production=6")
    assert result.returncode == NUMERICS, result.stdout + result.stderr
    failures = [line for line in result.stderr.splitlines() if "failed" in line]
    assert failures[0].startswith("jostle: overlap_limit=0.001 failed: exit status 3: step ") and "1 of 2 runs failed" in failures[1]
    bad, good = table(scene / "scene.sweep/sweep.csv")
    assert good["status"] == "done" and bad["status"].startswith("failed (exit status 3: step ") and bad["Z"] == ""
    assert "failed" in list(csv.DictReader(command(scene, "collect", "scene.sweep").stdout.splitlines()))[0]["status"]


def test_ctrl_c_stops_all_and_the_same_command_goes_on(tmp_path):
    write_scene(tmp_path, changed(SPHERES, time={"rms_step": 0.03}))
    words = ["sweep", "scene.toml", "--processes", "2", "--set", "box.volume_fraction=0.1,0.2,0.3"]
    process = subprocess.Popen([JOSTLE, *words], cwd=tmp_path, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    started.append(process)
    series = [tmp_path / f"scene.sweep/volume_fraction={phi}/series.csv" for phi in ("0.2", "0.3")]  # the longest first
    wait_until(lambda: all(path.exists() and path.stat().st_size > 5000 for path in series), process)
    process.send_signal(signal.SIGINT)
    printed, errors = process.communicate(timeout=60)
    assert process.returncode == STOPPED and "the same command goes on from here" in errors, errors
    assert "stopped (signal 2)" in printed
    rows = table(tmp_path / "scene.sweep/sweep.csv")
    assert [row["status"] for row in rows] == ["not begun", "stopped (signal 2)", "stopped (signal 2)"]
    again = command(tmp_path, *words)
    assert again.returncode == DONE, again.stderr
    assert [row["status"] for row in table(tmp_path / "scene.sweep/sweep.csv")] == ["done"] * 3
    for path in series:
        sessions = json.loads(path.with_name("run.json").read_text())["sessions"]
        assert len(sessions) == 2 and sessions[1]["first_step"] == sessions[0]["last_step"] > 0


def test_one_sweep_at_a_time_in_a_folder(swept_copy):
    import fcntl

    with open(swept_copy / "scene.sweep/lock", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        require_one_line(sweep(swept_copy, *FRACTIONS, "--replicas", "2"), "another sweep goes on in this folder")


def test_printed_commands_make_the_same_runs(swept, tmp_path):
    write_scene(tmp_path, SPHERES)
    listed = sweep(tmp_path, *FRACTIONS, "--replicas", "2", "--print-commands")
    lines = listed.stdout.splitlines()
    assert listed.returncode == DONE and len(lines) == 4
    for line in lines:
        words = shlex.split(line)
        assert words[:3] == [JOSTLE, "run", "scene.toml"]
        assert subprocess.run([*words, "--quiet", "--threads", "1"], cwd=tmp_path, check=False, timeout=60).returncode == DONE
    after = sweep(tmp_path, *FRACTIONS, "--replicas", "2")
    assert after.returncode == DONE and "4 of them done before" in after.stderr
    for row, other in zip(table(tmp_path / "scene.sweep/sweep.csv"), table(swept / "scene.sweep/sweep.csv")):
        assert (row["folder"], row["Z"]) == (other["folder"], other["Z"])


def test_a_sweep_that_the_scene_asks_for(tmp_path):
    write_scene(tmp_path, scene_text(SPHERES) + '[sweep]\nbox.volume_fraction = [0.1, 0.3]\nrods.start = ["random", "aligned"]\n'
                "zip = true\nreplicas = 2\n")
    def names(*options):
        return [shlex.split(line)[-1] for line in sweep(tmp_path, "--print-commands", "--out", "to", *options).stdout.splitlines()]
    assert names() == [f"to/volume_fraction={phi}_start={start}_seed={seed}" for phi, start in (("0.1", "random"), ("0.3", "aligned"))
                       for seed in (3, 4)]
    shutil.rmtree(tmp_path / "to")
    assert names("--set", "rods.start=aligned", "--replicas", "1") == ["to/volume_fraction=0.1", "to/volume_fraction=0.3"]
    write_scene(tmp_path, scene_text(SPHERES) + "[sweep]\nbox.volume_fraction = 0.1\n")
    require_one_line(sweep(tmp_path), "sweep.box.volume_fraction", "is not a list of values")


def test_a_scene_that_cannot_be_read(tmp_path):
    require_one_line(sweep(tmp_path), "scene.toml", "there is no such file")
    write_scene(tmp_path, "[box\n")
    require_one_line(sweep(tmp_path), "scene.toml:1")
    write_scene(tmp_path, "sweep = 3\n" + scene_text(SPHERES))
    require_one_line(sweep(tmp_path, *FRACTIONS), "sweep = 3")


def test_extrapolation_of_a_run(scene):
    result = command(scene, "extrapolate", "scene.toml", "--rms-steps", "0.1,0.14,0.2", "--processes", "2",
                     "--set", "contact.overlap_limit=0.9")
    assert result.returncode == DONE, result.stderr
    rows = {row["average"]: row for row in table(scene / "scene.extrapolate/extrapolated.csv")}
    runs = table(scene / "scene.extrapolate/sweep.csv")
    assert [row["time.rms_step"] for row in runs] == ["0.2", "0.14", "0.1"]
    values, errors = (np.array([float(row[name]) for row in runs]) for name in ("Z", "Z_standard_error"))
    x = np.array([0.2, 0.14, 0.1])
    slope, limit = np.polyfit(x**2, values, 1, w=1 / errors)
    Z = rows["Z"]
    assert (float(Z["mean"]), float(Z["coefficient_x2"])) == pytest.approx((limit, slope), rel=1e-6)
    assert float(Z["chi_squared"]) == pytest.approx((((limit + slope * x**2 - values) / errors)**2).sum(), rel=1e-6)
    assert Z["degrees"] == "1" and Z["verdict"] in ("the model holds", "the model fails: smaller steps are needed")
    assert "a + b x^2" in result.stdout
    printed = next(line for line in result.stdout.splitlines() if line.startswith("Z "))
    assert f"{limit:.5g}" in printed


@pytest.mark.parametrize("changes, options, parts", [
    ({}, ("--rms-steps", "0.1"), ("at least two different steps",)),
    ({}, ("--rms-steps", "0.1,0.1"), ("at least two different steps",)),
    ({}, ("--rms-steps", "0.1,big"), ("are not all numbers above 0",)),
    ({}, ("--rms-steps", "0.1,0.9"), ("time.rms_step = 0.9",)),
    ({}, ("--set", "time.rms_step=0.1"), ("--rms-steps does",)),
    ({"contact": {"brownian_correction": False}}, ("--rms-steps", "0.1,0.05"), ("the model has 3 unknowns: a + b x + c x^2",)),
])
def test_what_extrapolate_refuses(tmp_path, changes, options, parts):
    write_scene(tmp_path, changed(SPHERES, **changes))
    before = snapshot(tmp_path)
    require_one_line(command(tmp_path, "extrapolate", "scene.toml", *options), *parts)
    assert snapshot(tmp_path) == before


def rows_at_steps(Z, steps=(0.2, 0.14, 0.1, 0.07)):
    return [{"time.rms_step": x, "status": "done", "Z": Z(x), "Z_standard_error": 0.01} for x in steps]


def test_an_extrapolation_says_when_its_model_fails():
    right = extrapolate.extrapolated(rows_at_steps(lambda x: 5 + 3 * x**2), "Z", (2,))
    assert (right["mean"], right["coefficient_x2"], right["verdict"]) == (pytest.approx(5), pytest.approx(3), "the model holds")
    wrong = extrapolate.extrapolated(rows_at_steps(lambda x: 5 - 3 * x), "Z", (2,))
    assert wrong["standard_error"] is None and wrong["verdict"].startswith("the model fails")
    half = extrapolate.extrapolated(rows_at_steps(lambda x: 5 - 3 * x + 2 * x**2), "Z", (1, 2))
    assert (half["mean"], half["coefficient_x1"], half["verdict"]) == (pytest.approx(5), pytest.approx(-3), "the model holds")
    two = extrapolate.extrapolated(rows_at_steps(lambda x: 5 + 3 * x**2, (0.2, 0.1)), "Z", (2,))
    assert two["verdict"].startswith("not tested") and two["mean"] == pytest.approx(5)
    rows = rows_at_steps(lambda x: 5.0)
    rows[1]["Z_standard_error"] = None
    assert "mean" not in extrapolate.extrapolated(rows, "Z", (2,))
    rows[1]["status"] = "not begun"
    assert "runs are missing" in extrapolate.extrapolated(rows, "Z", (2,))["verdict"]


def test_errors_of_a_fit():
    """By the scatter of 2000 fits: their errors are known to sqrt(1/4000) = 1.6 %, allowed is four times that; the mean of chi squared, 2, to
    2/sqrt(2000) = 0.045."""
    generator = np.random.default_rng(20190213)
    x, errors = np.array([0.2, 0.14, 0.1, 0.07]), np.array([0.01, 0.02, 0.01, 0.03])
    fits = [WeightedFit(5 + 3 * x**2 + errors * generator.normal(size=4), errors, [x**0, x**2]) for _ in range(2000)]
    values = np.array([fit.value for fit in fits])
    assert values.std(axis=0) == pytest.approx(fits[0].error, rel=0.065)
    assert np.mean([fit.chi_squared for fit in fits]) == pytest.approx(2.0, abs=0.18)
    assert np.mean([fit.probability for fit in fits]) == pytest.approx(0.5, abs=0.03)


def test_means_by_hand():
    mean = replicas.mean_of([1.0, 2.0, 3.0], [1.0, 1.0, 1.0])
    assert (mean.value, mean.within, mean.chi_squared, mean.degrees) == pytest.approx((2.0, 3**-0.5, 2.0, 2))
    assert mean.scatter == pytest.approx(3**-0.5 * 4.302653 / 1.959964)
    assert mean.probability == pytest.approx(math.exp(-1.0)) and mean.agree and mean.error == mean.within
    apart = replicas.mean_of([1.0, 2.0, 3.0], [0.1, 0.1, 0.1])
    assert not apart.agree and apart.error == apart.scatter
    unknown = replicas.mean_of([1.0, 2.0], [0.1, math.nan])
    assert unknown.agree is None and unknown.error == unknown.scatter
    alone = replicas.mean_of([1.0], [0.1])
    assert alone.error == 0.1 and math.isnan(alone.scatter)


def test_values_and_names():
    assert points.split("0.1, 0.2") == ["0.1", "0.2"]
    assert points.split('[1, 1, 2],[1, 1, 3]') == ["[1, 1, 2]", "[1, 1, 3]"] and points.split('"a,b",c') == ['"a,b"', "c"]
    made = points.points_of({"a.x": ["1", "2"], "b.y": ["u v"]}, False, [(("seed", "1"),), (("seed", "2"),)])
    assert [point.name for point in made] == ["x=1_seed=1", "x=1_seed=2", "x=2_seed=1", "x=2_seed=2"]
    assert made[0].words() == ["--set", "a.x=1", "--set", "b.y=u v", "--set", "seed=1"]
    assert [point.name for point in points.points_of({"a.file": ["1", "2"], "b.file": ["1", "2"]}, True)] == [
        "a.file=1_b.file=1", "a.file=2_b.file=2"]
    assert [point.name for point in points.points_of({"a.x": ["a/b", "a-b"]}, False)] == ["point-1", "point-2"]
    with pytest.raises(refusal.Refusal, match="a.x: has 2 values and b.y has 3"):
        points.points_of({"a.x": ["1", "2"], "b.y": ["1", "2", "3"]}, True)


def values_of(text):
    """[(mean, error)] of lines that begin with Z or a volume fraction, by that word."""
    lines = re.findall(r"^ *(Z|0\.\d+) +(\d[\d.]* \+- .*)$", text, re.MULTILINE)
    return {name: [(float(mean), float(error)) for mean, error in re.findall(r"([\d.]+) \+- ([\d.]+)", rest)] for name, rest in lines}


def test_the_rods_that_threads_are_given_for(tmp_path):
    """Those of the end, where cells divide: a colony begins as one."""
    def rods(scene):
        write_scene(tmp_path, scene)
        return side_by_side.ask(JOSTLE, tmp_path / "scene.toml").rods
    cells = changed(SPHERES, rods={"count": 50, "length": 1.0}, box={"volume_fraction": 0.02}, growth={"rate": 0.5, "division_length": 3.0},
                    time={"rms_step": None, "step": 0.01, "production": 8.0, "equilibration": 0.0})
    assert rods(SPHERES) == 64 and rods(cells) == 200
    assert rods(changed(cells, time={"production": 1e6})) == 50  # more than can be told


def test_how_long_a_colony_takes_is_not_foretold(tmp_path):
    colony = changed(SPHERES, rods={"count": 1, "length": 1.0}, box={"volume_fraction": None, "edges": [50.0, 50.0, 50.0], "periodic": [False] * 3},
                     fluid={"kT": 0.01}, growth={"rate": 1.0, "division_length": 3.0},
                     time={"rms_step": None, "step": 0.01, "production": 1.0, "equilibration": 0.0})
    write_scene(tmp_path, colony)
    began = sweep(tmp_path, "--replicas", "2").stderr.splitlines()[0]
    assert began.endswith("; how long it takes is not known, for cells multiply")
    write_scene(tmp_path, SPHERES)
    began = sweep(tmp_path, "--replicas", "2", "--out", "spheres").stderr.splitlines()[0]
    assert re.search(r"; about \d+ s on 2 processors$", began)


def test_the_guide(tmp_path):
    """Every command of the page; its numbers, within five errors of both, as their last digits are those of one build."""
    page = ROOT / "docs/guide/sweeps.md"
    blocks = fenced_blocks(page)
    (tmp_path / "rods.toml").write_text(next(text for language, text in blocks if language == "toml"))
    printed = ""
    for text in (text for language, text in blocks if language == "bash"):
        result = subprocess.run(["bash", "-ec", f"jostle() {{ {shlex.quote(JOSTLE)} \"$@\"; }}\n{text}"], cwd=tmp_path, capture_output=True,
                                text=True, check=False, timeout=250)
        assert result.returncode == DONE, result.stderr
        printed += result.stdout
    shown, found = values_of(page.read_text()), values_of(printed)
    assert sorted(map(len, shown.values())) == [1, 1, 1, 1, 4]  # four volume fractions; Z at three steps and at none
    for name, values in shown.items():
        for (value, error), (other, its_error) in zip(values, found[name], strict=True):
            assert abs(value - other) < 5 * math.hypot(error, its_error), name
    assert (tmp_path / "both/Z.png").exists() and len((tmp_path / "all.csv").read_text().splitlines()) == 9
