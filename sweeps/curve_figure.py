"""A curve of a table: an average with its error against a key, one line for each value of the others."""

import math

from plots import pyplot  # the look of the pictures of reports
import units

LABELS = {"volume_fraction": "volume fraction", "area_fraction": "area fraction", "length": "length", "count": "number of rods"}
SYMBOLS = {"Z": "Z", "nematic_order": "nematic order S"}
MARKERS = "osD^vP*X"


def draw(points, name, against, others, unit, path):
    """PATH.png and PATH.svg. `points`: (row, mean, error or nan), of which rows hold the keys; `against`: key of the axis."""
    figure, axes = pyplot.subplots(figsize=(6.0, 4.2), layout="constrained")
    curves = {}
    for row, mean, error in points:
        if not math.isnan(mean):
            curves.setdefault(tuple(str(row.get(key, "")) for key in others), []).append((row[against], mean, error))
    for number, (values, curve) in enumerate(curves.items()):
        numbers = all(isinstance(x, (int, float)) for x, *_ in curve)
        x, mean, error = zip(*(sorted(curve) if numbers else curve))
        label = ", ".join(f"{shown(key)} = {value}" for key, value in zip(others, values))
        axes.errorbar(x if numbers else [str(at) for at in x], mean, [0.0 if math.isnan(one) else one for one in error],
                      marker=MARKERS[number % len(MARKERS)], markersize=4, linewidth=1, capsize=2, label=label or None)
    axes.set_xlabel(shown(against))
    axes.set_ylabel(units.with_unit(SYMBOLS.get(name, name.replace("_", " ")), units.text(unit)))
    if others:
        axes.legend()
    for ending in ("png", "svg"):
        figure.savefig(path.with_name(f"{path.name}.{ending}"), dpi=160)
    pyplot.close(figure)


def shown(key):
    last = key.rpartition(".")[2]
    return LABELS.get(last, last.replace("_", " "))
