"""Simulations that begin with rods of the user's."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from . import _jostle
from ._arrays import with_shape
from ._jostle import refuse
from .frames import frames_of

GIVEN = "(rods of Simulation)"


def core_with_rods(scene, rods):
    """The simulation of a scene in the extension, with these rods in the place of those that the scene would make."""
    folder = getattr(rods, "folder", rods)  # of a Run, too
    if isinstance(folder, (str, Path)) and not Path(folder).is_file():
        return _jostle.Simulation(_begun_by_run(scene, str(Path(folder).absolute()))._core)
    if scene.springs.file:
        refuse("rods", f"a {type(rods).__name__}", "tell nothing of the springs of the scene", "the folder of a run")
    speed = np.empty(0)
    if isinstance(rods, Mapping) and "speed" in rods:
        rods = dict(rods)
        speed = with_shape("speed", rods.pop("speed"), (None,))
    frame = frames_of(rods)[-1]
    if len(frame) == 0:
        refuse("rods", "", "are none", "at least one rod")
    _require_sizes(frame)
    columns = [np.ascontiguousarray(column, float) for column in (frame.centre, frame.axis, frame.length, frame.diameter)]
    return _jostle.Simulation.of_rods(_begun_by_run(scene, GIVEN)._core, *columns, speed)


def _begun_by_run(scene, run):
    scene = scene.copy()
    defaults = {"file": "", "frame": None, "axis": (1.0, 0.0, 0.0), "length_deviation": 0.0, "diameter_deviation": 0.0}
    for key, value in {**defaults, "start": "run", "run": run}.items():
        setattr(scene.rods, key, value)
    return scene


def _require_sizes(frame):
    for name, values, sound in (("length", frame.length, frame.length >= 0), ("diameter", frame.diameter, frame.diameter > 0)):
        if not sound.all():
            row = int(np.argmin(sound))
            refuse(f"{name} (row {row})", str(values[row]), "is outside the allowed range", "at least 0" if name == "length" else "greater than 0")
