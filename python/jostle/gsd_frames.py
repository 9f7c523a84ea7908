"""GSD, schema hoomd 1.4: OVITO draws the rods as spherocylinders, freud reads them. Needs NumPy and gsd alone: `jostle export` writes by
this file, too, without the extension.

A shape belongs to a type there, so rods of one length and diameter are a type. Where a run has more than 64 kinds,
lengths and diameters are drawn in classes of equal width; the exact ones stand in log/particles/length and particles/diameter.
Rods that nothing moves follow those that move, as types "fixed ...", with the id -1.
"""

import contextlib
import dataclasses
import os

import gsd.fl
import gsd.hoomd
import numpy as np

APPLICATION = "jostle export"
MOST_TYPES = 64
FIXED = "fixed "     # types of rods that nothing moves begin so
MOST_DIAMETERS = 8  # where there are too many kinds of rods; leaves 8 classes of length


def is_ours(path):
    try:
        with name_in_ascii(path, os.O_RDONLY) as name, gsd.fl.open(name=name, mode="rb") as file:
            return file.application == APPLICATION
    except (OSError, RuntimeError):
        return False


@contextlib.contextmanager
def name_in_ascii(path, how):
    """Another name of a file, for gsd, which takes none that is not UTF-8."""
    descriptor = os.open(path, how)
    try:
        yield f"/proc/self/fd/{descriptor}"
    finally:
        os.close(descriptor)


def write(path, trajectory, fixed=None):
    """Writes every frame; float32, to look at and to analyse, never to go on from. fixed: a frame of rods that nothing moves."""
    kinds = Kinds(trajectory)
    kinds_of_fixed = Kinds([fixed], FIXED) if fixed else None
    with (name_in_ascii(path, os.O_RDWR) as name,
          gsd.fl.open(name=name, mode="wb", application=APPLICATION, schema="hoomd", schema_version=[1, 4]) as file):
        frames = gsd.hoomd.HOOMDTrajectory(file)
        for frame in trajectory:
            made = snapshot(frame, kinds)
            if fixed:
                append_fixed(made, snapshot(wrapped(fixed), kinds_of_fixed))
            frames.append(made)


def wrapped(frame):
    """The same rods within the box along periodic directions, where any copy stands for all."""
    inside = np.mod(frame.centre, np.where(frame.periodic, frame.edges, np.inf))
    return dataclasses.replace(frame, centre=np.where(frame.periodic, inside, frame.centre))


def append_fixed(made, fixed):
    """Adds the rods of a snapshot to another one, of the same box."""
    rods, more = made.particles, fixed.particles
    made.configuration.box[:3] = np.maximum(made.configuration.box[:3], fixed.configuration.box[:3])
    more.typeid = more.typeid + len(rods.types)
    rods.types, rods.type_shapes = rods.types + more.types, rods.type_shapes + more.type_shapes
    for name in ("typeid", "diameter", "position", "image", "orientation"):
        setattr(rods, name, np.concatenate((getattr(rods, name), getattr(more, name))))
    rods.N += more.N
    for name in ("particles/length", "particles/id"):
        made.log[name] = np.concatenate((made.log[name], fixed.log[name].astype(made.log[name].dtype)))


def turning_z_to(axis):
    """Unit quaternions (w, x, y, z), (N, 4), that turn +z to the axes (N, 3), by the shortest way."""
    x, y, z = np.asarray(axis, float).T
    turned = np.stack((1.0 + z, -y, x, np.zeros_like(z)), axis=1)
    size = np.linalg.norm(turned, axis=1, keepdims=True)
    downwards = size[:, 0] < 1e-6  # half a turn about any axis across z
    turned[downwards] = (0.0, 1.0, 0.0, 0.0)
    size[downwards] = 1.0
    return (turned / size).astype(np.float32)


def snapshot(frame, kinds):
    made = gsd.hoomd.Snapshot()
    made.configuration.step = frame.step
    made.configuration.dimensions = 2 if frame.edges[2] == 0.0 else 3
    made.configuration.box = [*edges_around(frame), frame.offset / frame.edges[1], 0, 0]
    rods = made.particles
    rods.N = len(frame)
    rods.types, rods.type_shapes = kinds.names, kinds.shapes
    rods.typeid = kinds.of(frame.length, frame.diameter)
    rods.diameter = frame.diameter
    rods.position, rods.image = centred(frame)
    rods.orientation = turning_z_to(frame.axis)
    made.log["time"] = np.array([frame.time])
    made.log["particles/length"] = frame.length.astype(np.float32)
    made.log["particles/id"] = frame.id
    return made


def edges_around(frame):
    """GSD knows no open directions: there the box is made so wide that it holds all rods."""
    farthest = np.abs(frame.centre - 0.5 * frame.edges).max(axis=0, initial=0.0)
    around = 2.0 * farthest + (frame.length + frame.diameter).max(initial=0.0)
    flat = frame.edges == 0.0  # along z, of a flat box
    return np.where(frame.periodic | flat, frame.edges, np.maximum(frame.edges, around))


def centred(frame):
    """Positions in a box around the origin, in [-edge/2, edge/2) where it is periodic, and images."""
    half = (0.5 * frame.edges).astype(np.float32)
    place, image = frame.centre - 0.5 * frame.edges, frame.image.copy()
    if frame.offset != 0.0:  # into the oblique box, whose edge along y leans along x
        beside = np.floor((frame.centre[:, 0] - frame.offset * frame.centre[:, 1] / frame.edges[1]) / frame.edges[0])
        place[:, 0] -= beside * frame.edges[0] + 0.5 * frame.offset
        image[:, 0] += beside.astype(image.dtype)
        return place.astype(np.float32), image
    position = place.astype(np.float32)
    beyond = (position >= half) & frame.periodic  # by rounding to float32
    image[beyond] += 1
    return np.where(beyond, -half, position), image


def shape_of(length, diameter):
    if length == 0.0:
        return {"type": "Sphere", "diameter": diameter}
    return {"type": "ConvexPolyhedron", "rounding_radius": 0.5 * diameter,
            "vertices": [[0.0, 0.0, -0.5 * length], [0.0, 0.0, 0.5 * length]]}


class Kinds:
    """The types of all frames of a trajectory: classes of length times classes of diameter."""

    def __init__(self, trajectory, prefix=""):
        lengths = diameters = np.empty(0)
        for frame in trajectory:
            lengths, diameters = _joined(lengths, frame.length), _joined(diameters, frame.diameter)
        if len(lengths) * len(diameters) > MOST_TYPES:
            diameters = _classes(diameters, MOST_DIAMETERS)
            lengths = _classes(lengths, MOST_TYPES // len(diameters))
        self.lengths, self.diameters = lengths, diameters
        kinds = [(float(length), float(diameter)) for length in lengths for diameter in diameters]
        self.names = [f"{prefix}rod {length:.4g} x {diameter:.4g}" for length, diameter in kinds]
        self.shapes = [shape_of(length, diameter) for length, diameter in kinds]

    def of(self, length, diameter):
        found = _nearest(self.lengths, length) * len(self.diameters) + _nearest(self.diameters, diameter)
        return found.astype(np.uint32)


def _joined(known, values):
    """The different values, ascending; of more than can be types, some, with the outermost among them."""
    found = np.union1d(known, values)
    return found if len(found) <= MOST_TYPES else np.append(found[:MOST_TYPES], found[-1])


def _classes(values, most):
    """The middles of `most` classes of equal width, or the values themselves if there are no more."""
    if len(values) <= most:
        return values
    edges = np.linspace(values[0], values[-1], most + 1)
    return 0.5 * (edges[1:] + edges[:-1])


def _nearest(classes, values):
    return np.searchsorted(0.5 * (classes[1:] + classes[:-1]), values)
