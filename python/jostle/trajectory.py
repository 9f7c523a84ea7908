"""Frames of a trajectory."""

from collections.abc import Sequence
from dataclasses import dataclass
from operator import index

import numpy as np

from . import _jostle
from ._jostle import refuse

_NO_ROD = np.uint64(2**64 - 1)  # id in rows that no rod fills, where the number of rods changes
_DATASETS = {"centre": "position", "axis": "orientation", "image": "image", "length": "length", "diameter": "diameter"}


@dataclass(frozen=True)
class Frame:
    """The rods at one time, in the order of their ids; single precision, to look at and to analyse.

    step, time; edges (3), length, the last 0 of a flat box; periodic (3); offset, length: the copies above along y are
    displaced by it along x, where a flow shears the box
    id (N), uint64; centre (N, 3), length, inside the box along periodic directions; image (N, 3), box edges crossed;
    axis (N, 3), unit vectors; length, diameter (N), length
    stress_collision, stress_orientation (N, 3, 3), energy: with `output.stress_per_rod` each rod's part of the stress of
    this step times the volume; None without it, and while trajectory.h5 is not made yet
    """
    step: int
    time: float
    edges: np.ndarray
    periodic: tuple
    id: np.ndarray
    centre: np.ndarray
    axis: np.ndarray
    image: np.ndarray
    length: np.ndarray
    diameter: np.ndarray
    offset: float = 0.0
    stress_collision: np.ndarray | None = None
    stress_orientation: np.ndarray | None = None

    def __len__(self):
        return len(self.id)

    @property
    def dimensions(self):
        """2 of a flat box, whose rods are in the plane z = 0; else 3."""
        return 3 if self.edges[2] else 2

    @property
    def volume(self):
        """Of the box; of a flat box its area."""
        return float(np.prod(self.edges[:self.dimensions]))

    @property
    def closed(self):
        """Whether the box is periodic along every direction that it has."""
        return all(self.periodic[:self.dimensions])

    @property
    def unwrapped(self):
        """(N, 3) array, length: centres as if the box had no edges."""
        copies = self.image * self.edges
        copies[:, 0] += self.image[:, 1] * self.offset
        return self.centre + copies


def open_trajectory(folder):
    """trajectory.h5 of a run that has stopped, by h5py; or its journal, of one that goes on or was killed."""
    if (folder / "trajectory.h5").exists():
        return H5mdTrajectory(folder / "trajectory.h5")
    if (folder / "trajectory.journal").exists():
        return JournalTrajectory(folder / "trajectory.journal")
    refuse("", "", "the run kept no trajectory",
           suggestion="Set output.trajectory_every in the scene, and run it into a new folder",
           file=str(folder / "trajectory.h5"))


class H5mdTrajectory(Sequence):
    """Frames of an H5MD file, read one by one when they are asked for.

    steps, times : (frames) arrays
    """

    def __init__(self, path):
        import h5py
        self.path = path
        self._rods = self._read(lambda: h5py.File(path, "r")["particles/rods"])
        self.steps = self._read(lambda: self._rods["position/step"][()])
        self.times = self._read(lambda: self._rods["position/time"][()])

    def __len__(self):
        return len(self.steps)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return [self[m] for m in range(*k.indices(len(self)))]
        k = range(len(self))[index(k)]
        return self._read(lambda: self._frame(k))

    def _frame(self, k):
        rods = self._rods
        ids = rods["id/value"][k].astype(np.uint64)
        there = np.flatnonzero(ids != _NO_ROD)
        rows = there[np.argsort(ids[there], kind="stable")]
        edges = rods["box/edges"]
        edges = np.asarray(edges["value"][k] if hasattr(edges, "keys") else edges[()], float)
        edges, offset = (np.diag(edges), float(edges[1, 0])) if edges.ndim == 2 else (edges, 0.0)
        boundary = [word.decode() if isinstance(word, bytes) else word for word in rods["box"].attrs["boundary"]]
        columns = {name: rods[f"{dataset}/value"][k][rows] for name, dataset in _DATASETS.items()}
        columns |= {name: rods[f"{name}/value"][k][rows] for name in ("stress_collision", "stress_orientation") if name in rods}
        return Frame(step=int(self.steps[k]), time=float(self.times[k]), edges=edges, offset=offset,
                     periodic=tuple(word == "periodic" for word in boundary), id=ids[rows], **columns)

    def _read(self, action):
        try:
            return action()
        except (OSError, KeyError, ValueError, RuntimeError) as error:
            refuse("", "", f"cannot be read: {' '.join(str(error).split())}",
                   suggestion="`jostle verify` tells what is damaged", file=str(self.path))


class JournalTrajectory(Sequence):
    """Frames of a run that goes on, or was killed: every look at one reads the journal from its beginning."""

    def __init__(self, path):
        self.path = path

    def __iter__(self):
        reader = _jostle.JournalReader(str(self.path))
        while (found := reader.next()) is not None:
            step, time, edges, periodic, offset, columns = found
            yield Frame(step, time, edges, periodic, offset=offset, **columns)

    def __len__(self):
        return sum(1 for _ in self)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return list(self)[k]
        k = range(len(self))[index(k)]
        return next(frame for number, frame in enumerate(self) if number == k)

    @property
    def steps(self):
        return np.array([frame.step for frame in self])

    @property
    def times(self):
        return np.array([frame.time for frame in self])
