"""Pressure of isotropic rods, L/D = 5

Eight volume fractions against Monte Carlo, in a few minutes: what ./quickstart runs. Production is at least ten times the time in which free rods forget
their direction: an error bar cannot know of fluctuations slower than the run.
"""

import math

import figures
import reference_values
from report import with_error
from runs import Run

from replicas import mean_of  # of sweeps/, which runs.py adds to the path

BETA = 5
POINTS = {  # volume fraction: steps of equilibration (a random start near the transition orders slowly) and production
    0.05: (2000, 62000), 0.10: (2000, 26000), 0.15: (3000, 26000), 0.20: (3500, 26000), 0.25: (4500, 45000),
    0.30: (7000, 26000), 0.35: (17000, 55000), 0.40: (35000, 140000)}
SEEDS = {0.40: (1, 2)}  # of runs side by side, where one would take too long; else 1
QUICK_POINTS = (0.10, 0.20)
LARGEST_RELATIVE_ERROR = 0.005
TOLERANCE = 0.01  # of Z, beside two combined standard errors: for the time step and the finite number of rods


def runs(quick):
    return [Run(name=f"phi_{phi:.2f}_{seed}",
                scene={"seed": seed, "box": {"volume_fraction": phi}, "rods": {"count": 500, "length": float(BETA)},
                       "solver": {"tolerance": 1e-4}},
                equilibration=equilibration, production=production)
            for phi, (equilibration, production) in POINTS.items() if not quick or phi in QUICK_POINTS
            for seed in SEEDS.get(phi, (1,))]


def evaluate(report, runs_by_name, _):
    rows, numbers, points = [], [], []
    by_phi = {}
    for run in runs_by_name.values():
        by_phi.setdefault(run.scene["box"]["volume_fraction"], []).append(run)
    for phi, at_phi in by_phi.items():
        mean = mean_of(*zip(*(run.value("Z") for run in at_phi)))
        Z, error = mean.value, mean.within
        reference = reference_values.monte_carlo_at(BETA, phi)
        both = math.hypot(error, reference.Z_error)
        report.compare(f"phi = {phi:.2f}: Z", (Z, error), (reference.Z, reference.Z_error), TOLERANCE)
        report.require(f"phi = {phi:.2f}: standard error of Z over Z", error / Z, upper=LARGEST_RELATIVE_ERROR)
        rows.append([f"{phi:.2f}", f"{Z:.3f}", f"{error:.3f} ({100 * error / Z:.2f} %)",
                     with_error(reference.Z, reference.Z_error), f"{100 * (Z / reference.Z - 1):+.2f}",
                     f"{(Z - reference.Z) / both:+.1f}"])
        numbers.append([phi, Z, error, reference.Z, reference.Z_error, 100 * (Z / reference.Z - 1), (Z - reference.Z) / both])
        points.append((phi, Z, error, reference, both))
    some = next(iter(runs_by_name.values()))
    steps = sum(run.record["steps"] for run in runs_by_name.values())
    report.table(f"{some.summary['rods']} rods L/D = {BETA}, rms step 0.04 D, {steps} steps in all; standard errors are corrected for correlation, and the "
                 "difference is also given in combined standard errors, those of Z and of the reference.",
                 ["phi", "Z", "standard error", "reference Z", "difference, %", "in standard errors"], rows)
    report.numbers(["phi", "Z", "standard_error", "reference_Z", "reference_standard_error", "difference_per_cent",
                 "difference_in_standard_errors"], numbers)
    report.remark(claim(numbers))
    draw(report, points)


def claim(numbers):
    """In how many states the bound holds, and the state that comes nearest to it or is farthest beyond."""
    parts = []  # (|Z - Z_ref| over what is allowed, the state in words)
    for phi, Z, error, reference, reference_error, per_cent, errors in numbers:
        allowed = TOLERANCE * reference + 2 * math.hypot(error, reference_error)
        parts.append((abs(Z - reference) / allowed, f"phi = {phi:.2f}, {per_cent:+.2f} %, {errors:+.1f} combined standard errors"))
    return (f"|Z - Z_ref| <= {100 * TOLERANCE:g} % of Z_ref + 2 combined standard errors holds in {sum(part <= 1 for part, _ in parts)} of "
            f"{len(numbers)} states. The worst case is {max(parts)[1]}.")


def draw(report, points):
    figure, (pressure, difference) = figures.axes(2, 1, size=(5.6, 5.2), sharex=True, height_ratios=[3, 1])
    phi, Z, error, reference, both = zip(*points)
    pressure.errorbar(phi, Z, error, color="C0", marker="o", markersize=4, linewidth=1.2, label="jostle")
    pressure.errorbar(phi, [r.Z for r in reference], [r.Z_error for r in reference], color="black", marker="s",
                      markersize=9, markerfacecolor="none", linestyle="none", label="Monte Carlo")
    pressure.set(ylabel="Z = P/(n kT)", ylim=(0, None))
    pressure.legend(loc="upper left")
    pressure.set_title("Isotropic hard rods, L/D = 5", loc="left")
    per_cent = [100 * (z / r.Z - 1) for z, r in zip(Z, reference)]
    bars = [100 * b / r.Z for b, r in zip(both, reference)]
    difference.axhline(0.0, color="black", linewidth=0.8)
    difference.errorbar(phi, per_cent, bars, color="C0", marker="o", markersize=4, linestyle="none", capsize=2)
    largest = max(2.0, *(abs(d) + b for d, b in zip(per_cent, bars)))
    difference.set(ylim=(-1.1 * largest, 1.1 * largest), ylabel="difference, %", xlabel="volume fraction")
    report.figure(figure, "Z with its standard error, Monte Carlo, and the difference.")
