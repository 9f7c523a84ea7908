"""Sheared spheres and rods: the viscosity of collisions and of torques

Event-driven Brownian dynamics, which knows no contact problem, gives viscosity, normal stress difference and Z of spheres at two densities and two rates. What contacts and Brownian rotation turn a
rod back by is what the flow turns it by, exactly, at every density (theory, eq. 8.5). Free rods have the viscosity of Smoluchowski's equation.
"""

import math

import figures
from report import with_error
from runs import Run, error_of_blocks

D0 = 1.0 / (3.0 * math.pi)  # of a sphere, D = kT = viscosity = 1
# phi, rate D2/D0: viscosity, Z, N2 in kT/D3 of event-driven Brownian dynamics, extrapolated to step 0, with errors (nan: not extrapolated)
SPHERES = {(0.30, 2.0): ((0.458, 0.006), (3.999, 0.004), None), (0.30, 20.0): ((0.322, 0.006), (4.794, 0.005), (-0.211, 0.003)),
           (0.45, 2.0): ((3.08, 0.03), (9.66, 0.03), None), (0.45, 20.0): ((1.448, 0.004), (13.33, 0.01), (-0.892, 0.011))}
# L/D = 5, Pe: viscosity D_R/(n kT) of free rods
FREE = {1.0: 0.088689, 5.0: 0.055902, 20.0: 0.014130}
DENSE_RODS = {"length": 3.0, "volume_fraction": 0.25}
COARSE, FINE = 0.06, 0.03
FREE_DENSITY = 1e-4


def runs(quick):
    spheres = [Run(name=f"spheres_{phi:g}_{rate:g}_{rms:g}",
                   scene={"seed": 3, "box": {"volume_fraction": phi}, "rods": {"count": 200 if quick else 500, "length": 0.0},
                          "flow": {"shear_rate": rate * D0}, "time": {"rms_step": rms}},
                   equilibration=round(1.0 / (0.5 * rms**2)), production=round((2.0 if quick else 40.0 / math.sqrt(rate)) / (0.5 * rms**2)))
               for phi, rate in SPHERES if not quick or rate == 20.0 for rms in ([0.05] if quick else [COARSE, FINE])]
    rods = [Run(name=f"rods_{rate:g}",
                scene={"seed": 3, "box": {"volume_fraction": DENSE_RODS["volume_fraction"]}, "rods": {"count": 200 if quick else 600, "length": DENSE_RODS["length"]},
                       "flow": {"shear_rate": rate}, "time": {"rms_step": 0.05}},
                equilibration=2000, production=8000 if quick else 60000)
            for rate in ([0.5] if quick else [0.1, 0.5])]
    free = [Run(name=f"free_{Pe:g}",
                scene={"seed": 3, "box": {"volume_fraction": FREE_DENSITY}, "rods": {"count": 2000, "length": 5.0}, "flow": {"shear_rate": Pe * free_rotation()},
                       "time": {"step": 0.002 / free_rotation()}},
                equilibration=500, production=4000 if quick else 100000)
            for Pe in ([5.0] if quick else FREE)]
    return [*spheres, *rods, *free]


def free_rotation():
    """D_R of L/D = 5, by the mobility model "capsule"."""
    return 0.00651347


def evaluate(report, runs_by_name, quick):
    rows, numbers = [], []
    for (phi, rate), (viscosity, Z, N2) in SPHERES.items():
        measured = {rms: runs_by_name.get(f"spheres_{phi:g}_{rate:g}_{rms:g}") for rms in (0.05, COARSE, FINE)}
        measured = {rms: run for rms, run in measured.items() if run}
        if not measured:
            continue
        found = {name: at_step_0({rms: mean_of(rows_of, run) for rms, run in measured.items()})
                 for name, rows_of in (("viscosity", viscosity_rows), ("Z", lambda run: run.series()["Z"]), ("N2", N2_rows))}
        state = f"spheres, phi {phi:g}, rate {rate:g} D0/D2"
        loose = 3.0 if quick else 1.0  # one step, not extrapolated
        report.compare(f"{state}: viscosity", found["viscosity"], viscosity, 0.03 * loose)
        report.compare(f"{state}: Z", found["Z"], Z, 0.015 * loose)
        if N2:
            report.compare(f"{state}: N2", found["N2"], N2, 0.05 * loose)
        rows.append([f"{phi:g}", f"{rate:g}", *(with_error(*pair) if pair else "" for pair in (found["viscosity"], viscosity, found["Z"], Z, found["N2"], N2))])
        numbers.append(["spheres", phi, rate, *found["viscosity"]])
    report.table("Spheres: viscosity over that of the fluid, Z, and N2 in kT/D3, each with its reference.",
                 ["phi", "rate D2/D0", "viscosity", "reference", "Z", "reference", "N2", "reference"], rows)
    for name, run in runs_by_name.items():
        if name.startswith("rods_"):
            ratio = run.summary["checks"]["torque_ratio"]["measured"]
            report.compare(f"rods L/D = 3, phi 0.25, rate {run.scene['flow']['shear_rate']:g}: stress of torques over what the flow turns", (ratio["mean"], ratio["standard_error"] or math.nan),
                           (1.0, 0.0), 0.0, errors=3)
            numbers.append(["rods", 0.25, run.scene["flow"]["shear_rate"], *mean_of(viscosity_rows, run)])
    figure, panel = figures.axes(size=(5.6, 3.0))
    for Pe, reduced in FREE.items():
        run = runs_by_name.get(f"free_{Pe:g}")
        if not run:
            continue
        volume = math.pi * (5.0 / 4.0 + 1.0 / 6.0)
        scale = free_rotation() / (FREE_DENSITY / volume)
        mean, error = (scale * number for number in mean_of(viscosity_rows, run))
        report.compare(f"free rods L/D = 5, Pe {Pe:g}: viscosity D_R/(n kT)", (mean, error), (reduced, 0.0), 0.015)
        panel.errorbar(Pe, mean, yerr=error, marker="o", color="C0", label="jostle" if Pe == 5.0 else None)
        numbers.append(["free", FREE_DENSITY, Pe, mean, error])
    panel.plot(list(FREE), list(FREE.values()), color="black", linewidth=0.8, label="Smoluchowski's equation")
    panel.set_xscale("log")
    panel.set_xlabel("shear rate / D_R")
    panel.set_ylabel("viscosity D_R/(n kT)")
    panel.legend(frameon=False)
    report.figure(figure, "Viscosity of free rods L/D = 5.")
    report.numbers(["what", "phi", "rate", "viscosity", "viscosity_error"], numbers)


def mean_of(rows_of, run):
    rows = rows_of(run)
    return rows.mean(), error_of_blocks(rows)


def viscosity_rows(run):
    rows = run.series()
    return -(0.5 * (rows["stress_xy"] + rows["stress_yx"]) + rows["stress_orientation_xy"]) / run.scene["flow"]["shear_rate"]


def N2_rows(run):
    rows = run.series()
    return rows["stress_zz"] + rows["stress_orientation_zz"] - rows["stress_yy"] - rows["stress_orientation_yy"]


def at_step_0(by_step):
    """The error of a step goes as the square of its rms."""
    if len(by_step) == 1:
        return next(iter(by_step.values()))
    (coarse, coarse_error), (fine, fine_error) = by_step[COARSE], by_step[FINE]
    return (4.0 * fine - coarse) / 3.0, math.hypot(4.0 * fine_error, coarse_error) / 3.0
