"""The time step that a scene without one gets, and what `check` says of steps that are long."""

import json
import math
import re

import pytest
from jostle_command import DONE, RODS, changed, command, require_one_line, write_scene


def checked(folder, scene):
    """Time step and warnings that `check` prints."""
    write_scene(folder, scene)
    result = command(folder, "check", "scene.toml")
    assert result.returncode == DONE, result.stderr
    return float(re.search(r"^time step +(\S+)", result.stdout, re.MULTILINE)[1]), re.findall(r"^WARNING +(.*)", result.stdout, re.MULTILINE)


def automatic(**tables):
    return changed(RODS, **{**tables, "time": {"step": None, "production": 0.05, **tables.get("time", {})}})


def test_tumbles_with_defaults_run(tmp_path):
    """A tumble takes 0.1 and turns the ends of a rod L/D = 2 by up to pi D; the step turns them by 0.05 D."""
    scene = automatic(motion={"self_propulsion": 1.0, "tumble_rate": 1.0})
    step, warnings = checked(tmp_path, scene)
    assert step == pytest.approx(0.05 * 0.1 / math.pi, rel=1e-5) and warnings == []
    result = command(tmp_path, "run", "scene.toml")
    assert result.returncode == DONE, result.stderr
    assert json.loads((tmp_path / "scene.run/run.json").read_text())["time_step"] == pytest.approx(step, rel=1e-5)


def test_the_smallest_of_what_motions_allow(tmp_path):
    """Slow swimmers leave the step to the diffusion, fast ones do not."""
    alone, _ = checked(tmp_path, automatic())
    slow, _ = checked(tmp_path, automatic(motion={"self_propulsion": 0.1}))
    fast, warnings = checked(tmp_path, automatic(motion={"self_propulsion": 8.0}))
    assert slow == alone
    assert fast == pytest.approx(0.04 / 8.0) and fast < alone and warnings == []


@pytest.mark.parametrize("time", [{}, {"accuracy": 0.01}])
def test_where_rods_order(tmp_path, time):
    """There steps are shorter, for the same error of Z; `check` takes the step that a run takes. The paper's scheme and spheres have no part in it."""
    def rms_step(phi, **tables):
        scene = automatic(**{"rods": {"count": 40, "length": 5.0, "start": "aligned"}, "box": {"volume_fraction": phi}, "time": {"production": 0.2, **time}, **tables})
        step, _ = checked(tmp_path, scene)
        told = command(tmp_path, "check", "scene.toml").stdout
        return step, float(re.search(r"rms step / D +(\S+)", told)[1]), re.search(r"error of Z by the step +(.*)", told)

    _, isotropic, of_fluids = rms_step(0.40)
    step, nematic, of_order = rms_step(0.44)
    assert of_fluids[1].endswith("measured of isotropic fluids") and of_order[1].endswith("measured of rods that order")
    assert (isotropic, nematic) == pytest.approx((0.06 * math.sqrt(0.01 / 0.009), 0.06 * math.sqrt(0.01 / 0.036)) if time else (0.04, 0.025), rel=1e-3)
    assert command(tmp_path, "run", "scene.toml").returncode == DONE
    assert json.loads((tmp_path / "scene.run/run.json").read_text())["time_step"] == pytest.approx(step, rel=1e-5)
    if not time:
        assert rms_step(0.44, rods={"count": 40, "length": 0.0})[1] == pytest.approx(0.04, rel=1e-3)
        assert rms_step(0.44, contact={"brownian_correction": False})[1:] == (pytest.approx(0.04, rel=1e-3), None)


def test_cells_that_grow(tmp_path):
    """A hundredth of D for the fastest cells; a run goes on at the step that it began with, whatever cells there are."""
    growth = {"rate": 1.0, "rate_deviation": 0.1, "division_length": 5.0, "death_rate": 0.5}
    scene = automatic(growth=growth, box={"volume_fraction": 0.02}, fluid={"kT": 0.01}, time={"production": 1.0})
    step, warnings = checked(tmp_path, scene)
    assert step == pytest.approx(0.01 / 1.4, rel=1e-5) and warnings == []
    times = []
    for production in (1.0, 1.5):
        write_scene(tmp_path, changed(scene, time={"production": production}))
        result = command(tmp_path, "run", "scene.toml")
        assert result.returncode == DONE, result.stderr
        times.append(json.loads((tmp_path / "scene.run/run.json").read_text())["time_step"])
    assert times[0] == times[1] == pytest.approx(step, rel=1e-5)


def test_springs(tmp_path):
    """Of their stretch springs lose a twentieth in a step."""
    (tmp_path / "springs.csv").write_text("rod_1,rod_2,s_1,s_2,rest_length,stiffness\n0,1,0,0,1,500\n")
    scene = automatic(springs={"file": "springs.csv"})
    write_scene(tmp_path, scene)
    told = command(tmp_path, "check", "scene.toml").stdout
    assert "springs relax per step       0.05 of" in told and "WARNING" not in told
    assert command(tmp_path, "run", "scene.toml").returncode == DONE
    resumed = command(tmp_path, "run", "scene.toml", "--set", "time.production=0.06")
    assert resumed.returncode == DONE, resumed.stderr


@pytest.mark.parametrize("tables, what", [
    ({"motion": {"self_propulsion": 5.0}}, "the fastest swimmer covers 0.1 D; 0.04 is advised at most, a step of 0.008"),
    ({"motion": {"self_propulsion": 1.0, "tumble_rate": 0.5, "tumble_time": 0.4}}, "a tumble turns the ends of a rod by up to 0.1571 D"),
    ({"growth": {"rate": 2.0, "division_length": 5.0, "division_every": 1}}, "the fastest cells lengthen by 0.04 D"),
    ({"time": {"step": None, "rms_step": 0.2}}, "the fastest rod diffuses, in the root mean square per axis, 0.2 D; 0.1 is advised"),
])
def test_long_steps_are_told(tmp_path, tables, what):
    """At a step of 0.02, unless said."""
    _, warnings = checked(tmp_path, changed(RODS, **tables))
    assert len(warnings) == 1 and warnings[0].startswith("the time step is long: in it, " + what)


def test_nothing_that_moves(tmp_path):
    write_scene(tmp_path, automatic(motion={"brownian": False}))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "time.step: is missing, and nothing in the scene moves", "Add step = 1e-3")
    assert not (tmp_path / "scene.run").exists()


@pytest.mark.parametrize("time, told", [({"step": "auto", "rms_step": 0.03}, "is not used with time.rms_step"),
                                        ({"step": 0.01, "rms_step": 0.03}, "is given beside time.step"),
                                        ({"step": "automatic"}, "Did you mean \"auto\"?")])
def test_steps_that_make_no_sense(tmp_path, time, told):
    write_scene(tmp_path, changed(RODS, time=time))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), told)
