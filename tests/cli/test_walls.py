"""Boxes with walls: what is refused, the same bits for every way to the end, what is written, and that all that moves stays inside."""

import json

import h5py
import numpy as np
import pytest

from jostle_command import (RODS, changed, command, finish, require_one_line, require_refused, require_same_results,
                            with_steps, write_scene)

SLIT = changed(RODS, box={"volume_fraction": None, "edges": [7.0, 7.0, 9.0], "periodic": [True, True, False]},
               walls={"faces": [False, False, True]})
CAVITY = changed(RODS, box={"shape": [1.0, 1.0, 1.0], "periodic": [False, False, False]}, walls={"container": "sphere"})
TUBE = changed(RODS, box={"shape": [2.0, 1.0, 1.0], "periodic": [True, False, False]}, walls={"container": "tube"})
SWIMMERS = changed(CAVITY, motion={"self_propulsion": 2.0})
CELLS = {"seed": 3, "box": {"edges": [6.0, 6.0, 9.0], "periodic": [False, False, False]}, "walls": {"container": "tube", "axis": "z"},
         "rods": {"count": 6, "length": 1.0}, "motion": {"brownian": False}, "growth": {"rate": 0.5, "division_length": 3.0},
         "time": {"step": 0.01, "production": 4.0}, "output": {"series_every": 10, "trajectory_every": 50}}
SCENES = {"slit": SLIT, "cavity": CAVITY, "tube": TUBE, "swimmers": SWIMMERS, "cells": CELLS,
          "rows in a cavity": changed(CAVITY, rods={"start": "lattice"})}

# What is refused, with the key that the message names and some of its words.
REFUSED = [
    (changed(SLIT, box={"periodic": [True, True, True]}), "box.periodic", "end at walls"),
    (changed(CAVITY, box={"periodic": [True, False, False]}), "box.periodic", "end at walls"),
    (changed(TUBE, walls={"faces": [False, True, False]}), "walls.faces", "tube"),
    (changed(CAVITY, walls={"faces": [True, False, False]}), "walls.faces", "sphere"),
    (changed(CAVITY, box={"shape": [1.0, 1.0, 1.2]}), "box.shape", "round sphere"),
    (changed(TUBE, box={"shape": [2.0, 1.0, 1.1]}), "box.shape", "round tube"),
    (changed(CAVITY, box={"volume_fraction": 0.6}, rods={"start": "lattice"}), "rods.start", "of touching rods it holds"),
    (changed(CAVITY, box={"volume_fraction": None, "shape": None, "edges": [2.9, 2.9, 2.9]}, rods={"count": 1}), "rods.length", "1.9"),
    (changed(SLIT, rods={"start": "aligned", "axis": [0.0, 0.0, 1.0], "length": 8.5, "count": 2}), "rods.axis", "along z"),
    (changed(SLIT, box={"edges": [20.0, 20.0, 1.05]}, rods={"count": 10, "length": 0.0}), "box.edges", "a step of at most"),
    (changed(CAVITY, mobility={"model": "hydrodynamic"}), "mobility.model", "beside walls"),
    (changed(RODS, walls={"torque": False}), "walls.torque", "without walls"),
    (changed(SLIT, walls={"axis": "y"}), "walls.axis", "without a tube"),
    (changed(SLIT, walls={"container": "cylinder"}), "walls.container", "tube"),
]


@pytest.mark.parametrize("scene, key, words", REFUSED, ids=[f"{key}-{k}" for k, (_, key, _) in enumerate(REFUSED)])
def test_walls_that_do_not_go_together_with_the_scene_are_refused_in_one_line(tmp_path, scene, key, words):
    require_refused(tmp_path, scene, key, words)


def test_cells_that_would_grow_longer_than_a_cavity_are_refused(tmp_path):
    cells = changed(CELLS, box={"edges": [6.0, 6.0, 6.0]}, walls={"container": "sphere", "axis": None}, growth={"division_length": 5.5})
    require_refused(tmp_path, cells, "growth.division_length")


def test_a_rod_of_a_file_beyond_a_wall_is_named(tmp_path):
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz\n3,3,3,1,0,0\n3,5,0.4,1,0,0\n")
    write_scene(tmp_path, changed(SLIT, rods={"count": 2, "start": "file", "file": "rods.csv"}))
    result = command(tmp_path, "check", "scene.toml")
    require_one_line(result, "rods.file")
    assert "rod 1" in result.stderr and "beyond a wall by 0.1" in result.stderr


@pytest.mark.parametrize("name", SCENES)
def test_rods_stay_inside_and_walls_are_pushed_outwards(tmp_path, name):
    scene = SCENES[name]
    write_scene(tmp_path, scene)
    folder = finish(tmp_path)
    rows = np.genfromtxt(folder / "series.csv", delimiter=",", names=True)
    forces = np.sum([rows[column] for column in rows.dtype.names if column.startswith("wall_force")], axis=0)
    assert forces.min() >= 0.0 and forces.max() > 0.0
    assert np.isnan(rows["Z"]).all() and "Z" not in json.loads((folder / "summary.json").read_text())
    with h5py.File(folder / "trajectory.h5") as file:
        assert beyond_walls(file["particles/rods"], scene["walls"]) < 0.2


def beyond_walls(rods, walls):
    """How far the ends of the rods of all frames reach beyond a wall, at most."""
    there = rods["id/value"][()] != rods["id/value"].fillvalue
    centre, axis, length, diameter = (rods[f"{name}/value"][()][there] for name in ("position", "orientation", "length", "diameter"))
    edges = rods["box/edges"][()]
    ends = np.concatenate([centre + sign * 0.5 * length[:, None] * axis for sign in (-1, 1)])
    distance = np.full(len(ends), np.inf)
    for k, faces in enumerate(walls.get("faces", [False] * 3)):
        if faces:
            distance = np.minimum(distance, np.minimum(ends[:, k], edges[k] - ends[:, k]))
    if "container" in walls:
        across = [k for k in range(3) if walls["container"] == "sphere" or "xyz"[k] != walls.get("axis", "x")]
        middle = 0.5 * edges[across]
        distance = np.minimum(distance, middle[0] - np.linalg.norm(ends[:, across] - middle, axis=1))
    return (0.5 * np.concatenate([diameter, diameter]) - distance).max()


@pytest.mark.parametrize("name", SCENES)
def test_threads_and_stops_change_no_bit(tmp_path, name):
    for part in ("whole", "parts"):
        write_scene(tmp_path / part, SCENES[name])
    whole = finish(tmp_path / "whole", threads=2)
    steps = round(SCENES[name]["time"]["production"] / SCENES[name]["time"]["step"])
    write_scene(tmp_path / "parts", with_steps(SCENES[name], steps // 2 // 20 * 20))
    finish(tmp_path / "parts")
    write_scene(tmp_path / "parts", SCENES[name])
    require_same_results(finish(tmp_path / "parts"), whole, same_command=False)


def test_contacts_name_their_wall(tmp_path):
    write_scene(tmp_path, SLIT)
    folder = finish(tmp_path)
    rows = np.genfromtxt(folder / "contacts.csv", delimiter=",", names=True)
    assert set(rows["wall"]) == {-1.0, 4.0, 5.0}
    at_wall = rows[rows["wall"] >= 0]
    assert (at_wall["id_i"] == at_wall["id_j"]).all()
    assert np.array_equal(at_wall["normal_z"], np.where(at_wall["wall"] == 4, 1.0, -1.0))
    series = np.genfromtxt(folder / "series.csv", delimiter=",", names=True)
    assert np.allclose(series["wall_pressure_z"], (series["wall_force_z_lower"] + series["wall_force_z_upper"]) / (2 * 49.0))
