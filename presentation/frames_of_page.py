"""The rods of a run as the page holds them: 16-bit numbers in columns, packed.

A column is told by its kind (u1, u2) and the element of the page that has it: base64 of a zlib stream, inside it all low
bytes of the numbers, then all high ones. Positions are parts of the extent of all frames, axes points of a folded octahedron.
"""

import base64
import zlib

import numpy as np

BYTES_OF_ROD = 10         # positions and axis; lengths, speeds and the like come on top
MEGABYTE = 10**6
TOP = 65535
UNKNOWN = TOP             # of columns that may have no value


class Packed:
    """Columns of rods (or of lines of force) by frame; `elements` are the texts that belong into the page."""

    def __init__(self, name, times, counts):
        self.name = name
        self.told = {"times": [float(time) for time in times], "counts": [int(count) for count in counts], "columns": {}}
        self.elements = {}

    def add(self, name, values):
        element = f"{self.name}-{name}"
        planes = np.ascontiguousarray(values).view(np.uint8).reshape(len(values), -1).T
        self.elements[element] = base64.b64encode(zlib.compress(planes.tobytes(), 6)).decode()
        self.told["columns"][name] = {"kind": f"u{values.dtype.itemsize}", "element": element}

    def add_varying(self, name, values):
        """A column between its least and greatest value; one number if these are the same."""
        least, greatest = float(values.min(initial=np.inf)), float(values.max(initial=-np.inf))
        if not least <= greatest:
            least = greatest = 0.0
        if least < greatest:
            self.add(name, between(values, least, greatest))
        self.told[name] = [least, greatest - least]


def between(values, least, greatest, top=TOP):
    """Numbers 0 to `top` for values from least to greatest."""
    share = (np.asarray(values, float) - least) / ((greatest - least) or 1.0)
    return np.rint(np.clip(share, 0.0, 1.0) * top).astype(np.uint16)


def with_unknown(values, least, greatest):
    """The same up to 65534; 65535 where there is no number."""
    known = np.isfinite(values)
    return np.where(known, between(np.where(known, values, least), least, greatest, TOP - 1), UNKNOWN).astype(np.uint16)


def folded(axis):
    """Two 16-bit numbers of unit vectors (N, 3): the sphere on an octahedron, that unfolded into a square."""
    x, y, z = (axis / np.abs(axis).sum(axis=1, keepdims=True)).T
    below = z < 0.0
    sign = [np.where(values < 0.0, -1.0, 1.0) for values in (x, y)]
    a = np.where(below, (1.0 - np.abs(y)) * sign[0], x)
    b = np.where(below, (1.0 - np.abs(x)) * sign[1], y)
    return between(a, -1.0, 1.0), between(b, -1.0, 1.0)


def chosen_frames(counts, megabytes):
    """Numbers of the frames that fit into the limit: the first, the last, and evenly between; the last alone if need be."""
    room = megabytes * MEGABYTE * 3 / 4 / BYTES_OF_ROD  # rods of all frames
    frames = len(counts)
    for shown in range(frames, 1, -1):
        chosen = np.unique(np.rint(np.linspace(0, frames - 1, shown)).astype(int))
        if counts[chosen].sum() <= room:
            return chosen
    return np.array([frames - 1])


def packed_lines(name, times, lines, thickness, extent):
    """lines: (K, 2, 3) ends of each frame; thickness: of all, or (K in all) of each."""
    packed = Packed(name, times, [len(of_frame) for of_frame in lines])
    ends = np.concatenate(lines)
    along = ends[:, 1] - ends[:, 0]
    length = np.linalg.norm(along, axis=1)
    _add_places(packed, ends.mean(axis=1), along / length[:, None], extent)
    packed.add_varying("length", length)
    packed.add_varying("diameter", np.broadcast_to(thickness, len(ends)))
    return packed


def _add_places(packed, centre, axis, extent):
    low, high = extent
    for k, name in enumerate("xyz"):
        packed.add(name, between(centre[:, k], low[k], high[k]))
    for name, values in zip(("axis_a", "axis_b"), folded(axis)):
        packed.add(name, values)


def packed_rods(frames, extent, name="rods"):
    """frames: of the run; extent: (lowest, highest corner) that holds all centres."""
    rods = Packed(name, [frame.time for frame in frames], [len(frame) for frame in frames])
    _add_places(rods, *(np.concatenate([getattr(frame, name) for frame in frames]) for name in ("centre", "axis")), extent)
    for name in ("length", "diameter"):
        rods.add_varying(name, np.concatenate([getattr(frame, name) for frame in frames]))
    low, high = extent
    rods.told.update(low=[float(value) for value in low], span=[float(value) for value in np.maximum(high - low, 1e-9)])
    return rods
