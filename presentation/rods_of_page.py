"""The rods that the page turns: which frames, where they are, how they may be coloured, and what was left out."""

import dataclasses
import re
from dataclasses import dataclass, field

import numpy as np
from matplotlib import colormaps

import colourings
import contact_lines
import povray_scene
from frames_of_page import BYTES_OF_ROD, MEGABYTE, chosen_frames, packed_lines, packed_rods
from lineage import Lineage
from refusal import Refusal
from trajectory import Frame


@dataclass(frozen=True)
class Seen:
    """What the user asked to see, as text: number of a frame from 0, or from -1 backwards; view; key of the colours."""
    frame: str = "-1"
    view: str = ""
    colour: str = ""


@dataclass
class Rods:
    """What the page needs: `told` becomes JSON, `elements` are texts by the name of their element."""
    told: dict = field(default_factory=dict)
    elements: dict = field(default_factory=dict)
    frames: list = field(default_factory=list)
    cells: list = field(default_factory=list)  # (generation, age, family) of each frame, where cells grow
    ways: list = field(default_factory=list)   # to colour them, the first to begin with
    start: int = 0                             # place in `frames` of the one to begin with
    camera: povray_scene.Camera = None         # to begin with
    notes: list = field(default_factory=list)
    fixed: Frame = None                        # rods that nothing moves


def rods_of(run, trajectory, megabytes, seen):
    """seen: what the page begins with, and the still shows."""
    counts = trajectory.counts()
    numbers = chosen_frames(counts, megabytes)
    made = frames_of(run, trajectory, numbers)
    if len(numbers) < len(counts):
        made.notes.append(f"The page holds {len(numbers)} of the {len(counts)} frames, to stay within {megabytes:g} MB; "
                          "--megabytes gives it more room.")
    if counts[numbers].sum() * BYTES_OF_ROD * 4 / 3 > megabytes * MEGABYTE:
        made.notes.append("Its one frame alone is larger than that.")
    first = way_of(made, seen.colour)
    made.ways.sort(key=lambda way: way is not first)
    made.start = int(np.abs(numbers - frame_number(seen.frame, len(counts))).argmin())
    made.camera = povray_scene.Camera(made.frames[made.start], view_of(seen.view))
    _describe(run, made)
    return made


def frames_of(run, trajectory, numbers=None):
    """The frames with these numbers, or all, and the ways to colour them."""
    made = Rods(frames=[trajectory.frame(k) for k in (range(len(trajectory)) if numbers is None else numbers)],
                fixed=trajectory.fixed)
    if run.grows and (run.folder / "lineage.csv").exists():
        lineage = Lineage(run, made.frames)
        made.cells = [lineage.at(frame) for frame in made.frames]
    made.ways = colourings.ways(run, made.frames, made.cells)
    return made


def way_of(rods, key):
    """The way to colour with that key; an empty one is the first."""
    found = next((way for way in rods.ways if key in ("", way.key)), None)
    if found is None:
        raise Refusal(f'--colour = "{key}"', f"this run has no such colours (allowed: {', '.join(way.key for way in rods.ways)})")
    return found


def frame_number(text, frames):
    number = int(text) if re.fullmatch(r"-?\d{1,9}", text) else frames
    if not -frames <= number < frames:
        raise Refusal(f"--frame = {text}", f"there is no such frame (allowed: 0 to {frames - 1}, or -1 for the last)")
    return number % frames


def view_of(name):
    if name not in ("", "x", "y", "z"):
        raise Refusal(f'--view = "{name}"', "there is no such view (allowed: x, y, z)", "Without it, rods are seen from above and aside")
    return name


def _describe(run, made):
    frames = made.frames
    extent = _extent([*frames, *([made.fixed] if made.fixed else [])])
    rods = packed_rods(frames, extent)
    camera = made.camera
    factor, _ = run.in_unit("time")
    rods.told["times"] = [factor * time for time in rods.told["times"]]
    made.told = {"rods": rods.told, "colourings": [colourings.told(way, rods) for way in made.ways], "map": _map(), "swim": run.propelled,
                 "start": made.start, "length_unit": run.in_unit("max_overlap")[1],
                 "seen": _seen(frames).tolist(), "boxes": _boxes(frames),
                 "camera": {"back": (-camera.direction).tolist(), "pole": camera.pole.tolist()}}
    made.elements = rods.elements
    _describe_surroundings(made, extent)
    if (run.folder / "contacts.csv").exists():
        lines = contact_lines.packed_contacts(run, frames, extent)
        if lines:
            _add(made, "contacts", lines)


def _add(made, name, packed):
    """Lines or rods beside those that move, on their scale of positions."""
    made.told[name] = {**packed.told, "low": made.told["rods"]["low"], "span": made.told["rods"]["span"]}
    made.elements.update(packed.elements)


def _describe_surroundings(made, extent):
    """Rods that nothing moves, and lines for the walls: of one frame where the box does not change."""
    if made.fixed:
        _add(made, "fixed", packed_rods([made.fixed], extent, "fixed"))
    frames = made.frames if _changes(made.frames) else made.frames[-1:]
    lines = [frame.walls.lines(frame.edges) for frame in frames]
    if len(lines[0]):
        thickness = 3.2 * povray_scene.thickness_of_edges(*povray_scene.extent(frames[-1]))
        _add(made, "walls", packed_lines("walls", [frame.time for frame in frames], lines, thickness, extent))


def _extent(frames):
    """Corners that hold all centres and the box, with room for lines that stick out."""
    reach = max((frame.length + frame.diameter).max(initial=0.0) for frame in frames)
    centres = [frame.centre for frame in frames if len(frame)]
    corners = [np.zeros((1, 3)), *(frame.edges[None] for frame in frames)] if frames[-1].held.any() else []
    points = np.concatenate(centres + corners) if centres or corners else np.zeros((1, 3))
    return points.min(axis=0) - reach, points.max(axis=0) + reach


def _boxes(frames):
    """(lowest, highest corner) of the box in each frame, or one where it does not change; none where it is open."""
    drawn = frames if _changes(frames) else frames[-1:]
    return [[corner.tolist() for corner in povray_scene.extent(frame)] for frame in drawn if povray_scene.outlined(frame)]


def _changes(frames):
    """Whether the box does."""
    return any((frame.edges != frames[-1].edges).any() for frame in frames)


def _seen(frames):
    """Points that the picture must hold: the corners of a periodic box, else the outermost ends of rods all around."""
    frame = dataclasses.replace(frames[-1], edges=np.max([frame.edges for frame in frames], axis=0))
    low, high = povray_scene.extent(frame)
    corners = low + np.array(list(np.ndindex(2, 2, 2))) * (high - low)
    if frame.held.any() or len(frame) == 0:
        return corners
    around = np.array([way for way in np.ndindex(5, 5, 5) if way != (2, 2, 2)]) - 2.0
    ends = frame.ends().reshape(-1, 3)
    return ends[np.unique((ends @ around.T).argmax(axis=0))]


def _map():
    """256 colours, even in lightness, and in the same order for every kind of colour vision."""
    return (255 * colormaps["viridis"](np.linspace(0.0, 1.0, 256))[:, :3]).round().astype(int).tolist()
