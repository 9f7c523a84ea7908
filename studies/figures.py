"""The look of all figures, and how they are saved."""

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


def save(figure, path_without_suffix):
    figure.savefig(path_without_suffix.with_suffix(".png"), dpi=160)
    figure.savefig(path_without_suffix.with_suffix(".svg"), metadata={"Date": None})
    pyplot.close(figure)
