"""Monolayers: Z of discs and of discorectangles in two dimensions

Hard discs have a virial series, and discorectangles a second virial coefficient, that are known (theory, eq. 9.7). Monte Carlo that knows no contact problem gives Z of discorectangles L/D = 5 at three
area fractions. In equilibrium the whole stress is isotropic, and the anisotropy of that of collisions follows from Z and S (theory, eq. 9.5).
"""

import math

import figures
from report import with_error
from runs import Run

COUNT = {0.0: 400, 5.0: 300}
# Discs: virial series to B10 with a linear tail. L/D = 5: Monte Carlo of 300 (studies/reference of walls and planes).
REFERENCE = {(0.0, 0.3): (2.06326, 2e-5), (0.0, 0.5): (4.1063, 0.003), (0.0, 0.6): (6.457, 0.018),
             (5.0, 0.2): (2.068, 0.0044), (5.0, 0.4): (4.317, 0.0078), (5.0, 0.5): (6.148, 0.014)}
DILUTE = {0.0: 2.0, 5.0: 3.375488}  # B2/a
DILUTE_FRACTION = 0.002
TOLERANCE = {0.0: 0.005, 5.0: 0.007}


def runs(quick):
    dense = [Run(name=f"{name_of(length)}_{fraction}", scene=scene_of(length, fraction, COUNT[length]),
                 equilibration=2000, production=(40_000 if length == 0.0 else 400_000) // (8 if quick else 1))
             for length, fraction in REFERENCE if not quick or fraction in (0.3, 0.2)]
    dilute = [Run(name=f"dilute_{name_of(length)}", scene=scene_of(length, DILUTE_FRACTION, 4000), equilibration=100, production=60_000)
              for length in DILUTE if not quick]
    return [*dense, *dilute]


def name_of(length):
    return "discs" if length == 0.0 else f"rods_{length:.0f}"


def scene_of(length, fraction, count):
    return {"seed": 6, "box": {"dimensions": 2, "area_fraction": fraction}, "rods": {"count": count, "length": length}}


def evaluate(report, runs_by_name, quick):
    rows, numbers = [], []
    for name, run in runs_by_name.items():
        length, fraction = run.scene["rods"]["length"], run.scene["box"]["area_fraction"]
        Z, error = run.value("Z")
        if name.startswith("dilute"):
            area = length + math.pi / 4.0
            slope = ((Z - 1.0) / (fraction / area), error / (fraction / area))
            # The third coefficient of discs is 3.128 a^2; that of rods is some ten times the area squared.
            expected = (DILUTE[length] * area, 10.0 * fraction * area)
            report.compare(f"L/D = {length:g}, area fraction {fraction}: (Z - 1)/n, B2", slope, expected, 0.02)
            rows.append([f"{length:g}", fraction, with_error(*slope), with_error(*expected), "(Z - 1)/n"])
            continue
        reference = REFERENCE[length, fraction]
        report.compare(f"L/D = {length:g}, area fraction {fraction}: Z", (Z, error), reference, TOLERANCE[length])
        rows.append([f"{length:g}", fraction, with_error(Z, error), with_error(*reference), f"{100 * (Z / reference[0] - 1):+.2f} %"])
        numbers.append([length, fraction, Z, error, *reference])
    report.table("Z of discs and of discorectangles on a plane; last lines: second virial coefficients.",
                 ["L/D", "area fraction", "measured", "reference", "difference"], rows)
    report.numbers(["L_over_D", "area_fraction", "Z", "Z_error", "reference", "reference_error"], numbers)
    figure, panel = figures.axes(size=(5.6, 3.0))
    for k, length in enumerate(COUNT):
        found = [row for row in numbers if row[0] == length]
        panel.plot([row[1] for row in found], [row[4] for row in found], color=f"C{k}", linewidth=0.8)
        panel.errorbar([row[1] for row in found], [row[2] for row in found], yerr=[row[3] for row in found], marker="o", linestyle="none",
                       color=f"C{k}", label=f"L/D = {length:g}")
    panel.set_xlabel("area fraction")
    panel.set_ylabel("Z")
    panel.legend(frameon=False)
    report.figure(figure, "Z of discs and discorectangles on a plane (points), virial series and Monte Carlo (lines).")
