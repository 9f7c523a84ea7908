"""Choices of a scene that change what is computed: soft rods, and other conventions of the stress."""

import json
import re

import h5py
import numpy as np
import pytest

from jostle_command import (DONE, RODS, STOPPED, changed, column, command, finish, mean, require_one_line, run, with_steps,
                            write_scene)

SOFT = {"contact": {"model": "wca", "energy": 1.0}, "time": {"step": 0.0005}, "output": {"series_every": 1}}


def test_soft_rods(tmp_path):
    """No contact problem is solved, rods overlap a little, and the run resumes bit for bit."""
    write_scene(tmp_path / "one", with_steps(changed(RODS, **SOFT), 400))
    folder = finish(tmp_path / "one")
    assert set(column(folder / "series.csv", "iterations")) == {0.0}
    assert 0.0 < max(column(folder / "series.csv", "max_overlap")) < 0.2
    assert mean(folder, "Z") > 1.5
    write_scene(tmp_path / "hard", with_steps(changed(RODS, time={"step": 0.0005}), 400))
    assert mean(finish(tmp_path / "hard"), "iterations") >= 1.0


def test_soft_rods_need_an_energy(tmp_path):
    write_scene(tmp_path, changed(RODS, contact={"model": "wca"}, fluid={"kT": 0.0}))
    result = run(tmp_path)
    assert result.returncode == 2 and "contact.energy" in result.stderr and "fluid.kT = 0" in result.stderr


def test_stress_conventions(tmp_path):
    """All have the same trace up to the moments along the rods; only the first is what the pressure is made of."""
    write_scene(tmp_path, with_steps(changed(RODS, output={"stress_conventions": True}), 400))
    folder = finish(tmp_path)
    of_summary = json.loads((folder / "summary.json").read_text())["stress_conventions"]
    for convention in ("centre_of_mass", "centre_line"):
        tensor = of_summary[convention]["mean"]
        assert len(tensor) == 3 and "anisotropy" in of_summary[convention]
    rows = {name: column(folder / "series.csv", name)
            for name in [f"{kind}_{ab}" for kind in ("stress", "centre_of_mass", "centre_line")
                         for ab in ("xx", "yy", "zz", "xy", "yx")]}
    for row in range(len(rows["stress_xx"])):
        trace = {kind: sum(rows[f"{kind}_{aa}"][row] for aa in ("xx", "yy", "zz"))
                 for kind in ("stress", "centre_of_mass", "centre_line")}
        # The geometric stress is traceless; from centre line to centre line the distance is the diameter.
        assert trace["centre_of_mass"] == pytest.approx(trace["stress"], rel=1e-9)
        assert 0.0 < trace["centre_line"] < trace["stress"]
        assert rows["centre_line_xy"][row] == pytest.approx(rows["centre_line_yx"][row], rel=1e-9, abs=1e-12)
    assert any(abs(rows["centre_of_mass_xy"][row] - rows["centre_of_mass_yx"][row]) > 1e-6
               for row in range(len(rows["stress_xx"])))


def test_an_anisotropy_that_equilibrium_does_not_have_is_said(tmp_path):
    """The paper's scheme at a long step: the stress of a nematic is then some ten per cent of itself too isotropic."""
    nematic = {"seed": 3, "box": {"volume_fraction": 0.46}, "rods": {"count": 200, "length": 5.0, "start": "aligned"},
               "contact": {"brownian_correction": False, "overlap_limit": 0.95},
               "time": {"step": 0.05, "equilibration": 20.0, "production": 250.0}, "output": {"series_every": 5}}
    write_scene(tmp_path, nematic)
    result = run(tmp_path)
    checks = json.loads((tmp_path / "run" / "summary.json").read_text())["checks"]
    assert result.returncode == DONE
    for name, words in (("collision_stress_ratio", "collision stress"), ("total_stress_ratio", "total stress")):
        assert checks[name]["agree"] is False and checks[name]["difference"] < 0.0
        assert f"WARNING: the {words} along/across the director differs from that of equilibrium" in result.stdout
        assert re.search(rf"^  {words} +=.*: disagrees  ", result.stdout, re.MULTILINE)


def test_speeds_of_a_file(tmp_path):
    """Every rod swims at the speed of its line, whatever rows and checkpoints do to it."""
    speeds = [0.5, -1.0, 2.0]
    lines = [f"10,{10 + 10 * k},10,1,0,0,{speed}" for k, speed in enumerate(speeds)]
    (tmp_path / "rods.csv").write_text("\n".join(["x,y,z,nx,ny,nz,speed", *lines]) + "\n")
    scene = changed(RODS, rods={"count": None, "start": "file", "file": "rods.csv"},
                    box={"volume_fraction": None, "edges": [40.0, 40.0, 40.0]},
                    motion={"brownian": False, "self_propulsion": 1.0},
                    time={"step": 0.01}, output={"trajectory_every": 100, "checkpoint_every": 50})
    write_scene(tmp_path, with_steps(scene, 1100))
    stopped = run(tmp_path, "--walltime", "0:00:00")
    assert stopped.returncode == STOPPED, stopped.stderr
    folder = finish(tmp_path)
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        order = np.argsort(rods["id/value"][-1])
        time = rods["position/time"][-1]
        moved = (rods["position/value"][-1] + 40.0 * rods["image/value"][-1])[order, 0] - 10.0
    assert time == pytest.approx(11.0)
    np.testing.assert_allclose(moved, np.array(speeds) * time, rtol=1e-5)


def test_a_soft_potential_too_stiff_for_the_step_is_refused_before_the_run(tmp_path):
    """Rods that meet with 5 kT must not be thrown farther apart than twice their overlap (theory, eq. 2.20)."""
    write_scene(tmp_path, changed(RODS, **{**SOFT, "contact": {"model": "wca", "energy": 1e8}}))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "contact.energy = 1", "makes a potential too stiff for the time step",
                         "a step of at most", "Use a shorter time.step or a lower energy")
    assert not list(tmp_path.glob("*.run"))
    write_scene(tmp_path, changed(RODS, **SOFT))
    told = command(tmp_path, "check", "scene.toml").stdout
    relaxation = float(re.search(r"potential relaxes per step\W+([\d.]+)", told)[1])
    assert 0.01 < relaxation < 2


def test_steps_too_long_between_the_images_of_a_rod_are_refused(tmp_path):
    """At 1.001 D a rod may turn by 0.045 to either side, at 1.00001 D by 0.0045; an rms step of 0.03 turns it by 0.012, and the
    automatic step by half of what it may."""
    scene = {"box": {"edges": [1.001, 12.0, 12.0]}, "rods": {"count": 1, "length": 5.0, "start": "aligned", "axis": [0, 0, 1]},
             "time": {"rms_step": 0.03, "production": 10.0}}
    write_scene(tmp_path, scene)
    assert command(tmp_path, "check", "scene.toml").returncode == DONE
    write_scene(tmp_path, changed(scene, box={"edges": [1.00001, 12.0, 12.0]}))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "box.edges = ", "leaves rods no room to turn between their own images",
                         "a step of at most", "Use a shorter time.step or a larger box")
    write_scene(tmp_path, changed(scene, box={"edges": [1.00001, 12.0, 12.0]}, time={"rms_step": None}))
    checked = command(tmp_path, "check", "scene.toml")
    assert checked.returncode == DONE and "WARNING" not in checked.stdout, checked.stdout + checked.stderr
    write_scene(tmp_path, changed(scene, box={"edges": [1.0, 12.0, 12.0]}))
    require_one_line(command(tmp_path, "check", "scene.toml"), "box.edges = ", "between their own images, however short a step is. Use a larger box")
