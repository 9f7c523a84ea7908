"""Two dimensions: what is refused, the same bits for every way to the end, and what all outputs say."""

import json

import gsd.hoomd
import h5py
import numpy as np
import pytest

from jostle_command import BAD_INPUT, DONE, RODS, changed, command, finish, require_one_line, require_same_results, run, with_steps, write_scene

FLAT = changed(RODS, box={"volume_fraction": None, "dimensions": 2, "area_fraction": 0.4}, output={"stress_per_rod": True})
CELLS = {"seed": 3, "box": {"dimensions": 2, "edges": [40.0, 40.0], "periodic": [False, False]}, "rods": {"count": 1, "length": 2.0},
         "motion": {"brownian": False}, "growth": {"rate": 1.0, "rate_deviation": 0.1, "division_length": 4.0},
         "time": {"step": 0.01, "production": 9.0}, "output": {"series_every": 10, "trajectory_every": 50}}
SCENES = {"Brownian": FLAT, "swimmers": changed(FLAT, motion={"self_propulsion": 2.0, "tumble_rate": 0.2, "reversal_rate": 1.0}),
          "slit": changed(FLAT, box={"periodic": [True, False]}, walls={"faces": [False, True]}),
          "disc": changed(FLAT, box={"periodic": [False, False]}, walls={"container": "tube"}), "cells": CELLS}


def rods_of(folder):
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        return {name: rods[f"{name}/value"][()] for name in ("position", "orientation", "id")} | {"edges": rods["box/edges"][()]}


@pytest.mark.parametrize("changes, key, words", [
    ({"box": {"area_fraction": None, "volume_fraction": 0.2}}, "box.volume_fraction", "Write area_fraction"),
    ({"box": {"dimensions": None}}, "box.area_fraction", "set box.dimensions = 2"),
    ({"box": {"dimensions": 4}}, "box.dimensions", "at most 3"),
    ({"box": {"shape": [1.0, 1.0, 1.0]}}, "box.shape", "two elements"),
    ({"box": {"periodic": [False, False]}, "walls": {"container": "sphere"}}, "walls.container", "disc"),
    ({"mobility": {"model": "hydrodynamic"}}, "mobility.model", "film"),
    ({"forces": {"on_rods": [0.0, 0.0, 1.0]}}, "forces.on_rods", "two elements"),
])
def test_what_is_not_of_the_plane_is_refused_in_one_line(tmp_path, changes, key, words):
    write_scene(tmp_path, changed(FLAT, **changes))
    result = command(tmp_path, "check", "scene.toml")
    line, = [line for line in result.stderr.splitlines() if f": {key} = " in line]
    assert result.returncode == BAD_INPUT and words in line


def test_a_file_with_a_rod_out_of_the_plane_is_refused_with_its_line(tmp_path):
    write_scene(tmp_path, changed(FLAT, box={"area_fraction": None, "edges": [20.0, 20.0]}, rods={"count": None, "start": "file", "file": "rods.csv"}))
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n1,1,0,1,0,0\n9,9,0.25,1,0,0\n")
    require_one_line(command(tmp_path, "check", "scene.toml"), "rods.csv:3", "z = 0.25")
    (tmp_path / "rods.csv").write_text("x,y,nx,ny\n1,1,1,0\n9,9,0,1\n")
    assert command(tmp_path, "check", "scene.toml").returncode == DONE


def test_the_outputs_of_a_monolayer(tmp_path):
    scene = changed(FLAT, output={"field_every": 50})
    write_scene(tmp_path, scene)
    result = run(tmp_path)
    assert result.returncode == DONE, result.stderr
    assert "kT/D2" in result.stdout
    folder, count = tmp_path / "run", scene["rods"]["count"]
    rods = rods_of(folder)
    assert not rods["position"][..., 2].any() and not rods["orientation"][..., 2].any()
    assert rods["edges"][2] == 0.0 and rods["edges"][0] == rods["edges"][1]
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["dimensions"] == 2 and summary["area_fraction"] == pytest.approx(0.4) and "volume_fraction" not in summary
    assert len(summary["principal_stresses"]["mean"]) == 2 and summary["pressure"]["unit"] == "kT D-2"
    stress = np.array(summary["stress"]["mean"])
    assert not stress[2].any() and not stress[:, 2].any()
    assert summary["pressure"]["mean"] == pytest.approx(np.trace(stress) / 2)
    rows = np.genfromtxt(folder / "series.csv", delimiter=",", names=True)
    assert rows["phi"] == pytest.approx(0.4) and not rows["stress_zz"].any() and not rows["order_zz"].any()
    area = np.prod(rods["edges"][:2])
    assert rows["Z"] == pytest.approx(rows["pressure"] * area / count)
    field = np.genfromtxt(folder / "field.csv", delimiter=",", names=True)
    assert not field["z"].any() and field["number_density"].mean() == pytest.approx(count / area)
    assert command(tmp_path, "verify", "run").returncode == DONE
    made = command(tmp_path, "report", "run", "--width", "120")
    assert made.returncode == DONE, made.stderr
    page = (folder / "report/report.html").read_text()
    assert "area fraction" in page and "olume fraction" not in page
    assert command(tmp_path, "export", "run", "--to", "gsd").returncode == DONE
    with gsd.hoomd.open(str(folder / "trajectory.gsd"), "rb") as frames:
        assert frames[0].configuration.dimensions == 2 and frames[0].configuration.box[2] == 0.0
    for form in ("vtk", "xyz"):
        assert command(tmp_path, "export", "run", "--to", form).returncode == DONE


@pytest.mark.parametrize("name", SCENES)
def test_the_same_bits_stopped_and_continued_with_any_number_of_threads(tmp_path, name):
    scene = SCENES[name]
    for place in ("whole", "parts"):
        (tmp_path / place).mkdir()
    write_scene(tmp_path / "whole", scene)
    whole = finish(tmp_path / "whole")
    steps = round(scene["time"]["production"] / scene["time"]["step"])
    write_scene(tmp_path / "parts", with_steps(scene, steps // 2))
    finish(tmp_path / "parts", threads=2)
    write_scene(tmp_path / "parts", scene)
    parts = finish(tmp_path / "parts")
    require_same_results(parts, whole)
    rods = rods_of(whole)
    there = np.isfinite(rods["position"][..., 2])
    assert not rods["position"][there][:, 2].any() and not rods["orientation"][there][:, 2].any()


def test_rods_in_a_disc_stay_inside_and_push_on_it(tmp_path):
    scene = SCENES["disc"]
    write_scene(tmp_path, scene)
    folder = finish(tmp_path)
    rods = rods_of(folder)
    half = 0.5 * scene["rods"]["length"] * rods["orientation"]
    middle, radius = 0.5 * rods["edges"], 0.5 * rods["edges"][0]
    for ends in (rods["position"] - half, rods["position"] + half):
        assert np.linalg.norm(ends - middle, axis=2).max() < radius - 0.5 + 0.2
    summary = json.loads((folder / "summary.json").read_text())
    assert summary["wall_pressure"]["unit"] == "kT D-2" and summary["wall_pressure"]["mean"] > 0.0
