"""A colony from one cell

One cell in open space lengthens and divides until there are 200,000, all in one dense ball whose inner cells push the outer ones outwards. Is every step's
contact problem solved, how many sweeps does it take as the colony grows, and how far do cells overlap? (CellModeller is reported to diverge at 96,000 cells.)
"""

import numpy

import figures
from runs import Run

TIME_STEP = 0.005  # in which a cell of mean rate lengthens by 0.005 D
CELLS, END = 200000, 54.6  # a doubling takes 3
QUICK_CELLS, QUICK_END = 1000, 32.0
LARGE = 10000  # cells, from which on steps have momentum and early searches
FRAME_EVERY = 6.7


def runs(quick):
    end = QUICK_END if quick else END
    return [Run(name="colony",
                scene={"seed": 2, "box": {"edges": (400.0, 400.0, 400.0), "periodic": (False, False, False)},
                       "rods": {"count": 1, "length": 2.0},
                       # A little noise lets the line of the first daughters buckle.
                       "fluid": {"kT": 0.001}, "contact": {"brownian_correction": False},
                       "growth": {"rate": 1.0, "rate_deviation": 0.1, "division_length": 5.0, "division_deviation": 0.1},
                       "solver": {"tolerance": 1e-3}, "time": {"step": TIME_STEP},
                       "output": {"series_every": 10, "trajectory_every": round(FRAME_EVERY / TIME_STEP)}},
                equilibration=0, production=round(end / TIME_STEP))]


def evaluate(report, runs_by_name, quick):
    run = runs_by_name["colony"]
    series = run.series()
    cells = QUICK_CELLS if quick else CELLS
    report.require("number of cells in the end", series["N"][-1], lower=cells)
    births = len(run.left.table("lineage.csv")["step"])
    report.require("cells in the end, less births, less the first", series["N"][-1] - births - 1, lower=0, upper=0)
    report.require("largest overlap, D", series["max_overlap"].max(), upper=0.05)
    rows = []
    for count in 10 ** numpy.arange(1, numpy.log10(series["N"][-1]), 0.5):
        at = min(numpy.searchsorted(series["N"], count), len(series) - 1)
        near = series[max(0, at - 10):at + 11]
        rows.append([f"{series['N'][at]:.0f}", f"{series['time'][at]:.1f}", f"{near['contacts'].mean() / near['N'].mean():.2f}",
                     f"{near['iterations'].mean():.0f}", f"{near['max_overlap'].max():.4f}"])
    report.table("The colony as it grows: means over 2 units of time, largest overlap in it.",
                 ["cells", "time", "contacts a cell", "sweeps a step", "largest overlap, D"], rows)
    report.remark(f"{run.record['steps']} steps to {series['N'][-1]:.0f} cells took {run.time_taken} on {run.threads} threads; "
                  f"the last steps hold {series['contacts'][-1]:.0f} contacts and take {series['iterations'][-1]:.0f} sweeps.")
    if series["N"][-1] > 2 * LARGE:
        large = series[series["N"] >= LARGE]
        exponent = numpy.polyfit(numpy.log(large["N"]), numpy.log(large["iterations"]), 1)[0]
        report.remark(f"Above {LARGE:,} cells sweeps grow as the number of cells to the power {exponent:.2f} (fit to all rows).")
    report.numbers(["time", "N", "contacts", "iterations", "max_overlap"],
                   [list(row) for row in zip(series["time"], series["N"], series["contacts"], series["iterations"],
                                             series["max_overlap"])])
    draw(report, series)


def draw(report, series):
    figure, panels = figures.axes(1, 3, size=(10.5, 3.4))
    for panel, (column, label) in zip(panels, (("contacts", "contacts"), ("iterations", "sweeps a step"),
                                               ("max_overlap", "largest overlap, D"))):
        panel.plot(series["N"], series[column], linewidth=0.7, color="C0")
        panel.set(xlabel="cells", ylabel=label, xscale="log")
    panels[0].set_yscale("log")
    report.figure(figure, "Contacts, sweeps and overlaps of a growing colony.")
