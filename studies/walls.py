"""Rods between walls: the pressure on them is the stress at them

Equilibrium demands that the pressure on a wall is the whole stress along its normal, at every density (theory, eq. 6.4), that this stress is the same at every height of a slit, and for rods that do
not meet in a slit a pressure that is known exactly (theory, eq. 6.5). Monte Carlo that knows no contact problem gives the pressure in three dense states.
"""

import math

import numpy

import figures
from report import with_error
from runs import Run, error_of_blocks

SLIT = {"box": {"edges": [21.0, 21.0, 14.0], "periodic": [True, True, False]}, "walls": {"faces": [False, False, True]}}
SPHERE = {"box": {"edges": [10.0, 10.0, 10.0], "periodic": [False, False, False]}, "walls": {"container": "sphere"}}
TUBE = {"box": {"edges": [20.0, 6.0, 6.0], "periodic": [True, False, False]}, "walls": {"container": "tube"}}
VOLUME = {"slit": 21.0 * 21.0 * 14.0, "sphere": 4.0 / 3.0 * math.pi * 5.0**3, "tube": math.pi * 3.0**2 * 20.0}
LENGTH = {"slit": 5.0, "sphere": 2.0, "tube": 2.0}
COUNTS = {"slit": (100, 200, 300), "sphere": (20, 40, 60), "tube": (27, 54, 80)}
# Monte Carlo: kT/D3; sphere: the sum of forces 185.8(3) kT/D over its area.
PRESSURE = {("slit", 300): (0.2639, 0.0004), ("sphere", 60): (185.8 / (100 * math.pi), 0.3 / (100 * math.pi))}
IDEAL = 7.0 + 1.0, 7.0 - 2.5  # H and a - L/2 of L/D = 5 in a slit of 8 D
LAYERS = 8
PROFILED = 320000  # steps of the slit that is looked at layer by layer
ENOUGH_FIELDS = 20  # fewer do not tell the error of a layer well enough for chi squared


def runs(quick):
    steps = 8 if quick else 1
    dense = [Run(name=f"{walls}_{count}",
                 scene={"seed": 5, **{"slit": SLIT, "sphere": SPHERE, "tube": TUBE}[walls],
                        "rods": {"count": count, "length": LENGTH[walls]}, "time": {"rms_step": 0.06},
                        **({"output": {"field_every": 2000, "field_spacing": 14.0 / LAYERS}} if (walls, count) == ("slit", 300) else {})},
                 equilibration=2000, production=(PROFILED if (walls, count) == ("slit", 300) else 80000 if walls == "slit" else 120000) // steps)
             for walls, counts in COUNTS.items() for count in counts[-1 if quick else 0:]]
    ideal = Run(name="ideal_slit",
                scene={"seed": 5, "box": {"edges": [1e5, 1e5, 8.0], "periodic": [True, True, False]}, "walls": SLIT["walls"],
                       "rods": {"count": 1500, "length": 5.0}, "time": {"rms_step": 0.1}},
                equilibration=10, production=20000 // steps)
    return [*dense, ideal]


def evaluate(report, runs_by_name, quick):
    rows, numbers = [], []
    for name, run in runs_by_name.items():
        walls, count = name.split("_")[0], run.scene["rods"]["count"]
        if walls == "ideal":
            continue
        series = run.series()
        pressure, stress = wall_pressure(walls, series), normal_stress(walls, count, series)
        measured, normal = with_blocks(pressure), with_blocks(stress)
        ratio = 1.0 + (pressure - stress).mean() / normal[0], error_of_blocks(pressure - stress) / normal[0]
        report.compare(f"{walls}, {count} rods: wall pressure over the stress along the normal", ratio, (1.0, 0.0), 0.0, errors=3)
        reference = PRESSURE.get((walls, count))
        if reference:
            report.compare(f"{walls}, {count} rods: wall pressure against Monte Carlo", measured, reference, 0.01)
        rows.append([walls, count, with_error(*measured), with_error(*normal), with_error(*ratio), with_error(*reference) if reference else ""])
        numbers.append([walls, count, *measured, *normal, *ratio])
    ideal = with_blocks(wall_pressure("slit", runs_by_name["ideal_slit"].series()))
    density = 1500 / (1e10 * IDEAL[0])
    ideal = ideal[0] / density, ideal[1] / density
    report.compare("slit, rods that do not meet: wall pressure over n kT", ideal, (IDEAL[0] / IDEAL[1], 0.0), 0.01)
    report.table("Pressure on the walls, whole stress along their normal, their ratio, and Monte Carlo; kT/D3. Last line: over n kT, and exact.",
                 ["walls", "rods", "wall pressure", "normal stress", "ratio", "reference"],
                 [*rows, ["slit", "ideal", with_error(*ideal), "", "", f"{IDEAL[0] / IDEAL[1]:.6f}"]])
    report.numbers(["walls", "rods", "wall_pressure", "wall_pressure_error", "normal_stress", "normal_stress_error", "ratio", "ratio_error"], numbers)
    height, layers = layers_of(runs_by_name["slit_300"])
    profile, error = layers.mean(axis=0), layers.std(axis=0, ddof=1) / math.sqrt(len(layers))
    inner = layers[:, 1:-1]  # the field is cut at the walls
    pressure = with_blocks(wall_pressure("slit", runs_by_name["slit_300"].series()))
    if len(layers) >= ENOUGH_FIELDS:
        chi_squared = chi_squared_of_differences(inner)
        report.require(f"slit, 300 rods: chi squared of the differences of the normal stress between {LAYERS - 2} layers", chi_squared, upper=15.09)
        report.remark(f"Across the slit the stress along its normal is {inner.mean():.4f} kT/D3 in the {LAYERS - 2} inner layers, with chi squared {chi_squared:.1f} for {LAYERS - 3} degrees of freedom (above 15.09 by chance once in a hundred). "
                      "Layers fluctuate together, as noise pushes all rods to one wall or the other: their covariance counts.")
    figure, panel = figures.axes(size=(5.6, 3.0))
    panel.errorbar(height, profile, yerr=error, marker="o", linestyle="none", color="C0", label="stress along the normal")
    panel.axhline(pressure[0], color="black", linewidth=0.8, label="pressure on the walls")
    panel.set_xlabel("z/D")
    panel.set_ylabel("kT/D3")
    panel.legend(frameon=False)
    report.figure(figure, "Whole stress along the normal of a slit, by layers, and the pressure on its walls. 300 rods L/D = 5. The two outer layers are cut by the walls.")


def with_blocks(values):
    return values.mean(), error_of_blocks(values)


def wall_pressure(walls, series):
    return series["wall_pressure_z" if walls == "slit" else "wall_pressure"]


def normal_stress(walls, count, series):
    """The whole stress along the normal, row by row; kT = 1."""
    diagonal = [series[f"stress_{k}{k}"] + series[f"stress_orientation_{k}{k}"] + count / VOLUME[walls] for k in "xyz"]
    return {"slit": diagonal[2], "sphere": sum(diagonal) / 3, "tube": (diagonal[1] + diagonal[2]) / 2}[walls]


def chi_squared_of_differences(layers):
    """Of the mean differences between neighbouring layers against 0, by their covariance: Hotelling's T squared, times (n - p)/(n - 1) for n fields and p differences.

    (H. Hotelling, Ann. Math. Stat. 2, 360 (1931).) Over p this is of the distribution F(p, n - p); for many fields it is chi squared, and a limit of that is a little strict.
    """
    difference = numpy.diff(layers, axis=1)
    fields, count = difference.shape
    mean, covariance = difference.mean(axis=0), numpy.cov(difference.T)
    return fields * mean @ numpy.linalg.solve(covariance, mean) * (fields - count) / (fields - 1)


def layers_of(run):
    """Heights of the layers, and (fields, layers) their whole stress along z."""
    field = run.left.table("field.csv")
    inside = numpy.isfinite(field["x"]) & (field["step"] > run.equilibration)
    stress = (field["stress_zz"] + field["stress_orientation_zz"] + field["number_density"])[inside]
    steps, z = field["step"][inside], field["z"][inside]
    heights = numpy.unique(z)
    return heights, numpy.array([[stress[(steps == step) & (z == height)].mean() for height in heights] for step in numpy.unique(steps)])
