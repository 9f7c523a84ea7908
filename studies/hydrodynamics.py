"""Rods that move each other through the fluid

Equilibrium cannot depend on how rods move: are Z of spheres and of rods, and S of a nematic, the same with `mobility.model = "hydrodynamic"` and with "capsule"? And what does depend on it: pressure,
order and diffusion of swimmers that push the fluid, that pull it, and that do not stir it, at the same speed.
"""

import math

import numpy

import figures
import swimmer_flow
from clusters import trajectory
from report import with_error
from runs import Run, error_of_blocks

MODELS = ("hydrodynamic", "capsule")
# (name, L/D, phi, rods, steps of production): full, and those of the quick study
STATES = (("spheres", 0, 0.1, 200, 40000), ("spheres", 0, 0.2, 200, 30000), ("spheres", 0, 0.4, 200, 20000),
          ("rods", 5, 0.1, 200, 20000), ("rods", 5, 0.2, 200, 15000), ("rods", 5, 0.3, 200, 12000),
          ("nematic", 5, 0.5, 200, 30000))  # nearer to the transition, at 0.45, S varies three times as much, for twice as long
QUICK_STATES = (("spheres", 0, 0.2, 60, 5000), ("rods", 5, 0.1, 40, 2500))
RMS_STEP = 0.05
# Of swimmers L/D = 5: U_0 = 5 kT/(mu D2), so that U_0/(L D_R) is 154; p = +-2 mu U_0 (L + D)^2.
SPEED, DIPOLE, SWIMMERS, SWIM_PHI, SWIM_STEPS = 5.0, 360.0, 200, 0.05, 20000
QUICK_SWIMMERS, QUICK_SWIM_STEPS = 40, 2000
KINDS = {"pushers": ("hydrodynamic", DIPOLE), "pullers": ("hydrodynamic", -DIPOLE), "without a dipole": ("hydrodynamic", 0.0), "dry": ("capsule", 0.0)}


def name_of(state, model):
    return f"{state[0]}_{state[2]:g}_{model}"


def runs(quick):
    found = []
    for state in QUICK_STATES if quick else STATES:
        kind, beta, phi, count, steps = state
        start = {"start": "aligned"} if kind == "nematic" else {}
        found += [Run(name=name_of(state, model),
                      scene={"seed": 1, "box": {"volume_fraction": phi}, "rods": {"count": count, "length": float(beta), **start},
                             "mobility": {"model": model}, "solver": {"tolerance": 1e-4}, "time": {"rms_step": RMS_STEP}},
                      equilibration=steps // 5,
                      production=steps if model == "hydrodynamic" else 4 * steps)
                  for model in MODELS]
    for kind, (model, dipole) in KINDS.items():
        steps = QUICK_SWIM_STEPS if quick else SWIM_STEPS
        found.append(Run(name=f"swimmers_{kind.replace(' ', '_')}",
                         scene={"seed": 3, "box": {"volume_fraction": SWIM_PHI}, "rods": {"count": QUICK_SWIMMERS if quick else SWIMMERS, "length": 5.0},
                                "mobility": {"model": model}, "solver": {"tolerance": 1e-4}, "time": {"step": 0.004},
                                "motion": {"self_propulsion": SPEED, **({"force_dipole": dipole} if dipole else {})},
                                "output": {"trajectory_every": max(steps // 200, 1)}},
                         equilibration=steps // 5, production=steps))
    return found


def evaluate(report, runs_by_name, quick):
    compare_equilibrium(report, runs_by_name, QUICK_STATES if quick else STATES)
    compare_swimmers(report, runs_by_name)
    show_flow(report)


def compare_equilibrium(report, runs_by_name, states):
    rows, numbers = [], []
    for state in states:
        kind, beta, phi = state[:3]
        fluid, dry = (runs_by_name[name_of(state, model)] for model in MODELS)
        for column in ("Z", "nematic_order") if kind == "nematic" else ("Z",):
            measured, expected = (blocks(run.series()[column]) for run in (fluid, dry))
            report.compare(f"{kind}, phi = {phi}: {column} with and without the fluid", measured, expected, 0.01)
            rows.append([kind, beta, phi, column, with_error(*measured), with_error(*expected)])
            numbers.append([kind, beta, phi, column, *measured, *expected])
    report.table("With the fluid between them, and without: equal in equilibrium. Rods L/D = 5.",
                 ["bodies", "L/D", "phi", "", "hydrodynamic", "capsule"], rows)
    report.numbers(["bodies", "L_over_D", "phi", "quantity", "hydrodynamic", "hydrodynamic_error", "capsule", "capsule_error"], numbers)


def compare_swimmers(report, runs_by_name):
    rows, curves = [], {}
    for kind in KINDS:
        run = runs_by_name[f"swimmers_{kind.replace(' ', '_')}"]
        series = run.series()
        ratio = blocks(series["pressure_collision"])
        order = blocks(series["nematic_order"])
        curves[kind] = mean_square_displacement(run)
        rows.append([kind, with_error(*ratio), with_error(*order)])
        if "stress_dipoles_xx" in series.dtype.names:
            trace = sum(series[f"stress_dipoles_{k}{k}"] for k in "xyz")
            report.require(f"{kind}: largest trace of the stress of dipoles, kT/D3", float(numpy.abs(trace).max()), upper=1e-9)
    report.table(f"Swimmers L/D = 5, phi = {SWIM_PHI}, U_0 = {SPEED:g} kT/(mu D2), p = +-{DIPOLE:g} kT.", ["swimmers", "collision pressure, kT/D3", "S"], rows)
    figure, panel = figures.axes(size=(5.6, 3.4))
    for kind, (time, square) in curves.items():
        panel.loglog(time, square, label=kind)
    panel.loglog(time, (SPEED * time)**2, color="black", linewidth=0.8, linestyle="dashed", label="straight on")
    panel.set(xlabel="time, mu D3/kT", ylabel="mean square displacement, D2")
    panel.legend()
    report.figure(figure, "Mean square displacement of swimmers at the same speed that push the fluid, pull it, do not stir it, and move without a fluid between them.", name="swimmers")


def mean_square_displacement(run):
    """(times, squares) from the frames of production; centres are unwrapped."""
    with trajectory(run) as file:
        rods = file["particles/rods"]
        step, time, ids = (rods[name][...] for name in ("position/step", "position/time", "id/value"))
        centre = rods["position/value"][...] + rods["image/value"][...] * rods["box/edges"][...]
    kept = step >= run.equilibration
    centre = numpy.take_along_axis(centre, ids.argsort(axis=1)[..., None], axis=1)[kept]
    time = time[kept]
    lags = numpy.unique(numpy.geomspace(1, max(len(time) // 3, 1), 20).astype(int))
    squares = [((centre[lag:] - centre[:-lag])**2).sum(axis=-1).mean() for lag in lags]
    return lags * (time[1] - time[0]), numpy.array(squares)


def show_flow(report):
    figure, panels = figures.axes(columns=2, size=(7.2, 3.6))
    for panel, dipole in zip(panels, (1.0, -1.0)):
        swimmer_flow.draw(panel, dipole)
    report.figure(figure, "Flow around a swimmer L/D = 5, in a plane through its axis; brighter is faster.", name="flow")
    points = numpy.array([[60.0, 0, 0], [0, 60.0, 0], [30.0, 50.0, 10.0]])
    error = numpy.linalg.norm(swimmer_flow.flow(points, 1.0) - swimmer_flow.far_flow(points, 1.0), axis=-1)
    size = numpy.linalg.norm(points, axis=-1)**-2 / (8 * math.pi)
    report.require("60 D from a swimmer: distance of its flow from that of a force dipole, over p/(8 pi mu r2)", float((error / size).max()), upper=0.02)


def blocks(values):
    return float(numpy.mean(values)), error_of_blocks(values)
