"""Error bars that cover

Twice a standard error promises to hold the truth in 95 of 100 cases. Ensembles of runs that differ in nothing but their seed say whether it does: how the means of Z scatter over the seeds, against the error
that each run reports, and how often the truth lies within two of them. Short runs have to refuse an error bar instead, and tell why. A run has 64 rods (a nematic 100) and long steps, 0.08 D (0.06 D):
its Z is not that of the other studies, and is judged by the mean of its ensemble.
"""

import collections
import math

import figures
import numpy
from runs import Run

SEEDS = 24
QUICK_SEEDS = 8
ROWS = 600            # of the series, at the least: a row is as many steps as that takes
LARGEST_RATIO = 1.2   # of scatter to reported error
LEAST_COVERED = 0.90  # share of the runs with an error bar whose truth lies within two errors
RMS_STEP = 0.08       # coarse, for Z itself is not judged

# name: rods, steps of equilibration, steps of production of short, middle and long runs
STATES = {
    "spheres, phi 0.40": ({"box": {"volume_fraction": 0.40}, "rods": {"count": 64, "length": 0.0}}, 500, (330, 1600, 6400)),
    "L/D 5, phi 0.10": ({"box": {"volume_fraction": 0.10}, "rods": {"count": 64, "length": 5.0}}, 1000, (1200, 8000, 24000)),
    "L/D 5, phi 0.20": ({"box": {"volume_fraction": 0.20}, "rods": {"count": 64, "length": 5.0}}, 2000, (1200, 12000, 36000)),
    "L/D 5, phi 0.35": ({"box": {"volume_fraction": 0.35}, "rods": {"count": 64, "length": 5.0}}, 12000, (3600, 20000, 90000)),
    "L/D 10, phi 0.20": ({"box": {"volume_fraction": 0.20}, "rods": {"count": 64, "length": 10.0}}, 8000, (3000, 20000, 90000)),
    "nematic, L/D 5, phi 0.46": ({"box": {"volume_fraction": 0.46}, "rods": {"count": 100, "length": 5.0, "start": "aligned"}, "time": {"rms_step": 0.06}}, 10000,
                                 (9000, 55000, 110000)),
    "swimmers, L/D 3, phi 0.15": ({"box": {"volume_fraction": 0.15}, "rods": {"count": 64, "length": 3.0},
                                   "motion": {"self_propulsion": 1.0, "tumble_rate": 0.1, "tumble_time": 2.0}}, 2000, (250, 6000, 20000)),
    "sheared, L/D 5, phi 0.15": ({"box": {"volume_fraction": 0.15}, "rods": {"count": 64, "length": 5.0}, "flow": {"shear_rate": 0.02}}, 2000, (1200, 12000, 36000)),
    "growing cells": ({"box": {"volume_fraction": 0.10}, "rods": {"count": 64, "length": 2.0},
                       "growth": {"rate": 0.05, "division_length": 5.0}, "time": {"step": 0.02}}, 0, (2000,)),
}
LENGTHS = ("short", "middle", "long")
QUICK = {("spheres, phi 0.40", "short"), ("spheres, phi 0.40", "middle"), ("L/D 5, phi 0.10", "short"), ("L/D 5, phi 0.10", "middle")}


def runs(quick):
    return [Run(name=f"{name.replace(' ', '_').replace(',', '').replace('/', '')}_{length}_{seed}",
                scene={"seed": seed, "time": {"rms_step": RMS_STEP}, **scene,
                       "output": {"series_every": max(1, min(20, production // ROWS))}},
                equilibration=equilibration, production=production)
            for name, (scene, equilibration, productions) in STATES.items() for length, production in zip(LENGTHS, productions)
            if not quick or (name, length) in QUICK for seed in range(1, (QUICK_SEEDS if quick else SEEDS) + 1)]


Ensemble = collections.namedtuple("Ensemble", "state length Z errors verdicts")


def ensembles(runs_by_name, quick):
    """Of each state and length: Z and error of every seed, nan where there is none, and what was said of equilibrium."""
    for name in STATES:
        for length in LENGTHS:
            if quick and (name, length) not in QUICK:
                continue
            of_state = [run for run in runs_by_name.values()
                        if run.name.startswith(f"{name.replace(' ', '_').replace(',', '').replace('/', '')}_{length}_")]
            if of_state:
                Z, errors = numpy.array([run.value_if_any("Z") for run in of_state]).T
                yield Ensemble(name, length, Z, errors, [run.summary["equilibrium"]["verdict"] for run in of_state])


def evaluate(report, runs_by_name, quick):
    rows, numbers, held, ratios = [], [], [], []
    found = list(ensembles(runs_by_name, quick))
    truth = {one.state: one.Z.mean() for one in found}  # of the longest ensemble: the last one counts
    for one in found:
        with_bar = numpy.isfinite(one.errors)
        said = ", ".join(f"{verdict} {count}" for verdict, count in collections.Counter(one.verdicts).most_common())
        row = [one.state, one.length, f"{one.Z.mean():.3f}", f"{one.Z.std(ddof=1):.3f}", f"{with_bar.sum()} of {len(one.Z)}"]
        if with_bar.sum() < 3:
            rows.append([*row, "", "", "", said])
            numbers.append([one.state, one.length, one.Z.mean(), one.Z.std(ddof=1), int(with_bar.sum()), "", "", ""])
            continue
        Z, errors = one.Z[with_bar], one.errors[with_bar]
        inside = numpy.abs(Z - truth[one.state]) < 2.0 * errors
        scatter = math.sqrt(numpy.mean((Z - truth[one.state])**2))
        ratio = scatter / errors.mean()
        held.extend(inside)
        ratios.extend([ratio] * len(Z))
        rows.append([*row, f"{errors.mean():.3f}", f"{ratio:.2f}", f"{inside.sum()} of {len(inside)}", said])
        numbers.append([one.state, one.length, one.Z.mean(), one.Z.std(ddof=1), int(with_bar.sum()), errors.mean(), ratio, inside.mean()])
        of = f"{one.state}, {one.length}"
        # The scatter of n means is known to its part 1/sqrt(2 n), a share of n runs to sqrt(p (1 - p)/n): two of these are
        # allowed to one ensemble, none to all together.
        report.require(f"{of}: scatter over reported error", ratio, upper=LARGEST_RATIO * (1.0 + 2.0 / math.sqrt(2.0 * len(Z))))
        report.require(f"{of}: share within two errors", inside.mean(),
                       lower=LEAST_COVERED - 2.0 * math.sqrt(LEAST_COVERED * (1.0 - LEAST_COVERED) / len(inside)))
    if held:
        report.require("all ensembles: share within two errors", numpy.mean(held), lower=LEAST_COVERED)
        report.require("all ensembles: scatter over reported error, root mean square", math.sqrt(numpy.mean(numpy.square(ratios))),
                       upper=LARGEST_RATIO)
    for one in found:
        if one.length == "short" or one.state == "growing cells":
            report.require(f"{one.state}, {one.length}: share with an error bar", numpy.isfinite(one.errors).mean(), upper=0.10)
    report.table("Ensembles that differ in their seed: mean of Z, its scatter over the seeds, how many runs got an error bar, and of these the mean error, the root mean square distance from the truth over it, and how many "
                 "lie within two errors of the truth. The truth is the mean of the longest ensemble of the state. Last, what the runs said of equilibrium.",
                 ["state", "production", "Z", "scatter", "error bars", "mean error", "ratio", "within two", "equilibrium"], rows)
    report.numbers(["state", "production", "Z", "scatter", "with_error_bar", "mean_error", "ratio", "covered"], numbers)
    if held:
        report.remark(f"Of {len(held)} error bars {sum(held)} hold the truth within twice their length, {100 * numpy.mean(held):.1f} %; "
                      f"over all, means scatter by {math.sqrt(numpy.mean(numpy.square(ratios))):.2f} times the error that is reported. The ratio of one "
                      f"ensemble of n runs is known to its part 1/sqrt(2 n): of 24 to 14 %.")
    draw(report, found, truth)


def draw(report, found, truth):
    figure, panel = figures.axes(size=(6.4, 0.45 * len(found) + 1.2))
    for place, one in enumerate(found):
        spread = numpy.linspace(-0.3, 0.3, len(one.Z))
        for Z, error, offset in zip(one.Z, one.errors, spread):
            colour = "0.6" if not math.isfinite(error) else "C0" if abs(Z - truth[one.state]) < 2.0 * error else "C3"
            panel.errorbar(100 * (Z / truth[one.state] - 1), place + offset, marker="o", markersize=2, linewidth=0.7, color=colour,
                           xerr=None if not math.isfinite(error) else 200 * error / truth[one.state])
    panel.axvline(0.0, color="black", linewidth=0.8)
    panel.set_yticks(range(len(found)), [f"{one.state}, {one.length}" for one in found], fontsize=7)
    panel.set_ylim(len(found) - 0.5, -0.5)
    panel.set_xlim(-12, 12)
    panel.set_xlabel("difference of Z from that of the longest runs, %")
    report.figure(figure, "Every run, with twice its standard error where it has one (blue: holds the truth, red: does not); grey: no error bar.")
