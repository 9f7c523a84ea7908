"""What functions of analysis take: the rods at one time, or at many."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ._arrays import array, with_shape
from ._jostle import refuse
from .trajectory import Frame, H5mdTrajectory, JournalTrajectory, open_trajectory

WHAT = "a folder of a run, a trajectory file, jostle.load(...), a list of frames, a Simulation, or a dict of arrays"
_ENDINGS = {".h5": H5mdTrajectory, ".journal": JournalTrajectory}


def frames_of(rods):
    """The frames of a trajectory, as a sequence that can be gone through more than once; see `jostle.analysis`."""
    if isinstance(rods, (str, Path)):
        path = Path(rods)
        if path.suffix in _ENDINGS and path.is_file():
            return _some(_ENDINGS[path.suffix](path), path)
        if path.suffix == ".gsd" and path.is_file():
            from .gsd_trajectory import GsdTrajectory
            return _some(GsdTrajectory(path), path)
        from .run import load
        return _some(load(path).trajectory, path)
    if isinstance(rods, Mapping):
        return _frames_of_arrays(rods)
    if isinstance(rods, Frame):
        return [rods]
    if hasattr(rods, "trajectory"):  # a Run
        return _some(rods.trajectory, rods.folder)
    if hasattr(rods, "clock"):  # a Simulation
        return [_frame_of_simulation(rods)]
    if isinstance(rods, Sequence) and len(rods) > 0 and isinstance(rods[0], Frame):
        return rods
    refuse("rods", f"a {type(rods).__name__}", "are no rods", WHAT)


def _some(trajectory, path):
    if len(trajectory) == 0:
        refuse("", "", "it has no frame", file=str(path))
    return trajectory


def _frame_of_simulation(simulation):
    rods, clock = simulation.rods, simulation.clock
    return Frame(clock.step, clock.time, simulation.edges, simulation.periodic, rods.id, rods.centre, rods.axis, rods.image,
                 rods.length, rods.diameter, simulation.offset)


def _frames_of_arrays(arrays):
    """centre (T, N, 3) or (N, 3), edges (3), of which the last is 0 where all lies in the plane z = 0, and, where they are there, axis, length, diameter, time, periodic."""
    known = ("centre", "axis", "length", "diameter", "edges", "periodic", "time")
    for name in arrays:
        if name not in known:
            refuse(f"rods[{name!r}]", "", "is no array of rods", ", ".join(known))
    for name in ("centre", "edges"):
        if name not in arrays:
            refuse(f"rods[{name!r}]", "", "is missing")
    centre = array("centre", arrays["centre"])
    centre = with_shape("centre", centre if centre.ndim == 3 else centre[None], (None, None, 3))
    shape = centre.shape[:2]
    axis = with_shape("axis", arrays.get("axis", [1.0, 0.0, 0.0]), (*shape, 3), repeat=True)
    size = np.linalg.norm(axis, axis=2)
    if not (abs(size - 1.0) < 1e-3).all():
        refuse("axis", "", "are no unit vectors", "vectors of length 1")
    length, diameter = (with_shape(name, arrays.get(name, default), shape, repeat=True)
                        for name, default in (("length", 0.0), ("diameter", 1.0)))
    edges = with_shape("edges", arrays["edges"], (shape[0], 3), repeat=True)
    flat = (edges[:, 2] == 0).all()
    if not (edges[:, :2 if flat else 3] > 0).all():
        refuse("edges", str(arrays["edges"]), "are not all positive", "lengths above 0, or 0 along z of a box of two dimensions")
    if flat and (centre[..., 2].any() or axis[..., 2].any()):
        refuse("centre", "", "and axes are not all in the plane z = 0, as edges of 0 along z say", "z = 0")
    time = with_shape("time", arrays.get("time", np.arange(shape[0])), shape[:1])
    periodic = np.asarray(arrays.get("periodic", (True, True, True)))
    if periodic.shape != (3,) or periodic.dtype.kind != "b":
        refuse("periodic", str(arrays["periodic"]), "does not say along which directions", "three of True, False")
    if flat:
        periodic = np.append(periodic[:2], False)
    ids, image = np.arange(shape[1], dtype=np.uint64), np.zeros((shape[1], 3), np.int32)
    return [Frame(k, float(time[k]), edges[k], tuple(periodic.tolist()), ids, centre[k], axis[k], image, length[k], diameter[k])
            for k in range(shape[0])]


def second_order(cosine, dimensions):
    """How far directions agree, heads and tails alike: (3 cos^2 - 1)/2, in the plane cos of twice the angle."""
    return (dimensions * cosine**2 - 1.0) / (dimensions - 1)


@dataclass
class Paths:
    """Where rods went: time (T); position (T, N, 3), unwrapped; axis (T, N, 3). NaN where a rod is not there. In 2 or 3 dimensions."""
    time: np.ndarray
    position: np.ndarray
    axis: np.ndarray
    dimensions: int


def paths_of(rods):
    """Paths of all rods that are in any frame, in the order of their ids."""
    frames = list(frames_of(rods))
    if len(frames) < 2:
        refuse("rods", f"{len(frames)} frame", "cannot show how rods move", "at least two frames")
    ids = np.unique(np.concatenate([frame.id for frame in frames]))
    time = np.array([frame.time for frame in frames])
    if not (np.diff(time) > 0).all():
        refuse("time", "", "does not rise from frame to frame")
    position, axis = np.full((2, len(frames), len(ids), 3), np.nan)
    for k, frame in enumerate(frames):
        rows = np.searchsorted(ids, frame.id)
        position[k, rows], axis[k, rows] = frame.unwrapped, frame.axis
    return Paths(time, position, axis / np.linalg.norm(axis, axis=2, keepdims=True), frames[0].dimensions)


@dataclass
class Lags:
    """Pairs of frames by the time between them: time (lags); earlier and later, lists of (pairs) arrays of frames."""
    time: np.ndarray
    earlier: list
    later: list


MOST_LAGS, MOST_ORIGINS = 200, 500


def lags_of(time):
    """Evenly spaced frames: every time between two of them, of more than 200 some 200 that thin out; means over up to 500 beginnings.
    Else: from the first frame to all others."""
    count, step = len(time), np.diff(time)
    if step.max() - step.min() > 1e-6 * step.mean():
        return Lags(time[1:] - time[0], [np.array([0])] * (count - 1), [np.array([k]) for k in range(1, count)])
    lags = np.arange(1, count)
    if len(lags) > MOST_LAGS:
        lags = np.unique(np.round(np.geomspace(1, count - 1, MOST_LAGS)).astype(int))
    earlier = [np.unique(np.linspace(0, count - 1 - lag, min(count - lag, MOST_ORIGINS)).astype(int)) for lag in lags]
    return Lags(lags * step.mean(), earlier, [begin + lag for begin, lag in zip(earlier, lags)])


def mean_over_rods(values):
    """Mean and standard error of (pairs, N) values, NaN where a rod is not there: the rods, each the mean over its pairs, are taken for
    independent."""
    there = np.isfinite(values)
    pairs = there.sum(axis=0)
    sums = np.where(there, values, 0.0).sum(axis=0)[pairs > 0]
    pairs = pairs[pairs > 0]
    if len(pairs) == 0:
        return np.nan, np.nan
    mean = sums.sum() / pairs.sum()
    if len(pairs) == 1:
        return mean, np.nan
    scatter = ((sums - mean * pairs)**2).sum() / pairs.sum()**2  # of a ratio of sums
    return mean, np.sqrt(scatter * len(pairs) / (len(pairs) - 1))
