"""Jamming

Bodies without thermal motion are compressed by a bath of pressure until they bear it. Spheres jam at random close packing with as many contacts as keep them rigid; spherocylinders a little longer than spheres fill more. Does
the program find both, at the pressure of the bath, with forces that have no scale of their own?
"""

import math

import numpy

import figures
from report import with_error
from runs import Run, structured

LENGTHS, QUICK_LENGTHS = (0.0, 0.2, 0.45, 0.7, 1.0, 2.0, 3.0), (0.0, 0.45)
SEEDS, QUICK_SEEDS = (1, 2, 3, 4), (1, 2)
COUNT, QUICK_COUNT = 400, 100
STEPS, QUICK_STEPS = 4000, 1500
TOLERANCE = 1e-7      # of a diameter
FINE_TOLERANCE = 1e-9  # of spheres, whose contacts are counted: at 1e-7 one of a thousand is none, but a pair that nearly touches
STEP = 1.0            # a hundredth of the time in which nothing would resist: 100 viscosities over the pressure
# Spheres and the maximum of the curve: Imaz Gonzalez et al., J. Phys. Chem. B 127, 6814 (2023), and random close packing. Of N bodies in a
# periodic box the fraction is lower, by some 0.01 for 100.
SPHERES, MAXIMUM = (0.62, 0.648), (0.69, 0.73)
QUICK_SPHERES, QUICK_MAXIMUM = (0.60, 0.65), (0.66, 0.73)
AT_REST = 1e-3        # of the pressure
BEARING = 1e-5        # of the mean force: contacts that count


def runs(quick):
    return [Run(name=f"L{length:g}_seed{seed}",
                scene={"seed": seed, "box": {"volume_fraction": 0.3}, "rods": {"count": QUICK_COUNT if quick else COUNT, "length": length},
                       "fluid": {"kT": 0.0}, "pressure": {"external": 1.0}, "solver": {"tolerance": TOLERANCE if length else FINE_TOLERANCE, "max_iterations": 1000000},
                       "time": {"step": STEP}, "output": {"contacts": True, "series_every": 20, "trajectory_every": 0}},
                equilibration=0, production=QUICK_STEPS if quick else STEPS)
            for length in (QUICK_LENGTHS if quick else LENGTHS) for seed in (QUICK_SEEDS if quick else SEEDS)]


def evaluate(report, runs_by_name, quick):
    by_length, rows, numbers = {}, [], []
    for run in runs_by_name.values():
        length = run.scene["rods"]["length"]
        last = run.summary["pressure_control"]["last"]
        contacts, bearing = backbone(run)
        report.compare(f"{run.name}: pressure over that of the bath", (last["pressure_over_external"], 0.0), (1.0, 0.0), AT_REST)
        if length == 0.0:
            report.require(f"{run.name}: contacts with a force, less 3 N' - 2", contacts - (3 * bearing - 2), lower=0, upper=0)
        by_length.setdefault(length, []).append((last["volume_fraction"], 2.0 * contacts / bearing))
        numbers.append([length, run.scene["seed"], last["volume_fraction"], contacts, bearing, last["pressure_over_external"]])
    fractions = {}
    for length, found in by_length.items():
        fraction, coordination = numpy.array(found).T
        fractions[length] = (fraction.mean(), fraction.std(ddof=1) / math.sqrt(len(fraction)))
        rows.append([f"{length:g}", with_error(*fractions[length]), f"{coordination.mean():.3f}"])
    low, high = QUICK_SPHERES if quick else SPHERES
    report.require("spheres: volume fraction", fractions[0.0][0], lower=low, upper=high)
    low, high = QUICK_MAXIMUM if quick else MAXIMUM
    report.require("L/D = 0.45: volume fraction", fractions[0.45][0], lower=low, upper=high)
    report.require("L/D = 0.45, less that of spheres", fractions[0.45][0] - fractions[0.0][0], lower=0.045)
    report.table("Jammed packings: volume fraction, and contacts of a body that bears force (rows of parallel ones count as two).",
                 ["L/D", "volume fraction", "contacts"], rows)
    report.numbers(["L_over_D", "seed", "volume_fraction", "contacts", "bearing", "pressure_over_external"], numbers)
    figure, panel = figures.axes(size=(5.0, 3.2))
    lengths = sorted(fractions)
    panel.errorbar(lengths, [fractions[one][0] for one in lengths], [2.0 * fractions[one][1] for one in lengths], fmt="o-", capsize=2)
    panel.set(xlabel="L/D", ylabel="volume fraction")
    report.figure(figure, "Volume fraction of jammed packings; two standard errors of the packings.")


def backbone(run):
    """(contacts with a force, bodies that have some) at the last row."""
    rows = structured(run.left.table("contacts.csv"))
    rows = rows[rows["step"] == rows["step"].max()]
    rows = rows[rows["force"] > BEARING * rows["force"].mean()]
    return len(rows), len(numpy.union1d(rows["id_i"], rows["id_j"]))
