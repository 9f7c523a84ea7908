"""The look of all figures, and how they are saved."""

import math

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({
    "svg.hashsalt": "jostle",  # the same figure, the same file
    "font.size": 10,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.frameon": False,
    "figure.constrained_layout.use": True,
})
from matplotlib import pyplot  # noqa: E402  (the backend must be chosen first)


def axes(rows=1, columns=1, size=(5.6, 4.0), **options):
    """(figure, axes) of that many panels; `size` in inches, of all together."""
    return pyplot.subplots(rows, columns, figsize=size, **options)


def draw_slab(panel, centre, axis, length, colour_number, edge, thickness):
    """Rods of diameter 1 whose centres lie within `thickness` of the bottom of a cube, seen from above."""
    from matplotlib.patches import FancyBboxPatch
    from matplotlib.transforms import Affine2D

    patches, colours = [], []
    for k in (centre[:, 2] % edge < thickness).nonzero()[0]:
        flat = float((axis[k][0]**2 + axis[k][1]**2)**0.5) * float(length[k])
        patch = FancyBboxPatch((-flat / 2, 0.0), flat, 0.0, boxstyle="round,pad=0.5")
        angle = float(math.atan2(axis[k][1], axis[k][0]))
        patches.append((patch, Affine2D().rotate(angle).translate(*(centre[k][:2] % edge))))
        colours.append(pyplot.cm.twilight(float(colour_number[k] * 0.618 % 1.0)))
    for (patch, place), colour in zip(patches, colours):
        patch.set(facecolor=colour, edgecolor="black", linewidth=0.15, transform=place + panel.transData)
        panel.add_patch(patch)
    panel.set(xlim=(0, edge), ylim=(0, edge), aspect="equal", xticks=[], yticks=[])


def save(figure, path_without_suffix):
    figure.savefig(path_without_suffix.with_suffix(".png"), dpi=160)
    figure.savefig(path_without_suffix.with_suffix(".svg"), metadata={"Date": None})
    pyplot.close(figure)
