"""Pictures of the rods of a frame: POV-Ray draws them, a strip below tells the time and what the colours mean."""

import os
import shutil

import numpy as np
from matplotlib import image
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

import child_program
import povray_scene
import rod_colours
from units import with_unit

LEGEND = 0.075                  # height of the strip, in widths of the picture
SCENE, DRAWN, PICTURE = "view.pov", "drawn.png", "view.png"


def draw(frame, folder, width, camera, colours, way, propelled, time="", name=PICTURE, fixed=None):
    """Makes view.pov and a picture in `folder`; colours: (N, 3). Result: "", or why there is no picture."""
    povray = shutil.which("povray")
    if povray is None:
        return "povray is not installed (apt-get install povray)"
    (folder / SCENE).write_text(povray_scene.scene(frame, camera, colours, propelled, fixed), encoding="ascii")
    height = round(width / camera.aspect)
    # Started in the folder: Debian's povray may read and write there, wherever it is.
    status, errors = child_program.run([povray, f"+I{SCENE}", f"+O{DRAWN}", f"+W{width}", f"+H{height}", "+A0.1",
                                        "+AM2", "+FN8", "-D", "-GA"], folder)
    if status != 0 or not (folder / DRAWN).exists():
        lines = [line for line in errors.splitlines() if line.strip()] or ["no message"]
        return f"povray failed with status {status}: {lines[-1].strip()}"
    add_legend(folder / DRAWN, folder / name, way, propelled, time)
    os.remove(folder / DRAWN)
    return ""


def add_legend(drawn, path, way, propelled, time):
    """The same pixels, with a strip below them that tells the time and explains the colours."""
    pixels = image.imread(drawn)
    height, width = pixels.shape[:2]
    strip = round(LEGEND * width)
    size = width / 8.0  # dots an inch: text is as large in every picture
    figure = Figure(figsize=(width / size, (height + strip) / size), dpi=size, facecolor="white")
    figure.figimage(pixels, 0, strip)
    unit = strip / (height + strip)
    figure.text(0.03, 0.78 * unit, time, fontsize=9, va="center")
    if way.kind in ("scale", "angle"):
        bar = figure.add_axes((0.3, 0.7 * unit, 0.4, 0.17 * unit))
        shown = figure.colorbar(ScalarMappable(Normalize(way.low, way.high), rod_colours.COLOURS), cax=bar, orientation="horizontal",
                                ticks=np.linspace(way.low, way.high, 4), format="%.3g",
                                extend="neither" if way.kind == "angle" and way.high == 90.0 else "max")
        shown.set_label(with_unit(way.label, way.unit.replace("°", "degrees")), fontsize=9)
        shown.outline.set_linewidth(0.5)
        bar.tick_params(labelsize=8)
    if way.kind == "direction":
        for k, axis in enumerate("xyz"):
            _dot(figure, 0.36 + 0.11 * k, unit, rod_colours.ALONG[k], f"along {axis}")
    if propelled:
        _dot(figure, 0.77, unit, povray_scene.HEAD, "head")
    figure.savefig(path)


def _dot(figure, left, unit, colour, words):
    figure.text(left, 0.78 * unit, "●", color=colour, fontsize=12, va="center")
    figure.text(left + 0.025, 0.78 * unit, words, fontsize=9, va="center")
