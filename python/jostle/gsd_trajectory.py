"""Reading GSD: rods of `jostle export`, of `Simulation.record`, and of other programs that follow the same schema."""

import os
from collections.abc import Sequence
from operator import index
from pathlib import Path

import numpy as np

from ._jostle import refuse
from .trajectory import Frame


def require_gsd(path):
    """The module gsd.hoomd, for a file that is to be read or written. Raises InputError where it is not there."""
    try:
        import gsd.hoomd
    except ImportError:
        refuse("", "", "needs the package gsd, which is not there", suggestion="Run: apt-get install python3-gsd, or take H5MD (.h5)", file=str(path))
    return gsd.hoomd


class GsdTrajectory(Sequence):
    """Frames of a GSD file, read one by one when they are asked for; the box counts as periodic in all directions.

    Rods lie along the z axis of their own; lengths come from log/particles/length, else from shapes with two vertices, else they are 0;
    ids from log/particles/id, else they are 0, 1, 2, ...; times from log/time, else they are the steps. Rods of a type "fixed ...", which
nothing moves, are left out.
    """

    def __init__(self, path):
        hoomd = require_gsd(path)
        from .gsd_frames import FIXED, name_in_ascii
        self._fixed = FIXED
        self.path = Path(path)
        try:
            with name_in_ascii(self.path, os.O_RDONLY) as name:
                self._file = hoomd.open(name, "rb")
        except (OSError, RuntimeError) as error:
            refuse("", "", f"cannot be read: {' '.join(str(error).split())}", file=str(path))

    def __len__(self):
        return len(self._file)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return [self[m] for m in range(*k.indices(len(self)))]
        return self._frame(range(len(self))[index(k)])

    def _frame(self, k):
        shot = self._file[k]
        rods, log, count = shot.particles, shot.log, shot.particles.N
        edges = np.asarray(shot.configuration.box[:3], float)
        if np.any(shot.configuration.box[4:]):
            refuse("", "", f"frame {k} has a box that leans otherwise than along x, as a flow u(y) makes it", file=str(self.path))
        offset = float(shot.configuration.box[3]) * edges[1]
        ids = np.asarray(log.get("particles/id", np.arange(count)), np.uint64)
        moves = ~np.char.startswith(np.array(rods.types, str)[rods.typeid], self._fixed)
        order = np.argsort(ids, kind="stable")
        order = order[moves[order]]
        time = float(np.ravel(log.get("time", shot.configuration.step))[0])
        return Frame(int(shot.configuration.step), time, edges, (True, True, True), ids[order],
                     (np.asarray(rods.position, float) + 0.5 * (edges + [offset, 0, 0]))[order], _axes(rods.orientation)[order],
                     np.asarray(rods.image, np.int32)[order], _lengths(rods, log)[order], np.asarray(rods.diameter, float)[order], offset)


def _axes(quaternion):
    """Where the quaternions (N, 4) turn +z to: unit vectors (N, 3)."""
    w, x, y, z = np.asarray(quaternion, float).T
    axis = np.stack((2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z), axis=1)
    return axis / np.linalg.norm(axis, axis=1, keepdims=True)


def _lengths(rods, log):
    if "particles/length" in log:
        return np.asarray(log["particles/length"], float)
    of_type = [float(np.linalg.norm(np.subtract(*shape["vertices"]))) if len(shape.get("vertices", ())) == 2 else 0.0
               for shape in rods.type_shapes or [{}] * len(rods.types)]
    return np.array(of_type)[rods.typeid]
