"""Reads a trajectory.h5 as any H5MD reader would, and says what it holds.

    python3 read_h5md.py FILE        prints one JSON object; a departure from H5MD 1.1 is an AssertionError

Needs h5py alone. `read(path)` is what the tests call.
"""

import json
import sys

import h5py
import numpy as np

ROD_ELEMENTS = {"position": 3, "image": 3, "orientation": 3, "length": None, "diameter": None, "id": None}


def check_element(element):
    """An H5MD element: value, step and time of equal length, time the scale of axis 0."""
    step, time, value = element["step"], element["time"], element["value"]
    assert step.dtype.kind == "i" and step.ndim == 1, element.name
    assert step.shape == time.shape == value.shape[:1], element.name
    assert np.all(np.diff(step[()]) > 0) and np.all(np.diff(time[()]) > 0), f"{element.name}: not in order"
    assert value.dims[0][0] == time, f"{element.name}: time is no scale of axis 0"
    return value


def check_metadata(file):
    assert tuple(file["h5md"].attrs["version"]) == (1, 1)
    for name in ("author", "creator"):
        text = h5py.AttributeManager(file[f"h5md/{name}"]).get_id("name").get_type()
        assert not text.is_variable_str(), f"h5md/{name}: H5MD asks for fixed-length strings"
    assert file["h5md/creator"].attrs["name"] == b"jostle"
    assert tuple(file["h5md/modules/units"].attrs["version"]) == (1, 0)


def check_box(rods):
    box = rods["box"]
    assert box.attrs["dimension"] == 3
    boundary = [word.decode() for word in box.attrs["boundary"]]
    assert len(boundary) == 3 and set(boundary) <= {"periodic", "none"}
    edges = box["edges"]
    if isinstance(edges, h5py.Group):
        assert edges["step"] == rods["position/step"] and edges["time"] == rods["position/time"]
        edges = check_element(edges)
    assert edges.shape[-1] == 3 and np.all(edges[()] > 0)
    return boundary, edges[()]


def check_rods(rods):
    frames, rows = rods["position/value"].shape[:2]
    there = rods["id/value"][()] != rods["id/value"].fillvalue
    for name, width in ROD_ELEMENTS.items():
        value = check_element(rods[name])
        assert value.shape == ((frames, rows) if width is None else (frames, rows, width)), name
        assert value.fletcher32, f"{name}: no checksum"
        for shared in ("step", "time"):
            assert rods[name][shared] == rods["position"][shared], f"{name}/{shared} is no hard link"
        assert np.all(np.isfinite(value[()][there])), name
    axis = rods["orientation/value"][()][there]
    assert np.allclose(np.linalg.norm(axis, axis=-1), 1.0, atol=1e-6)
    assert np.all(rods["diameter/value"][()][there] > 0) and np.all(rods["length/value"][()][there] >= 0)
    for frame in range(frames):
        ids = rods["id/value"][frame][there[frame]]
        assert np.all(np.diff(ids) > 0), f"frame {frame}: ids are not in order"
    if "stress_collision" in rods:
        value = check_element(rods["stress_collision"])
        assert value.shape == (frames, rows, 3, 3) and value.fletcher32
        assert rods["stress_collision/step"] == rods["position/step"]
    return [int(count) for count in there.sum(axis=1)]


def read(path):
    """Checks the file at `path` and returns what it holds as a dict."""
    with h5py.File(path, "r") as file:
        check_metadata(file)
        rods = file["particles/rods"]
        counts = check_rods(rods)
        boundary, edges = check_box(rods)
        found = {
            "frames": len(counts),
            "rods": counts,
            "boundary": boundary,
            "edges": edges.tolist(),
            "steps": rods["position/step"][()].tolist(),
            "times": rods["position/time"][()].tolist(),
            "length_unit": rods["position/value"].attrs.get("unit", b"").decode(),
            "time_unit": rods["position/time"].attrs.get("unit", b"").decode(),
            "seed": int(file["parameters/seed"][()]),
            "scene": np.atleast_1d(file["parameters/scene"][()])[0].decode(),
        }
        if "observables" in file:
            assert set(file["observables"]) == {"stress_collision", "stress_orientation"}
            check_element(file["observables/stress_orientation"])
            stress = check_element(file["observables/stress_collision"])
            assert stress.shape[1:] == (3, 3)
            found["stress_unit"] = stress.attrs.get("unit", b"").decode()
            found["stress_mean"] = stress[()].mean(axis=0).tolist()
        return found


if __name__ == "__main__":
    print(json.dumps(read(sys.argv[1])))
