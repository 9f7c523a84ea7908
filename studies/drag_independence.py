"""The drag does not change the pressure

Equilibrium cannot depend on how rods move through the fluid. Is Z the same for all drag models and two viscosities?
"""

import math

import figures
from report import with_error
from runs import Run

BETA, PHI = 5, 0.30
QUICK_PHI = 0.10  # where a short run covers some rotation times
VARIANTS = {  # name: model, viscosity, kT
    "capsule": ("capsule", 1.0, 1.0),
    "capsule, viscosity 20, kT 3": ("capsule", 20.0, 3.0),
    "finite aspect ratio": ("finite_aspect_ratio", 1.0, 1.0),
    "slender body": ("slender_body", 1.0, 1.0),
}


def runs(quick):
    return [Run(name=name.replace(" ", "_").replace(",", ""),
                scene={"seed": 10 + number, "box": {"volume_fraction": QUICK_PHI if quick else PHI},
                       "rods": {"count": 200 if quick else 1000, "length": float(BETA)},
                       "fluid": {"viscosity": viscosity, "kT": kT}, "mobility": {"model": model},
                       "solver": {"tolerance": 1e-4}},
                equilibration=2000 if quick else 10000,
                production=30000 if quick else 50000)
            for number, (name, (model, viscosity, kT)) in enumerate(VARIANTS.items())]


def evaluate(report, runs_by_name, quick):
    phi = QUICK_PHI if quick else PHI
    values = [run.value("Z") for run in runs_by_name.values()]
    weights = [1 / error**2 for _, error in values]
    mean = sum(weight * Z for weight, (Z, _) in zip(weights, values)) / sum(weights)
    chi2 = sum(weight * (Z - mean)**2 for weight, (Z, _) in zip(weights, values))
    degrees = len(values) - 1
    rows = [[name, with_error(*value), f"{(value[0] - mean) / value[1]:+.1f}"] for name, value in zip(VARIANTS, values)]
    report.table(f"Z of L/D = {BETA}, phi = {phi}, and its distance from the weighted mean {mean:.3f} in standard errors.",
                 ["drag", "Z", "distance"], rows)
    report.numbers(["drag", "Z", "standard_error"], [[name, *value] for name, value in zip(VARIANTS, values)])
    report.require(f"chi squared of {len(values)} values about their mean", chi2, upper=11.34)
    smallest_visible = 2 * math.sqrt(2) * max(error for _, error in values) / mean
    report.remark(f"chi squared is {chi2:.2f} for {degrees} degrees of freedom (above 11.34 by chance once in a hundred). A difference of two values by "
                  f"{100 * smallest_visible:.1f} % would have been seen.")
    figure, panel = figures.axes(size=(5.6, 2.6))
    panel.errorbar([Z for Z, _ in values], range(len(values)), xerr=[error for _, error in values], marker="o",
                   linestyle="none", color="C0")
    panel.axvline(mean, color="black", linewidth=0.8)
    panel.set_yticks(range(len(values)), VARIANTS, fontsize=8)
    panel.set_ylim(len(values) - 0.5, -0.5)
    panel.set_xlabel("Z")
    report.figure(figure, f"Z with its standard error; the line is the weighted mean. L/D = {BETA}, phi = {phi}.")
