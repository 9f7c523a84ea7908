"""Density and stress across a box, layer by layer, from the fields of a run."""

import numpy as np

from .statistics import average

ELEMENTS = [f"{a}{b}" for a in "xyz" for b in "xyz"]


def profile_of(field, axis, kT, dimensions, after):
    """One row a layer: its middle, number_density, stress_xx ... (the whole stress), and their standard errors (Run.profile)."""
    rows = field[np.isfinite(field["x"]) & (field["time"] > after)]
    steps, of_step = np.unique(rows["step"], return_inverse=True)
    places, layer = np.unique(rows[axis], return_inverse=True)
    cell = of_step * len(places) + layer
    cells = np.bincount(cell, minlength=len(steps) * len(places))

    def layers(values):
        """(fields, layers) means over the cells of each layer."""
        return (np.bincount(cell, values, minlength=len(cells)) / cells).reshape(len(steps), len(places))

    names = ["number_density", *(f"stress_{element}" for element in ELEMENTS)]
    made = np.empty(len(places), [(axis, float), *((name + ending, float) for name in names for ending in ("", "_error"))])
    made[axis] = places
    for name in names:
        values = rows[name] if name == "number_density" else whole_stress(rows, name[-2:], kT, dimensions)
        for k, series in enumerate(layers(values).T):
            known = average(series)
            made[name][k] = known.mean
            made[name + "_error"][k] = np.nan if known.standard_error is None else known.standard_error
    return made


def whole_stress(rows, element, kT, dimensions):
    a, b = element
    kinetic = rows["number_density"] * kT if a == b and a in "xyz"[:dimensions] else 0.0
    return kinetic + rows[f"stress_{element}"] + rows["stress_orientation_" + "".join(sorted(element))]
