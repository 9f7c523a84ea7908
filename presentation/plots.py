"""Pictures of the curves, for print and for where no program of the page runs."""

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams.update({
    "font.size": 11,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "legend.edgecolor": "none",
    "legend.framealpha": 0.85,
    "legend.fontsize": 9,
})
import numpy as np  # noqa: E402  (the backend must be chosen first)
from matplotlib import pyplot  # noqa: E402
from matplotlib.ticker import MaxNLocator  # noqa: E402

from units import with_unit  # noqa: E402

# Okabe and Ito's colours, told apart with every kind of colour vision.
BLUE, ORANGE, GREY = "#0072b2", "#d55e00", "#999999"
MOST_POINTS = 600        # of more rows, what is drawn is their mean and range in as many equal parts
MOST_PARTS = 20          # of the averaging window, with an error bar each
SAMPLES_IN_PART = 5      # independent ones, at least


def draw(curve, time_unit, folder):
    """Makes NAME.png in the folder."""
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6), layout="constrained")
    draw_rows(axes, curve)
    if curve.average:
        draw_average(axes, curve)
    axes.set_xlim(0.0, 1.02 * curve.time[-1])
    axes.set_xlabel(with_unit("time", time_unit))
    axes.set_ylabel(with_unit(curve.label, curve.unit))
    if curve.logarithmic:
        axes.set_yscale("log")
    else:
        set_limits(axes, curve)
    if curve.average or len(curve.time) > MOST_POINTS:
        axes.legend(loc="upper right", ncols=2, columnspacing=1.2)
    figure.savefig(folder / f"{curve.name}.png", dpi=160)
    pyplot.close(figure)


def of_parts(curve, most=MOST_POINTS):
    """time, low, middle, high: the rows, or mean and range in `most` equal parts; low and high None without a range."""
    if len(curve.time) <= most:
        return curve.time, curve.low, curve.values, curve.high
    parts = np.array_split(np.arange(len(curve.time)), most)
    low, high = (curve.values if limit is None else limit for limit in (curve.low, curve.high))
    return (np.array([curve.time[part].mean() for part in parts]), np.array([low[part].min() for part in parts]),
            np.array([curve.values[part].mean() for part in parts]), np.array([high[part].max() for part in parts]))


def draw_rows(axes, curve):
    time, low, middle, high = of_parts(curve)
    if low is None:
        axes.plot(time, middle, color=BLUE, alpha=0.75, linewidth=0.9, marker="." if len(time) < 30 else None,
                  label="rows of series.csv")
        return
    axes.fill_between(time, low, high, color=BLUE, alpha=0.3, linewidth=0, label="range of the rows")
    axes.plot(time, middle, color=BLUE, linewidth=0.9, label="their mean")


def draw_average(axes, curve):
    """The mean over the averaging window with its error; and, where error bars mean something, parts of the window."""
    mean, error = curve.average["mean"], curve.average.get("standard_error")
    first, last = curve.window
    time, window = curve.time, np.arange(first, last + 1)
    if first > 0:
        axes.axvspan(0.0, time[first - 1], color=GREY, alpha=0.2, linewidth=0, label="left out of the average")
    ends = time[[first, last]]
    label = f"mean {mean:.4g}" + ("" if error is None else f" ± {error:.2g}")
    axes.plot(ends, [mean, mean], color=ORANGE, linewidth=1.8, label=label)
    if error is None:
        return
    axes.fill_between(ends, mean - error, mean + error, color=ORANGE, alpha=0.35, linewidth=0)
    parts = min(MOST_PARTS, int((curve.average.get("n_eff") or 0.0) / SAMPLES_IN_PART))
    if parts >= 2:
        blocks = np.array_split(window, parts)
        # A part has 1/parts of the independent samples, so its error is larger by the root of their number.
        axes.errorbar([time[block].mean() for block in blocks], [curve.values[block].mean() for block in blocks],
                      error * np.sqrt(parts), fmt="o", color=ORANGE, markersize=4, elinewidth=1.4, capsize=3,
                      label=f"means of {parts} parts, standard errors")


def set_limits(axes, curve):
    """Room above for the legend; the first rows of a start may leave the picture."""
    low, high = limits(curve)
    axes.set_ylim(low, high)
    axes.ticklabel_format(axis="y", useOffset=False)
    if curve.whole:
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))


def limits(curve, room=0.35):
    """What the axis shows: all rows that count, and `room` above them."""
    lowest, highest = (curve.values if limit is None else limit for limit in (curve.low, curve.high))
    low, high = np.nanmin(lowest), np.nanmax(highest)
    if curve.average:
        of_window = curve.values[curve.window[0]:curve.window[1] + 1]
        finite = curve.values[np.isfinite(curve.values)]
        low = min(np.nanmin(of_window), np.percentile(finite, 10))
        high = max(np.nanmax(of_window), np.percentile(finite, 90))
    if curve.from_zero:
        low = min(low, 0.0)
    span = high - low
    return low - (0.02 if curve.from_zero else 0.08) * span, high + (room if curve.average else 0.1) * span
