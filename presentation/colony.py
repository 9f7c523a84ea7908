"""What the frames of a growing colony tell: its radius, the lengths and ages of its cells, and how fast they multiply."""

import numpy as np

from curves import Curve

RANGE = (5.0, 95.0)   # percentiles between which nearly all cells are
WITHIN = 95.0         # percent of the cells that the radius holds
DOUBLINGS = 3         # the last ones, from which the doubling time is


def curves(run, frames, ages):
    """frames: of the run; ages: (N) of each, in the time of the page, or None."""
    factor, _ = run.in_unit("time")
    unit = run.in_unit("max_overlap")[1]
    time = factor * np.array([frame.time for frame in frames])
    made = [Curve("radius", "Radius of the colony", "radius", unit, time, np.array([radius(frame) for frame in frames]),
                  from_zero=True, note=f"within which {WITHIN:.0f} % of the cells have their centres, from their centroid"),
            _spread("length", "Lengths of the cells", "length", unit, time, [frame.length for frame in frames])]
    if ages:
        made.append(_spread("age", "Ages of the cells", "age", run.in_unit("time")[1], time, ages))
    return [curve for curve in made if not curve.is_flat()]


def radius(frame):
    if len(frame) == 0:
        return np.nan
    centre = frame.unwrapped()
    from_middle = np.linalg.norm(centre - centre.mean(axis=0), axis=1)
    return float(np.percentile(from_middle, WITHIN))


def doubling_time(run):
    """From the slope of ln N over the last doublings, in the time of the page; None where there are too few."""
    factor, _ = run.in_unit("time")
    number, time = run.series["N"], factor * run.series["time"]
    rows = number >= number[-1] / 2**DOUBLINGS
    if number[-1] < 2 * number[0] or np.count_nonzero(rows) < 3:
        return None
    slope = np.polyfit(time[rows], np.log(number[rows]), 1)[0]
    return float(np.log(2.0) / slope) if slope > 0.0 else None


def tiles(run, rods, drawn):
    """Numbers that come first on the page: (words, number, unit, note)."""
    time_unit = run.in_unit("time")[1]
    last = {curve.name: curve for curve in drawn}
    yield ("cells", f"{run.series['N'][-1]:.0f}", "", f"from {run.series['N'][0]:.0f}")
    doubling = doubling_time(run)
    if doubling:
        yield ("doubling time", f"{doubling:.3g}", time_unit, f"over the last {DOUBLINGS} doublings")
    for name, words in (("radius", "radius"), ("pressure_collision", "pressure inside"), ("length", "median length")):
        if name in last:
            yield (words, f"{last[name].values[-1]:.3g}", last[name].unit, last[name].note if name == "pressure_collision" else "")
    if rods and rods.cells:
        generation = rods.cells[-1][0]
        yield ("generations", f"{generation.max():.0f}", "", f"the slowest line {generation.min():.0f}")


def _spread(name, title, label, unit, time, values):
    """Median and range of the cells of each frame."""
    low, middle, high = (np.array([np.percentile(of_frame, percent) if len(of_frame) else np.nan for of_frame in values])
                         for percent in (RANGE[0], 50.0, RANGE[1]))
    return Curve(name, title, label, unit, time, middle, low, high, from_zero=True,
                 note=f"median, and the range of {RANGE[1] - RANGE[0]:.0f} % of the cells")
