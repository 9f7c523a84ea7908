"""A colony in a channel

Cells grow in one layer between two lines and leave through the open ends. Each is dragged along by those behind it, so that the pressure along the channel is a parabola, P(x) = n a zeta (X^2 - x^2)/2: n cells an area, a
the rate at which their area grows, zeta the friction of one. Is it?
"""

import csv

import numpy

import figures
from runs import ROOT, Run, structured

STEP = 1.0 / 140.0
WIDTH, ROOM, SPACING = 12.0, 800.0, 4.0  # across and along the channel; none of the seeds begins near an end
QUICK_END, END, SEEDS, QUICK_SEEDS = 21.75, 23.25, (2, 5, 6, 8), (2,)
FIELD_EVERY = 70
# Forces within such a colony are 1e5 times what opens a gap by the default tolerance: sweeps over the contacts, the default, do not get there.
SOLVER = {"method": "apgd", "tolerance": 1e-3}
AVERAGED = 1          # of the last fields
INSIDE = 0.6          # of the largest density: cells of the grid within the colony
BOUND = 0.05


def runs(quick):
    end = QUICK_END if quick else END
    return [Run(name=f"seed{seed}",
                scene={"seed": seed, "box": {"dimensions": 2, "edges": (ROOM, WIDTH), "periodic": (False, False)}, "walls": {"faces": (False, True)},
                       "rods": {"count": 1, "length": 2.0}, "motion": {"brownian": False},
                       "growth": {"rate": 1.0, "rate_deviation": 0.1, "division_length": 4.0}, "solver": SOLVER,
                       "time": {"step": STEP}, "output": {"series_every": 35, "field_every": FIELD_EVERY, "field_spacing": SPACING}},
                equilibration=0, production=FIELD_EVERY * round(end / STEP / FIELD_EVERY))
            for seed in (QUICK_SEEDS if quick else SEEDS)]


def evaluate(report, runs_by_name, quick):
    figure, panel = figures.axes(size=(6.4, 3.2))
    rows, numbers = [], []
    for run in runs_by_name.values():
        place, density, pressure = profile(run)
        inside = density > INSIDE * density.max()
        x, measured = place[inside], pressure[inside]
        curve = numpy.polyfit(x, measured, 2)
        rest = measured - numpy.polyval(curve, x)
        explained = 1.0 - (rest**2).sum() / ((measured - measured.mean())**2).sum()
        expected = 0.5 * density[inside].mean() * growth_of_area(run) * friction(run)
        report.require(f"{run.name}: part of the pressure's variance that a parabola explains", explained, lower=0.97)
        report.compare(f"{run.name}: curvature of the pressure, against n a zeta/2", (-curve[0], 0.0), (expected, 0.0), BOUND)
        rows.append([run.name, f"{run.series()['N'][-1]:.0f}", f"{explained:.4f}", f"{-curve[0]:.3f}", f"{expected:.3f}"])
        numbers += [[run.name, *values] for values in zip(place, density, pressure)]
        middle = -0.5 * curve[1] / curve[0]
        points = panel.plot(x - middle, measured, "o", markersize=3, label=run.name)[0]
        fine = numpy.linspace(x[0], x[-1])
        panel.plot(fine - middle, numpy.polyval(curve, fine), linewidth=0.8, color=points.get_color())
    report.table("The pressure along the channel, in mu times the growth rate.", ["run", "cells", "explained by a parabola", "curvature", "n a zeta/2"], rows)
    panel.set(xlabel="x / D, from the middle", ylabel="stress along the channel")
    panel.legend(frameon=False)
    report.figure(figure, "Stress along the channel; lines are parabolas.")
    report.numbers(["run", "x", "number_density", "stress_xx"], numbers)


def profile(run):
    """x, number density and stress along the channel, means across it and over the last fields."""
    field = structured(run.left.table("field.csv"))
    field = field[numpy.isfinite(field["x"]) & (field["step"] > run.steps - AVERAGED * FIELD_EVERY)]
    place = numpy.unique(field["x"])
    return place, *(numpy.array([field[name][field["x"] == x].mean() for x in place]) for name in ("number_density", "stress_xx"))


def growth_of_area(run):
    """d ln A/dt of all cells over the time of the last fields. Not the rate of cells alone: at a division the two new caps leave out 1 - pi/4 of a square of the diameter, which takes 6 %."""
    series = run.series()
    before = series[series["step"] <= series["step"][-1] - AVERAGED * FIELD_EVERY][-1]
    last = series[-1]
    return numpy.log(last["phi"] / before["phi"]) / (last["time"] - before["time"])


def friction(run):
    """Of a cell of mean area along the channel, from the drag of capsules and the mean square of its axis along x."""
    last = run.series()[-1]
    x, y = run.scene["box"]["edges"]
    length = last["phi"] * x * y / last["N"] - 0.25 * numpy.pi  # of the mean area
    along = 0.5 * (1.0 + last["order_xx"])
    with open(ROOT / "studies/reference/capsule_mobility.csv", encoding="ascii") as file:
        known = list(csv.DictReader(line for line in file if not line.startswith("#")))
    def mobility(name):
        return numpy.interp(length, [float(row["length_over_diameter"]) for row in known], [float(row[name]) for row in known])
    return along / mobility("parallel") + (1.0 - along) / mobility("perpendicular")
