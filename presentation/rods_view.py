"""The picture of the rods of the last frame: POV-Ray draws them, a colour bar tells what the colours mean."""

import os
import shutil

import numpy as np
from matplotlib import colormaps, image
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

import child_program
import povray_scene

COLOURS = colormaps["viridis"]  # even in lightness, and the same order for every kind of colour vision
PLAIN = (0.34, 0.55, 0.75)
TOPS = (15.0, 30.0, 45.0, 60.0, 90.0)  # degrees that the colours may end at
LEGEND = 0.075                  # height of the colour bar's strip, in widths of the picture
SCENE, DRAWN, PICTURE = "view.pov", "drawn.png", "view.png"


def draw(frame, folder, width, propelled):
    """Makes view.pov and view.png in `folder`. Result: "", or why there is no picture."""
    povray = shutil.which("povray")
    if povray is None:
        return "povray is not installed (apt-get install povray)"
    camera = povray_scene.Camera(frame)
    angles = angles_to_director(frame) if propelled or frame.length.any() else None
    top = None if angles is None else next(top for top in TOPS if top >= min(np.percentile(angles, 95), TOPS[-1]))
    colours = np.tile(PLAIN, (len(frame), 1)) if angles is None else COLOURS(angles / top)[:, :3]
    (folder / SCENE).write_text(povray_scene.scene(frame, camera, colours, propelled), encoding="ascii")
    height = round(width / camera.aspect)
    # Started in the folder: Debian's povray may read and write there, wherever it is.
    status, errors = child_program.run([povray, f"+I{SCENE}", f"+O{DRAWN}", f"+W{width}", f"+H{height}", "+A0.1",
                                        "+AM2", "+FN8", "-D", "-GA"], folder)
    if status != 0 or not (folder / DRAWN).exists():
        lines = [line for line in errors.splitlines() if line.strip()] or ["no message"]
        return f"povray failed with status {status}: {lines[-1].strip()}"
    add_legend(folder / DRAWN, folder / PICTURE, top, propelled)
    os.remove(folder / DRAWN)
    return ""


def angles_to_director(frame):
    """Of every rod, in degrees, 0 to 90."""
    director = np.linalg.eigh(frame.axis.T @ frame.axis)[1][:, -1]
    return np.degrees(np.arccos(np.minimum(np.abs(frame.axis @ director), 1.0)))


def add_legend(drawn, path, top, propelled):
    """The same pixels, with a strip below them that explains the colours up to `top` degrees (None: one colour)."""
    pixels = image.imread(drawn)
    height, width = pixels.shape[:2]
    strip = round(LEGEND * width) if top or propelled else 0
    size = width / 8.0  # dots an inch: text is as large in every picture
    figure = Figure(figsize=(width / size, (height + strip) / size), dpi=size, facecolor="white")
    figure.figimage(pixels, 0, strip)
    unit = strip / (height + strip)
    if top:
        bar = figure.add_axes((0.3, 0.7 * unit, 0.4, 0.17 * unit))
        shown = figure.colorbar(ScalarMappable(Normalize(0.0, top), COLOURS), cax=bar, orientation="horizontal",
                                ticks=np.linspace(0.0, top, 4), extend="max" if top < TOPS[-1] else "neither")
        shown.set_label("angle between rod and director, degrees", fontsize=9)
        shown.outline.set_linewidth(0.5)
        bar.tick_params(labelsize=8)
    if propelled:
        figure.text(0.77, 0.78 * unit, "●", color=povray_scene.HEAD, fontsize=12, va="center")
        figure.text(0.795, 0.78 * unit, "head", fontsize=9, va="center")
    figure.savefig(path)
