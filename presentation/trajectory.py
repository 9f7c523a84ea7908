"""The rods of a trajectory.h5, frame by frame, and what stands around them."""

import dataclasses
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np

from refusal import Refusal
from run_folder import Run
from surroundings import Walls, walls_of

NO_ROD = -1  # id in rows that no rod fills, where the number of rods changes


@dataclass
class Frame:
    """Rods in the order of their ids; lengths in the units of the run."""
    step: int
    time: float
    edges: np.ndarray     # (3) of the box, whose lowest corner is the origin
    periodic: np.ndarray  # (3) bool
    id: np.ndarray        # (N)
    centre: np.ndarray    # (N, 3)
    image: np.ndarray     # (N, 3) box edges crossed
    axis: np.ndarray      # (N, 3) unit vector
    length: np.ndarray    # (N) without the caps
    diameter: np.ndarray  # (N)
    offset: float = 0.0   # of the copies above along y, along x, where a flow shears the box
    pressure: np.ndarray = None  # (N) of the collision stress of each rod, where it was kept; NaN where it is not known
    walls: Walls = field(default_factory=Walls)

    def __len__(self):
        return len(self.id)

    @property
    def held(self):
        """(3) whether the box ends the picture along a direction: where it is periodic, or ends at walls."""
        return self.periodic | self.walls.end()

    @property
    def dimensions(self):
        """2 of a flat box, whose rods are in the plane z = 0; else 3."""
        return 3 if self.edges[2] else 2

    def unwrapped(self):
        """(N, 3) centres as if no rod had been taken back into the box."""
        copies = self.image * self.edges
        copies[:, 0] += self.image[:, 1] * self.offset
        return self.centre + copies

    def ends(self):
        """Centres of the two caps, (N, 2, 3): tail and head."""
        half = 0.5 * self.length[:, None] * self.axis
        return np.stack((self.centre - half, self.centre + half), axis=1)


class Trajectory:
    """A file that is open for reading; iteration gives its frames. `path`: a file in place of that of the folder."""

    def __init__(self, folder, path=None):
        self.path = Path(path) if path else folder / "trajectory.h5"
        if not self.path.exists():
            raise _no_trajectory(folder)
        # One in place of the folder's is read as a stream: it may have no name in the file system, which HDF5 asks for.
        self._rods = self._read(lambda: h5py.File(open(path, "rb") if path else self.path, "r")["particles/rods"])
        self.steps = self._read(lambda: self._rods["position/step"][()])
        self.times = self._read(lambda: self._rods["position/time"][()])
        if len(self.steps) == 0:
            raise Refusal(self.path, "it has no frame")
        run = Run(folder)
        self.walls = walls_of(run.scene) if (folder / "resolved.toml").exists() else Walls()
        self.fixed = self._read(lambda: self._fixed(run.fixed_rods))

    def __len__(self):
        return len(self.steps)

    def counts(self):
        """Numbers of rods, (frames)."""
        return self._read(lambda: np.array([np.count_nonzero(ids.astype(np.int64) != NO_ROD)
                                            for ids in self._rods["id/value"]], int))

    def __iter__(self):
        return (self.frame(k) for k in range(len(self)))

    def frame(self, k):
        return self._read(lambda: self._frame(k))

    def _fixed(self, table):
        """A frame of the rods that nothing moves, all with the id NO_ROD; None where there are none."""
        if not table:
            return None
        def vectors(names):
            return np.column_stack([table[name] for name in names])

        count = len(table["x"])
        return dataclasses.replace(self._frame(0), id=np.full(count, NO_ROD), centre=vectors("xyz"), image=np.zeros((count, 3), np.int32),
                                   axis=vectors(("nx", "ny", "nz")), length=table["length"], diameter=table["diameter"], pressure=None)

    def _frame(self, k):
        rods = self._rods
        ids = rods["id/value"][k].astype(np.int64)  # -1 as an unsigned number becomes -1 too
        there = np.flatnonzero(ids != NO_ROD)
        rows = there[np.argsort(ids[there], kind="stable")]
        edges = rods["box/edges"]
        edges = np.asarray(edges["value"][k] if isinstance(edges, h5py.Group) else edges[()], float)
        edges, offset = (np.diag(edges), float(edges[1, 0])) if edges.ndim == 2 else (edges, 0.0)
        boundary = [word.decode() if isinstance(word, bytes) else word for word in rods["box"].attrs["boundary"]]

        def column(name, kind):
            return rods[f"{name}/value"][k][rows].astype(kind)

        axis = column("orientation", float)
        axis /= np.linalg.norm(axis, axis=1, keepdims=True)
        length, diameter = column("length", float), column("diameter", float)
        pressure = None
        if "stress_collision" in rods:
            virial = np.trace(column("stress_collision", float), axis1=1, axis2=2)
            if edges[2] == 0.0:  # of a flat box: a force over a length
                pressure = virial / 2.0 / (diameter * (length + np.pi / 4.0 * diameter))
            else:
                pressure = virial / 3.0 / (np.pi * diameter**2 * (length / 4.0 + diameter / 6.0))
        return Frame(step=int(self.steps[k]), time=float(self.times[k]), edges=edges, offset=offset,
                     periodic=np.array([word == "periodic" for word in boundary]), id=ids[rows],
                     centre=column("position", float), image=column("image", np.int32), axis=axis,
                     length=length, diameter=diameter, pressure=pressure, walls=self.walls)

    def _read(self, action):
        try:
            return action()
        except (OSError, KeyError, ValueError, RuntimeError) as error:
            problem = " ".join(str(error).split())
            raise Refusal(self.path, f"cannot be read: {problem}", "`jostle verify` tells what is damaged") from None


def _no_trajectory(folder):
    path = folder / "trajectory.h5"
    if (folder / "trajectory.journal").exists():
        return Refusal(path, "there is none yet: it is made when the run stops",
                       "Stop the run with Ctrl-C, or let it end; one that was killed has to go on first: "
                       "run the same command again")
    return Refusal(path, "the run kept no trajectory",
                   "Set output.trajectory_every in the scene, and run it into a new folder")
