"""Equation of state from one profile

Hard spheres sink onto a floor under their weight. The pressure at a height is the weight of what lies above it, so that the profile of the density is the equation of state, from dense to dilute, by no
force of a contact at all. Is it that of Carnahan and Starling?
"""

import math

import numpy

import figures
import reference_values
from clusters import trajectory
from report import per_cent, with_error
from runs import Run, jackknife_error

WEIGHT = 0.25  # kT/D: the density falls by e within 4 D where spheres are dilute
RMS_STEP = 0.06
FULL = {"count": 1500, "edge": 9.0, "height": 60.0, "equilibration": 200000, "production": 400000, "frame_every": 500}
QUICK = {"count": 250, "edge": 5.0, "height": 45.0, "equilibration": 150000, "production": 150000, "frame_every": 500}
FLOOR = 5.0           # D: nearer to the floor spheres stand in layers
LEAST_FRACTION = 0.05  # above, few spheres are
BLOCKS = 8
BOUND, QUICK_BOUND = 0.01, 0.03


def runs(quick):
    size = QUICK if quick else FULL
    return [Run(name="sediment",
                scene={"seed": 4, "box": {"edges": [size["edge"], size["edge"], size["height"]], "periodic": [True, True, False]},
                       "walls": {"faces": [False, False, True]}, "forces": {"on_rods": [0.0, 0.0, -WEIGHT]},
                       "rods": {"count": size["count"], "length": 0.0}, "time": {"rms_step": RMS_STEP},
                       "output": {"trajectory_every": size["frame_every"]}},
                equilibration=size["equilibration"], production=size["production"])]


def evaluate(report, runs_by_name, quick):
    run = runs_by_name["sediment"]
    size = QUICK if quick else FULL
    area, edges = size["edge"]**2, numpy.arange(0.0, size["height"] + 0.5)
    density, pressure = profiles(run, edges, area)
    blocks = [numpy.array_split(profile, BLOCKS) for profile in (density, pressure)]
    means = numpy.array([[block.mean(axis=0) for block in of] for of in blocks])  # (density and pressure, blocks, layers)
    fraction = math.pi / 6 * density.mean(axis=0)
    middle = 0.5 * (edges[1:] + edges[:-1])
    rows, numbers, differences = [], [], []
    for layer in numpy.flatnonzero((middle > FLOOR) & (fraction >= LEAST_FRACTION)):
        ratio = pressure[:, layer].mean() / density[:, layer].mean()
        expected = reference_values.carnahan_starling(fraction[layer])
        without = numpy.array([numpy.delete(means[:, :, layer], k, axis=1).mean(axis=1) for k in range(BLOCKS)])
        Z = without[:, 1] / without[:, 0]
        error = jackknife_error(Z)
        # A layer that holds more spheres by chance has a lower Z, and the equation of state a higher one.
        of_fraction = reference_values.carnahan_starling(math.pi / 6 * without[:, 0])
        error_of_difference = jackknife_error(Z - of_fraction)
        differences.append(Z / of_fraction - 1.0)
        numbers.append([middle[layer], fraction[layer], ratio, error, expected, error_of_difference])
        rows.append([f"{middle[layer]:g}", f"{fraction[layer]:.4f}", with_error(ratio, error), f"{expected:.3f}", per_cent(ratio, expected, error_of_difference)])
        report.compare(f"height {middle[layer]:g} D: Z from the weight above", (ratio, error_of_difference), (expected, 0.0), QUICK_BOUND if quick else BOUND)
    report.table("Z = P/(n kT) in layers of 1 D: P is the weight of the spheres above over the area.", ["height, D", "phi", "measured", "Carnahan-Starling", "difference, %"], rows)
    average = 100.0 * numpy.mean(differences, axis=0)  # per cent
    report.remark(f"Averaged over the layers, Z differs from Carnahan and Starling by {with_error(average.mean(), jackknife_error(average), 2)} %.")
    report.numbers(["height", "phi", "Z", "Z_error", "Z_carnahan_starling", "difference_error"], numbers)
    _, phi, measured, _, expected, error = numpy.array(numbers).T
    figure, panel = figures.axes(size=(5.0, 3.2))
    panel.errorbar(phi, measured, 2.0 * error, fmt="o", markersize=3, capsize=2, label="weight above")
    panel.plot(phi, expected, label="Carnahan and Starling")
    panel.set(xlabel="volume fraction", ylabel="Z")
    panel.legend(frameon=False)
    report.figure(figure, "Z of hard spheres from the profile of one sediment; two standard errors of the difference.")


def profiles(run, edges, area):
    """(frames, layers) densities, and pressures (kT/D3) by the weight above, means over layers of 1 D."""
    with trajectory(run) as file:
        rods = file["particles/rods"]
        kept = rods["position/step"][...] >= run.equilibration
        heights = rods["position/value"][..., 2][kept]
    counts = numpy.array([numpy.histogram(frame, edges)[0] for frame in heights])
    above = counts[:, ::-1].cumsum(axis=1)[:, ::-1] - counts
    # Of the spheres in the layer itself each presses on what lies beneath it: on the part of the layer, 1 D, below its height.
    below = numpy.array([numpy.histogram(frame, edges, weights=frame % 1.0)[0] for frame in heights])
    return counts / area, WEIGHT * (above + below) / area
