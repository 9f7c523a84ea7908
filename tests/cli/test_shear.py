"""Sheared rods: what is refused, the same bits for every way to the end, and files that know how the copies are displaced."""

import json

import h5py
import numpy as np
import pytest

from jostle_command import (BAD_INPUT, DONE, RODS, changed, command, finish, require_one_line, require_refused,
                            require_same_results, with_steps, write_scene)

# Copies slide by more than a whole edge: a jump of the offset is among the steps.
SHEARED = changed(RODS, box={"volume_fraction": None, "edges": [7.0, 7.0, 5.0]}, flow={"shear_rate": 0.75})
OSCILLATING = changed(SHEARED, flow={"shear_rate": None, "strain_amplitude": 0.6, "frequency": 0.25, "start_strain": 0.3})
FIELDS = changed(SHEARED, output={"field_every": 10, "field_spacing": 1.0})
SCENES = {"steady": SHEARED, "oscillating": OSCILLATING, "back": changed(SHEARED, flow={"shear_rate": -0.75}), "fields": FIELDS}

# What is refused, with the key that the message names and some of its words.
REFUSED = [
    (changed(SHEARED, flow={"strain_amplitude": 0.1, "frequency": 1.0}), "flow.strain_amplitude", "one of the two"),
    (changed(SHEARED, flow={"shear_rate": None, "strain_amplitude": 0.1}), "flow.frequency", "is missing"),
    (changed(SHEARED, flow={"frequency": 0.1}), "flow.frequency", "Set strain_amplitude"),
    (changed(SHEARED, flow={"start_strain": -0.1}), "flow.start_strain", "at least 0"),
    (changed(SHEARED, flow={"shear_rate": "fast"}), "flow.shear_rate", "number"),
    (changed(SHEARED, box={"periodic": [True, False, True]}), "box.periodic", "[true, true, true]"),
    (changed(SHEARED, box={"periodic": [False, True, False]}), "box.periodic", "[true, true, false]"),
    (changed(SHEARED, box={"periodic": [True, False, True]}, walls={"faces": [False, True, False]}), "box.periodic", "no wall could drive a flow"),
    (changed(SHEARED, growth={"rate": 0.1, "division_length": 5.0}), "flow.shear_rate", "[growth]"),
    (changed(SHEARED, motion={"self_propulsion": 1.0}), "flow.shear_rate", "self_propulsion"),
    (changed(OSCILLATING, motion={"self_propulsion": 1.0}), "flow.strain_amplitude", "self_propulsion"),
    (changed(SHEARED, mobility={"model": "hydrodynamic"}), "flow.shear_rate", "hydrodynamic"),
    (changed(SHEARED, forces={"on_rods": [1.0, 0.0, 0.0], "drift": True}), "flow.shear_rate", "forces.on_rods"),
    (changed(SHEARED, forces={"alignment_energy": 1.0}), "flow.shear_rate", "alignment_energy"),
    (changed(SHEARED, schedule={"edges": [[1.0, [7.0, 7.0, 4.9]]]}), "schedule.edges", "shears it"),
    (changed(SHEARED, box={"edges": [7.0, 5.9, 6.0]}), "box.edges", "edge y 5.9 long"),
    (changed(SHEARED, box={"edges": [5.9, 7.0, 6.0]}), "box.edges", "at least 6"),
    (changed(SHEARED, flow={"shear_rate": 6.0}), "flow.shear_rate", "a step of at most"),
    (changed(SHEARED, flow={"shear_rate": 3.0}, motion={"brownian": False}), "flow.shear_rate", "a step of at most"),
]


@pytest.mark.parametrize("scene, key, words", REFUSED, ids=[f"{key}-{k}" for k, (_, key, _) in enumerate(REFUSED)])
def test_flows_that_do_not_go_together_with_the_scene_are_refused_in_one_line(tmp_path, scene, key, words):
    require_refused(tmp_path, scene, key, words)


@pytest.mark.parametrize("name", SCENES)
def test_threads_and_stops_change_no_bit(tmp_path, name):
    for part in ("whole", "parts"):
        write_scene(tmp_path / part, SCENES[name])
    whole = finish(tmp_path / "whole", threads=2)
    for steps in (40, 60):
        write_scene(tmp_path / "parts", with_steps(SCENES[name], steps))
        finish(tmp_path / "parts")
    write_scene(tmp_path / "parts", SCENES[name])
    require_same_results(finish(tmp_path / "parts"), whole, same_command=False)


def test_a_rate_of_0_is_no_flow(tmp_path):
    still = {**SHEARED, "flow": {"shear_rate": 0.0}}
    without = {key: table for key, table in SHEARED.items() if key != "flow"}
    write_scene(tmp_path / "still", still)
    write_scene(tmp_path / "without", without)
    assert (finish(tmp_path / "still") / "series.csv").read_bytes() == (finish(tmp_path / "without") / "series.csv").read_bytes()


def test_a_run_of_another_rate_does_not_go_on(tmp_path):
    write_scene(tmp_path, with_steps(SHEARED, 40))
    finish(tmp_path)
    write_scene(tmp_path, changed(SHEARED, flow={"shear_rate": 0.7}))
    result = command(tmp_path, "run", "scene.toml", "--out", "run")
    assert result.returncode == BAD_INPUT
    require_one_line(result, "flow.shear_rate")


def test_frames_know_how_the_copies_are_displaced(tmp_path):
    write_scene(tmp_path, changed(SHEARED, motion={"brownian": False}, rods={"count": 20}, box={"edges": [14.0, 14.0, 14.0]}))
    folder = finish(tmp_path)
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        edges, time = rods["box/edges/value"][()], rods["position/time"][()]
        assert edges.shape == (len(time), 3, 3)
        assert np.allclose(edges - np.eye(3) * 14.0, edges[:, 1, 0][:, None, None] * np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0]]))
        offset = edges[:, 1, 0]
        assert np.allclose(offset, (0.75 * time * 14.0 + 7.0) % 14.0 - 7.0, atol=1e-5) and (np.diff(offset) < 0).any()
        order = np.argsort(rods["id/value"][()], axis=1)
        centre, image = (np.take_along_axis(rods[name + "/value"][()], order[:, :, None], 1) for name in ("position", "image"))
    place = centre + np.einsum("tni,tij->tnj", image, edges)
    flow = place[0] + 0.75 * (time - time[0])[:, None, None] * place[0, :, 1][:, None] * np.array([1, 0, 0])
    touched = np.abs(place - flow).max(axis=(0, 2)) > 1e-3  # the flow takes some rods against others
    assert np.abs(place - flow)[:, ~touched].max() < 1e-4 and touched.mean() < 0.7


def test_contacts_know_how_the_copies_are_displaced(tmp_path):
    """From one centre line to the other, across the faces: the normal times the diameter, but for what a step moves rods by after."""
    write_scene(tmp_path, changed(with_steps(SHEARED, 200), output={"trajectory_every": 5}))
    folder = finish(tmp_path)
    contacts = np.genfromtxt(folder / "contacts.csv", delimiter=",", names=True)
    with h5py.File(folder / "trajectory.h5") as file:
        rods = file["particles/rods"]
        frames = dict(zip(rods["position/step"][()], zip(*(rods[name + "/value"][()] for name in ("id", "position", "orientation")))))
    apart, far = [], []
    for row in contacts[np.isin(contacts["step"], list(frames))]:
        ids, centre, axis = frames[int(row["step"])]
        i, j = (int(np.flatnonzero(ids == row[name])[0]) for name in ("id_i", "id_j"))
        image = np.array([row[f"image_{k}"] for k in "xyz"])
        copy = image * [7.0, 7.0, 5.0] + [image[1] * row["offset"], 0.0, 0.0]
        line = centre[j] + row["arm_j"] * axis[j] + copy - centre[i] - row["arm_i"] * axis[i]
        normal = np.array([row[f"normal_{k}"] for k in "xyz"])
        apart.append(np.abs(line - normal).max())
        far.append(image[1] != 0.0)
    apart, far = np.array(apart), np.array(far)
    # A rod that was wrapped at the end of its step is an edge from where it was.
    assert far.sum() > 30 and (apart[far] < 0.25).mean() > 0.8 and (apart < 0.25).mean() > 0.9


def test_a_run_from_a_sheared_one_begins_in_its_box(tmp_path):
    write_scene(tmp_path, SHEARED)
    finish(tmp_path)
    strain = 0.75 * 2.0
    going_on = changed(SHEARED, rods={"count": None, "start": "run", "run": "run"}, flow={"start_strain": strain})
    write_scene(tmp_path, going_on, "next.toml")
    assert command(tmp_path, "run", "next.toml", "--out", "next").returncode == DONE
    assert np.genfromtxt(tmp_path / "next/series.csv", delimiter=",", names=True)["strain"][0] == pytest.approx(strain + 5 * 0.02 * 0.75)
    for other in ({}, {"start_strain": 0.2}):
        write_scene(tmp_path, changed(going_on, flow={"start_strain": None, **other}), "other.toml")
        result = command(tmp_path, "check", "other.toml")
        assert result.returncode == BAD_INPUT
        require_one_line(result, "flow.start_strain")
        assert "0.5" in result.stderr


def test_the_summary_tells_viscosity_and_no_equilibrium(tmp_path):
    write_scene(tmp_path, SHEARED)
    folder = finish(tmp_path)
    summary = json.loads((folder / "summary.json").read_text())
    flow, checks = summary["flow"], summary["checks"]
    assert set(checks) == {"torque_ratio", "torque_identity"}
    rows = np.genfromtxt(folder / "series.csv", delimiter=",", names=True)
    total_xy = 0.5 * (rows["stress_xy"] + rows["stress_yx"]) + rows["stress_orientation_xy"]
    assert flow["viscosity"]["mean"] == pytest.approx(-total_xy.mean() / 0.75)
    total = {k: rows[f"stress_{k}"] + rows[f"stress_orientation_{k}"] for k in ("xx", "yy", "zz")}
    assert flow["N1"]["mean"] == pytest.approx((total["yy"] - total["xx"]).mean())
    assert flow["N2"]["mean"] == pytest.approx((total["zz"] - total["yy"]).mean())
    assert flow["strain"] == pytest.approx(1.5) and "fluid's own viscosity" in flow["viscosity"]["definition"]
    assert np.allclose(rows["strain"], 0.75 * rows["time"])
    sides = [checks["torque_identity"][side] for side in ("measured", "in_steady_flow")]
    assert np.isfinite(sides).all() and sides[1][1] < 0.0


def test_moduli_of_an_oscillating_flow(tmp_path):
    write_scene(tmp_path, changed(OSCILLATING, flow={"strain_amplitude": 0.1, "frequency": 1.0}, time={"production": 6.0}))
    result = command(tmp_path, "run", "scene.toml", "--out", "run")
    assert result.returncode == DONE and "loss modulus" in result.stdout
    flow = json.loads((tmp_path / "run/summary.json").read_text())["flow"]
    assert flow["periods"] == 6 and "viscosity" not in flow
    assert np.isfinite(flow["storage_modulus"]["mean"]) and flow["loss_modulus"]["mean"] > 0.0
    assert flow["loss_modulus"]["standard_error"] is None  # of six periods
