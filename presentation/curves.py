"""What is plotted over time: rows of the series, the averages with their errors where the summary has them, and of colonies
what their frames tell."""

from dataclasses import dataclass

import numpy as np

FLAT = 1e-6  # of a curve whose numbers differ by less, relative to them, there is nothing to see


@dataclass
class Curve:
    name: str               # of its picture
    title: str
    label: str              # of the axis
    unit: str
    time: np.ndarray        # (n)
    values: np.ndarray      # (n)
    low: np.ndarray = None  # (n) and high: a range about the values
    high: np.ndarray = None
    from_zero: bool = False
    logarithmic: bool = False
    whole: bool = False     # whole numbers
    aside: bool = False     # how the steps went: for the curious
    note: str = ""
    average: dict = None    # entry of the summary, in this unit
    window: tuple = None    # (first, last) row that the average is of

    def is_flat(self):
        known = self.values[np.isfinite(self.values)]
        return len(known) < 2 or np.ptp(known) <= FLAT * np.abs(known).max()


def chosen(run):
    """The curves of the series that say something about this run."""
    return [curve for curve in (_colony(run) if run.is_colony else _lasting(run)) if not curve.is_flat()]


def of_series(run, column, title, label, **more):
    factor, unit = run.in_unit(column)
    average = run.summary.get(column)
    if isinstance(average, dict) and average["mean"] is not None and not run.is_colony:
        scaled = {name: factor * average[name] for name in ("mean", "standard_error") if average.get(name) is not None}
        more.update(average={**average, **scaled}, window=window_of(run))
    return Curve(column, title, label, unit, time_of(run), factor * run.series[column], **more)


def time_of(run):
    factor, _ = run.in_unit("time")
    return factor * run.series["time"]


def window_of(run):
    """(first, last) row that the averages are of; all of them where there are none."""
    time = run.series["time"]
    after = np.flatnonzero(time > (run.summary.get("equilibration_time") or 0.0))
    window = after[-int(run.summary.get("production_rows") or len(time)):]
    return (int(window[0]), int(window[-1])) if len(window) else (0, len(time) - 1)


def _lasting(run):
    rods_have_axes = run.propelled or run.scene["rods"].get("length", 1.0) != 0 or run.scene["rods"].get("start") == "file"
    if np.isfinite(run.series["Z"]).any():
        yield of_series(run, "Z", "Compressibility factor", "Z")
    else:
        yield of_series(run, "pressure_collision", "Collision pressure", "collision pressure")
    if "pressure_active" in run.series:
        yield of_series(run, "pressure_active", "Active pressure", "active pressure")
    if "pressure_springs" in run.series:
        yield of_series(run, "pressure_springs", "Pressure of the springs", "pressure of springs")
    if rods_have_axes:
        yield of_series(run, "nematic_order", "Nematic order", "S", from_zero=True)
    yield of_series(run, "N", "Number of rods", "rods", whole=True)
    yield of_series(run, "phi", run.fraction.capitalize(), run.fraction)
    yield from _steps(run)


def _steps(run):
    yield of_series(run, "max_overlap", "Largest overlap of two rods", "largest overlap", from_zero=True, aside=True)
    yield of_series(run, "iterations", "Work of the contact solver", "iterations a step", from_zero=True, aside=True)


def _colony(run):
    yield of_series(run, "N", "Cells", "cells", whole=True, logarithmic=True)
    pressure = of_series(run, "pressure_collision", "Pressure inside the colony", "pressure")
    with np.errstate(invalid="ignore"):
        pressure.values = pressure.values / run.series["phi"]
    pressure.note = f"collision stress of all cells, over their {run.fraction.split()[0]}"
    yield pressure
    yield from _steps(run)
