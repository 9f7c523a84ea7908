"""Trajectories that jostle does not make yet: rods that come and go, and many lengths."""

import h5py
import numpy as np

FILL = np.uint64(2**64 - 1)  # -1 as an unsigned number: no rod in this row
EDGES = (10.0, 8.0, 6.0)


def rods(count, seed, lengths=(0.5, 3.0)):
    """Random rods as a dict of arrays, ids from 0; the first points down, the second up."""
    random = np.random.default_rng(seed)
    axis = random.normal(size=(count, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    axis[:2] = ((0.0, 0.0, -1.0), (0.0, 0.0, 1.0))[:count]
    return {"id": np.arange(count, dtype=np.uint64), "position": random.uniform(size=(count, 3)) * EDGES,
            "image": random.integers(-2, 3, size=(count, 3)), "orientation": axis,
            "length": random.uniform(*lengths, count), "diameter": np.ones(count)}


def write(folder, frames):
    """folder/trajectory.h5 with those frames (dicts as of `rods`), times 0, 0.5, 1 ...; rows without a rod hold NaN."""
    folder.mkdir(exist_ok=True)
    most = max(len(frame["id"]) for frame in frames)
    with h5py.File(folder / "trajectory.h5", "w") as file:
        group = file.create_group("particles/rods")
        box = group.create_group("box")
        box.attrs["dimension"] = 3
        box.attrs["boundary"] = np.array([b"periodic", b"periodic", b"none"])
        box["edges"] = np.array(EDGES)
        for name, value in frames[0].items():
            fill, kind = {"id": (FILL, np.uint64), "image": (0, np.int32)}.get(name, (np.nan, np.float32))
            values = np.full((len(frames), most, *value.shape[1:]), fill, dtype=kind)
            for k, frame in enumerate(frames):
                values[k, :len(frame["id"])] = frame[name]
            element = group.create_group(name)
            element.create_dataset("value", data=values, fillvalue=fill)
            element["step"] = 10 * np.arange(len(frames))
            element["time"] = 0.5 * np.arange(len(frames))
    return folder
