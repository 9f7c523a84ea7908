"""Swimmers between walls: the mechanical pressure of spheres is a state function, that of rods is not

Spheres feel no torque at a wall. In a steady state the pressure on the walls is then the whole stress along their normal with the active stress, in any container and at any density (theory, eq. 6.10), and in a
wide slit it is that of a periodic box of the density in its middle. A hard wall turns rods along it, and a wall that does not turn them is pressed otherwise: the pressure depends on the wall (Solon et al., Nature Physics 11, 673
(2015)). Without swimming both walls are pressed alike.
"""

import math

import numpy

import figures
from report import with_error
from runs import Run, error_of_blocks, jackknife_error

MOBILITY, ROTATION = 1.0 / (3.0 * math.pi), 1.0 / math.pi  # of a sphere, D = kT = viscosity = 1
SPHERE = {"box": {"edges": [10.0, 10.0, 10.0], "periodic": [False, False, False]}, "walls": {"container": "sphere"}}
TUBE = {"box": {"edges": [20.0, 6.0, 6.0], "periodic": [True, False, False]}, "walls": {"container": "tube"}}
SLIT = {"box": {"edges": [10.0, 10.0, 8.0], "periodic": [True, True, False]}, "walls": {"faces": [False, False, True]}}
CROWDS = {"sphere": (SPHERE, math.pi / 6.0 * 1000.0), "tube": (TUBE, math.pi * 9.0 * 20.0), "slit": (SLIT, 800.0)}
FRACTIONS, QUICK_FRACTIONS = (0.1, 0.3), (0.2,)
CROWD_SPEED = 2.0
# A slit wider than the way on which a swimmer keeps its direction, speed/D_R.
HEIGHT, WIDTH, DILUTE = 18.0, 36.0, 0.005
ROD = 2.0  # L/D
SPEEDS, QUICK_SPEEDS = (0.0, 0.5, 1.0), (0.0, 1.0)
KINDS = ((0.0, True), (ROD, True), (ROD, False))  # L/D, and whether walls turn rods
LAYER = 3.0
BLOCKS = 8  # each longer than a swimmer takes from wall to wall
APART = 5.0  # standard errors by which the two kinds of walls differ for rods that swim


def runs(quick):
    crowds = [Run(name=f"crowd_{name}_{fraction:g}",
                  scene={"seed": 8, **scene, "rods": {"count": round(fraction * volume / (math.pi / 6.0)), "length": 0.0},
                         "motion": {"self_propulsion": CROWD_SPEED}, "time": {"rms_step": 0.05}},
                  equilibration=4000, production=20000 if quick else 120000)
              for name, (scene, volume) in CROWDS.items() for fraction in (QUICK_FRACTIONS if quick else FRACTIONS)]
    speeds = QUICK_SPEEDS if quick else SPEEDS
    slits = [dilute(length, torque, speed, quick) for length, torque in KINDS for speed in speeds]
    return [*crowds, *slits, *(bulk(speed, quick) for speed in speeds)]


def bulk(speed, quick):
    """Spheres of the same density in a periodic box."""
    run = dilute(0.0, True, speed, quick)
    scene = {key: value for key, value in run.scene.items() if key not in ("walls", "output")}
    scene["box"] = {"edges": run.scene["box"]["edges"]}
    return Run(name=f"bulk_{speed:g}", scene=scene, equilibration=run.equilibration, production=run.production)


def dilute(length, torque, speed, quick):
    count = round(DILUTE * WIDTH * WIDTH * HEIGHT / (math.pi / 6.0 + math.pi / 4.0 * length))
    return Run(name=name_of(length, torque, speed),
               scene={"seed": 8, "box": {"edges": [WIDTH, WIDTH, HEIGHT], "periodic": [True, True, False]},
                      "walls": {"faces": [False, False, True], "torque": torque}, "rods": {"count": count, "length": length},
                      **({"motion": {"self_propulsion": speed}} if speed else {}), "time": {"rms_step": 0.06},
                      "output": {"field_every": 2500, "field_spacing": LAYER}},
               equilibration=10000, production=60000 if quick else 600000)


def name_of(length, torque, speed):
    return f"{'rods' if length else 'spheres'}{'' if torque else '_not_turned'}_{speed:g}"


def evaluate(report, runs_by_name, quick):
    crowd_rows, numbers = [], []
    for name, run in runs_by_name.items():
        if not name.startswith("crowd"):
            continue
        walls, fraction = name.split("_")[1:]
        series = run.series()
        pressure, stress = wall_pressure(walls, series), whole_normal_stress(walls, run.scene["rods"]["count"] / CROWDS[walls][1], series)
        ratio = 1.0 + (pressure - stress).mean() / stress.mean(), error_of_blocks(pressure - stress) / stress.mean()
        report.compare(f"spheres that swim, {walls}, volume fraction {fraction}: wall pressure over whole and active stress", ratio, (1.0, 0.0), 0.01, errors=3)
        crowd_rows.append([walls, fraction, with_error(pressure.mean(), error_of_blocks(pressure)), with_error(stress.mean(), error_of_blocks(stress)), with_error(*ratio)])
        numbers.append([name, pressure.mean(), error_of_blocks(pressure), *ratio])
    report.table(f"Spheres that swim at {CROWD_SPEED:g} kT/(mu D2): pressure on the walls, whole and active stress along their normal, kT/D3, and their ratio.",
                 ["walls", "volume fraction", "wall pressure", "stress", "ratio"], crowd_rows)
    rows, by_kind = [], {}
    for length, torque in KINDS:
        for speed in QUICK_SPEEDS if quick else SPEEDS:
            name = name_of(length, torque, speed)
            ratio = over_density(runs_by_name[name])
            by_kind.setdefault((length, torque), {})[speed] = ratio
            numbers.append([name, *ratio, math.nan, math.nan])
    for speed, ratio in by_kind[0.0, True].items():
        of_bulk = whole_pressure_of_bulk(runs_by_name[f"bulk_{speed:g}"])
        report.compare(f"spheres, speed {speed:g}: wall pressure over n kT in the middle, against a periodic box", ratio, of_bulk, 0.01, errors=3)
        turned, not_turned = by_kind[ROD, True][speed], by_kind[ROD, False][speed]
        apart = (turned[0] - not_turned[0]) / math.hypot(turned[1], not_turned[1])
        if speed == 0.0:
            report.compare("rods at rest: walls that turn them and walls that do not", turned, not_turned, 0.0, errors=3)
        else:
            report.require(f"rods, speed {speed:g}: standard errors between walls that turn them and walls that do not", abs(apart), lower=APART)
        rows.append([f"{speed:g}", with_error(*ratio), with_error(*of_bulk), f"{ideal(speed):.3f}", with_error(*turned), with_error(*not_turned)])
    report.table(f"A slit of {HEIGHT:g} D, dilute: wall pressure over n kT in its middle, of spheres, of a periodic box and of spheres that do not meet; and of rods L/D = {ROD:g} before hard walls and before walls that turn no rod.",
                 ["speed", "spheres", "periodic", "ideal", "rods", "rods, not turned"], rows)
    report.numbers(["run", "value", "error", "ratio", "ratio_error"], numbers)
    figure, panel = figures.axes(size=(5.0, 3.2))
    for (length, torque), ratios in by_kind.items():
        label = "spheres" if not length else "rods, hard walls" if torque else "rods, walls without torque"
        panel.errorbar(list(ratios), [ratio[0] for ratio in ratios.values()], [2.0 * ratio[1] for ratio in ratios.values()], fmt="o-", capsize=2, label=label)
    panel.set(xlabel="speed, kT/(mu D2)", ylabel="wall pressure/(n kT)")
    panel.legend(frameon=False)
    report.figure(figure, f"Pressure on the walls of a wide slit over n kT in its middle; rods L/D = {ROD:g}. Two standard errors.")


def wall_pressure(walls, series):
    return series["wall_pressure_z" if walls == "slit" else "wall_pressure"]


def whole_normal_stress(walls, density, series):
    """Row by row, with the active stress; spheres, kT = 1."""
    diagonal = [series[f"stress_{k}{k}"] + series[f"stress_active_{k}{k}"] + density for k in "xyz"]
    return {"slit": diagonal[2], "sphere": sum(diagonal) / 3, "tube": (diagonal[1] + diagonal[2]) / 2}[walls]


def ideal(speed):
    """Pressure over n kT of spheres that do not meet."""
    return 1.0 + speed**2 / (6.0 * ROTATION * MOBILITY)


def whole_pressure_of_bulk(run):
    """Over n kT, with the active pressure, and its error."""
    series = run.series()
    pressure = series["pressure"] + (series["pressure_active"] if "pressure_active" in series.dtype.names else 0.0)
    density = run.scene["rods"]["count"] / (WIDTH * WIDTH * HEIGHT)
    return pressure.mean() / density, error_of_blocks(pressure) / density


def over_density(run):
    """Wall pressure over n kT in the middle third of the slit, from as many parts of the run as fit, with the error of their mean."""
    field = run.left.table("field.csv")
    middle = (numpy.abs(field["z"] - 0.5 * HEIGHT) < HEIGHT / 6.0) & (field["step"] > run.equilibration)
    density = field["number_density"][middle]
    steps = field["step"][middle]
    ends = numpy.unique(steps)
    density = numpy.array([density[steps == end].mean() for end in ends])
    series = run.series()
    pressure = series["wall_pressure_z"]
    pressures, densities = (numpy.array([part.mean() for part in numpy.array_split(rows, BLOCKS)]) for rows in (pressure, density))
    left_out = (pressures.sum() - pressures) / (densities.sum() - densities)  # jackknife of the ratio of means
    return pressures.mean() / densities.mean(), 2.365 / 1.960 * jackknife_error(left_out)  # Student's t of 7 degrees of freedom
