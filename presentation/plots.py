"""Plots of the series of a run over time, and the averages with their errors where the summary has them."""

from dataclasses import dataclass

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

# Okabe and Ito's colours, told apart with every kind of colour vision.
BLUE, ORANGE, GREY = "#0072b2", "#d55e00", "#999999"
MOST_POINTS = 600        # of more rows, what is drawn is their mean and range in as many equal parts
MOST_PARTS = 20          # of the averaging window, with an error bar each
SAMPLES_IN_PART = 5      # independent ones, at least


@dataclass(frozen=True)
class Plot:
    column: str            # of series.csv; the file is called after it
    label: str             # of the axis
    title: str
    averaged: bool = False  # the summary has its mean and standard error
    from_zero: bool = False
    whole: bool = False     # whole numbers


def chosen(run):
    """The plots that say something about this run."""
    pressure = Plot("Z", "Z", "Compressibility factor", averaged=True)
    if not np.isfinite(run.series["Z"]).any():
        pressure = Plot("pressure_collision", "collision pressure", "Collision pressure", averaged=True)
    return [pressure,
            Plot("nematic_order", "nematic order S", "Nematic order", averaged=True, from_zero=True),
            Plot("max_overlap", "largest overlap", "Largest overlap of two rods", from_zero=True),
            Plot("iterations", "solver iterations a step", "Work of the contact solver", from_zero=True),
            Plot("N", "rods", "Number of rods", whole=True),
            Plot("phi", "volume fraction", "Volume fraction")]


def draw(plot, run, folder):
    """Makes COLUMN.png in the folder and returns its name."""
    figure, axes = pyplot.subplots(figsize=(6.4, 3.6), layout="constrained")
    draw_rows(axes, run.series["time"], run.series[plot.column])
    average = run.summary.get(plot.column) if plot.averaged else None
    if average and average["mean"] is not None:
        draw_average(axes, run, plot)
    axes.set_xlim(0.0, 1.02 * run.series["time"][-1])
    axes.set_title(plot.title, loc="left", fontsize=12)
    axes.set_xlabel(with_unit("time", run.unit("time")))
    axes.set_ylabel(with_unit(plot.label, run.unit(plot.column)))
    set_limits(axes, plot, run)
    if average or len(run.series["time"]) > MOST_POINTS:
        axes.legend(loc="upper right", ncols=2, columnspacing=1.2)
    name = f"{plot.column}.png"
    figure.savefig(folder / name, dpi=160)
    pyplot.close(figure)
    return name


def draw_rows(axes, time, values):
    if len(values) <= MOST_POINTS:
        axes.plot(time, values, color=BLUE, alpha=0.75, linewidth=0.9, marker="." if len(values) < 30 else None,
                  label="rows of series.csv")
        return
    parts = np.array_split(np.arange(len(values)), MOST_POINTS)
    of_parts = [values[part] for part in parts]
    middle = [time[part].mean() for part in parts]
    axes.fill_between(middle, [part.min() for part in of_parts], [part.max() for part in of_parts], color=BLUE,
                      alpha=0.3, linewidth=0, label="range of the rows")
    axes.plot(middle, [part.mean() for part in of_parts], color=BLUE, linewidth=0.9, label="their mean")


def window_of(run):
    """Rows that the averages are of; all of them where there are none."""
    time = run.series["time"]
    after = np.flatnonzero(time > (run.summary.get("equilibration_time") or 0.0))
    window = after[-int(run.summary.get("production_rows") or len(time)):]
    return window if len(window) else np.arange(len(time))


def draw_average(axes, run, plot):
    """The mean over the averaging window with its error; and, where error bars mean something, parts of the window."""
    average = run.summary[plot.column]
    mean, error = average["mean"], average.get("standard_error")
    time, values, window = run.series["time"], run.series[plot.column], window_of(run)
    if window[0] > 0:
        axes.axvspan(0.0, time[window[0] - 1], color=GREY, alpha=0.2, linewidth=0, label="left out of the average")
    ends = time[window[[0, -1]]]
    label = f"mean {mean:.4g}" + ("" if error is None else f" ± {error:.2g}")
    axes.plot(ends, [mean, mean], color=ORANGE, linewidth=1.8, label=label)
    if error is None:
        return
    axes.fill_between(ends, mean - error, mean + error, color=ORANGE, alpha=0.35, linewidth=0)
    parts = min(MOST_PARTS, int((average.get("n_eff") or 0.0) / SAMPLES_IN_PART))
    if parts >= 2:
        blocks = np.array_split(window, parts)
        # A part has 1/parts of the independent samples, so its error is larger by the root of their number.
        axes.errorbar([time[block].mean() for block in blocks], [values[block].mean() for block in blocks],
                      error * np.sqrt(parts), fmt="o", color=ORANGE, markersize=4, elinewidth=1.4, capsize=3,
                      label=f"means of {parts} parts, standard errors")


def set_limits(axes, plot, run):
    """Room above for the legend; the first rows of a start may leave the picture; a constant is no line at the edge."""
    values = run.series[plot.column]
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return
    low, high = finite.min(), finite.max()
    if plot.averaged:
        of_window = values[window_of(run)]
        low, high = (edge((limit(of_window), np.percentile(finite, percent)))
                     for edge, limit, percent in ((min, np.nanmin, 10), (max, np.nanmax, 90)))
    if plot.from_zero:
        low = min(low, 0.0)
    # A mean of equal numbers differs in its last digits.
    span = high - low if high - low > 1e-6 * abs(high) else max(0.2 * abs(high), 0.01)
    if plot.from_zero:
        high = low + span
    else:
        middle = 0.5 * (low + high)
        low, high = middle - 0.5 * span, middle + 0.5 * span
    axes.set_ylim(low - (0.02 if plot.from_zero else 0.08) * span, high + (0.35 if plot.averaged else 0.1) * span)
    axes.ticklabel_format(axis="y", useOffset=False)
    if plot.whole:
        axes.yaxis.set_major_locator(MaxNLocator(integer=True))


def with_unit(label, unit):
    return f"{label} ({unit})" if unit else label
