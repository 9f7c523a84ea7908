"""Pressure from gaps

A second way to the pressure, which knows no force: hard rods press by as much as there are gaps that a compression would close. The collision pressure of spheres and of rods, from positions and
axes alone, beside that of contact forces.
"""

import math

import figures
import numpy
from clusters import trajectory
from report import with_error
from runs import Run, RunFailed

STATES = ((0.0, 0.3), (0.0, 0.45), (2.0, 0.3), (5.0, 0.2))  # L/D, volume fraction
QUICK_STATES = ((0.0, 0.3), (2.0, 0.3))
RMS_STEP = 0.02
FRAME_EVERY = 50
NEAREST, FARTHEST = 3.0, 10.0  # gaps that are fitted, in widths of the noise that a contact meets in a step
BLOCKS = 16
BOUND = 0.03


def runs(quick):
    return [Run(name=f"L{beta:g}_phi{phi:g}",
                scene={"seed": 8, "box": {"volume_fraction": phi}, "rods": {"count": 400 if quick else 800, "length": beta}, "time": {"rms_step": RMS_STEP},
                       "output": {"trajectory_every": FRAME_EVERY}, "solver": {"tolerance": 1e-5}},
                equilibration=4000 if beta == 0.0 else 10000, production=30000 if quick else 200000)
            for beta, phi in (QUICK_STATES if quick else STATES)]


def evaluate(report, runs_by_name, quick):
    rows, numbers = [], []
    figure, panel = figures.axes(size=(5.6, 3.0))
    for run in runs_by_name.values():
        beta, phi = run.scene["rods"]["length"], run.scene["box"]["volume_fraction"]
        forces = run.value("pressure_collision")
        width = noise_width(beta)
        edges = numpy.linspace(0.0, FARTHEST * width, 41)
        frames = densities(run, edges)
        middle = 0.5 * (edges[1:] + edges[:-1])
        fitted = middle > NEAREST * width
        blocks = frames[len(frames) % BLOCKS:].reshape(BLOCKS, -1, len(middle)).mean(axis=1)
        at_contact = extrapolated(middle[fitted], frames.mean(axis=0)[fitted])
        without = numpy.array([extrapolated(middle[fitted], numpy.delete(blocks, k, axis=0).mean(axis=0)[fitted]) for k in range(BLOCKS)])
        gaps = (at_contact, 2.131 / 1.960 * math.sqrt((BLOCKS - 1) / BLOCKS * ((without - without.mean()) ** 2).sum()))
        report.compare(f"L/D = {beta:g}, phi {phi:g}: collision pressure of gaps, against that of forces", gaps, forces, BOUND)
        rows.append([f"{beta:g}", f"{phi:g}", with_error(*gaps), with_error(*forces)])
        numbers.append([beta, phi, *gaps, *forces])
        panel.plot(middle / width, frames.mean(axis=0) / forces[0], ".", label=f"L/D = {beta:g}, phi {phi:g}")
    report.table("Collision pressure in kT/D3: of gaps, and of contact forces.", ["L/D", "phi", "gaps", "forces"], rows)
    panel.axhline(1.0, color="black", linewidth=0.8)
    panel.axvline(NEAREST, color="black", linewidth=0.5, linestyle=":")
    panel.set_xlabel("gap / width of the noise")
    panel.set_ylabel("density of gaps / pressure")
    panel.legend(frameon=False)
    report.figure(figure, "Density of gaps, as a pressure, over the collision pressure; to the right of the dotted line it is fitted.")
    report.numbers(["L_over_D", "phi", "gaps", "gaps_error", "forces", "forces_error"], numbers)


def noise_width(beta):
    """sigma of a contact: two bodies move, and rods turn besides (some third more at their ends)."""
    return math.sqrt(2.0) * RMS_STEP * (1.0 if beta == 0.0 else 1.3)


def extrapolated(gap, density):
    """At gap 0, by a parabola in its logarithm."""
    return math.exp(numpy.polyfit(gap, numpy.log(density), 2, w=numpy.sqrt(density))[2])


def densities(run, edges):
    """Of every frame of production: kT/(3V) times the sum of r.e over the gaps in each interval, over its width."""
    try:
        from scipy.spatial import cKDTree
    except ImportError:
        raise RunFailed("this study finds pairs: apt-get install python3-scipy") from None
    found = []
    with trajectory(run) as file:
        rods = file["particles/rods"]
        box = rods["box/edges/value"][0] if "value" in rods["box/edges"] else rods["box/edges"][...]
        box = numpy.asarray(box, dtype=float).reshape(-1)[:3] if numpy.asarray(box).ndim == 1 else numpy.diag(box)
        for k, step in enumerate(rods["position/step"][...]):
            if step <= run.equilibration:
                continue
            centre, axis = rods["position/value"][k].astype(float) % box, rods["orientation/value"][k].astype(float)
            length = float(rods["length/value"][k][0])
            reach = length + 1.0 + edges[-1]
            pairs = cKDTree(centre % box, boxsize=box).query_pairs(reach, output_type="ndarray")
            i, j = pairs[:, 0], pairs[:, 1]
            apart = centre[j] - centre[i]
            apart -= box * numpy.round(apart / box)
            nearest = shortest(apart, axis[i], axis[j], 0.5 * length)
            distance = numpy.linalg.norm(nearest, axis=1)
            weight = (apart * nearest).sum(axis=1) / distance
            counted = numpy.histogram(distance - 1.0, edges, weights=weight)[0]
            found.append(counted / numpy.diff(edges) / (3.0 * box.prod()))
    return numpy.array(found)


def shortest(apart, n_i, n_j, half):
    """The shortest vectors from segments at 0 to segments at `apart`, all of one half length."""
    def dot(a, b):
        return (a * b).sum(axis=1)

    def vector(s, t):
        return apart + t[:, None] * n_j - s[:, None] * n_i

    along_i, along_j, both = dot(apart, n_i), dot(apart, n_j), dot(n_i, n_j)
    # each end against the other segment, and the nearest points of the two lines where both lie within
    candidates = [vector(numpy.clip(along_i + t * both, -half, half), numpy.full(len(apart), t)) for t in (-half, half)]
    candidates += [vector(numpy.full(len(apart), s), numpy.clip(s * both - along_j, -half, half)) for s in (-half, half)]
    across = numpy.maximum(1.0 - both**2, 1e-12)
    s, t = (along_i - both * along_j) / across, (both * along_i - along_j) / across
    within = (numpy.abs(s) <= half) & (numpy.abs(t) <= half)
    candidates.append(numpy.where(within[:, None], vector(numpy.clip(s, -half, half), numpy.clip(t, -half, half)), candidates[0]))
    lengths = numpy.array([dot(one, one) for one in candidates])
    return numpy.stack(candidates)[lengths.argmin(axis=0), numpy.arange(len(apart))]
