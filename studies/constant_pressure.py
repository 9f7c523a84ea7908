"""Constant pressure against constant volume: rods in a bath, and a row under a piston

At a constant volume rods have a pressure, and at that constant pressure the same volume. A row of spheres in a narrow tube is Tonks' gas but for its zigzag: the force on its ends at a fixed length, and the length
that it has under a piston with its variance, are known exactly (theory, section 10).
"""

import math

import numpy

import figures
from report import with_error
from runs import Run, error_of_blocks

LENGTH, QUICK_COUNT, COUNT = 5.0, 150, 400
BODY = math.pi / 6.0 + math.pi / 4.0 * LENGTH
# Volume fraction: Z of Monte Carlo, N = 1000 (reference_values), which gives the bath its pressure, and d ln Z/d ln phi.
STATES = {0.2: (4.266, 1.36), 0.3: (7.778, 1.62)}
RELAXATION = 100.0  # of the bath; its box relaxes ten to twenty times as fast
RADIUS, ROW, LOAD = 0.75, 3, 1.0  # of the tube, in D; spheres; kT/D
PISTONS = [(3, 0.1), (3, 0.3), (10, 0.3)]  # spheres; mobility over that of a sphere
DIFFUSION = 1.0 / (3.0 * math.pi)  # of a sphere, in kT/(mu D)
SEEDS, QUICK_SEEDS = (1, 2, 3, 4, 5, 6, 7, 8), (1, 2)
ROW_LENGTH = 6.0


def runs(quick):
    states = [0.2] if quick else list(STATES)
    rods = {"count": QUICK_COUNT if quick else COUNT, "length": LENGTH}
    volume = [Run(name=f"volume_{phi:g}", scene={"seed": 4, "box": {"volume_fraction": phi}, "rods": rods, "time": {"rms_step": 0.05}},
                  equilibration=4000, production=20000 if quick else 120000) for phi in states]
    bath = [Run(name=f"bath_{phi:g}",
                scene={"seed": 4, "box": {"volume_fraction": 0.9 * phi}, "rods": rods, "time": {"rms_step": 0.05},
                       "pressure": {"external": pressure_of(phi), "relaxation_time": RELAXATION}},
                equilibration=8000, production=40000 if quick else 240000) for phi in states]
    piston = [Run(name=piston_name(count, mobility, seed), scene=row_scene(seed, 2.0 * count, under_piston(count, mobility), count),
                  equilibration=20000 * count // 3, production=4000000) for count, mobility in PISTONS for seed in SEEDS]
    fixed = [Run(name=f"row_{seed}", scene=row_scene(seed, ROW_LENGTH), equilibration=10000, production=400000 if quick else 2000000)
             for seed in (QUICK_SEEDS if quick else SEEDS)]
    return [*volume, *bath, *([] if quick else piston), *fixed]  # few independent lengths in a quick run


def pressure_of(phi):
    return phi / BODY * STATES[phi][0]


def piston_name(count, mobility, seed):
    return f"piston_{count}_{mobility:g}_{seed}"


def under_piston(count, mobility):
    """Its mobility is edge^2/(relaxation_time N kT)."""
    return {"external": LOAD / (math.pi * RADIUS**2), "coupling": "piston",
            "relaxation_time": (2.0 * count)**2 / (count * mobility * DIFFUSION)}


def row_scene(seed, length, pressure=None, count=ROW):
    return {"seed": seed, "box": {"edges": [length, 2.0 * RADIUS, 2.0 * RADIUS], "periodic": [False, False, False]},
            "walls": {"container": "tube", "faces": [True, False, False]}, "rods": {"count": count, "length": 0.0, "start": "aligned"},
            **({"pressure": pressure} if pressure else {}), "time": {"rms_step": 0.06}, "output": {"series_every": 20}}


def evaluate(report, runs_by_name, quick):
    rows, numbers = [], []
    for phi, (Z, slope) in STATES.items():
        if f"bath_{phi:g}" not in runs_by_name:
            continue
        at_volume, in_bath = runs_by_name[f"volume_{phi:g}"].series(), runs_by_name[f"bath_{phi:g}"].series()
        pressure, external = with_blocks(at_volume["pressure"]), pressure_of(phi)
        # Where the box of constant volume would have the pressure of the bath.
        stiffness = 1.0 + slope
        expected = phi * (1.0 + (external / pressure[0] - 1.0) / stiffness), phi * pressure[1] / pressure[0] / stiffness
        found = with_blocks(in_bath["phi"])
        state = f"rods L/D = {LENGTH:g}, P = {external:.4f} kT/D3"
        report.compare(f"{state}: volume fraction in the bath, against that of constant volume", found, expected, 0.005)
        volume = with_blocks(in_bath["volume"])
        factor = external / QUICK_COUNT * volume[0] if quick else external / COUNT * volume[0]
        measured_Z = factor, factor * volume[1] / volume[0]
        expected_Z = external * BODY / expected[0], external * BODY / expected[0] * expected[1] / expected[0]
        report.compare(f"{state}: Z = P V/(N kT)", measured_Z, expected_Z, 0.005)
        ratio = with_blocks(in_bath["pressure"] / external)
        report.compare(f"{state}: pressure over that of the bath", ratio, (1.0, 0.0), 0.005, errors=3)
        rows.append([f"{external:.4f}", with_error(*found, 4), with_error(*expected, 4), with_error(*measured_Z), with_error(*expected_Z), with_error(*ratio)])
        numbers.append([f"bath_{phi:g}", *found, *expected])
    report.table(f"Rods L/D = {LENGTH:g} in a bath of pressure, against a box of constant volume.",
                 ["P, kT/D3", "phi, bath", "phi, volume", "Z, bath", "Z, volume", "pressure over the bath's"], rows)
    seeds = QUICK_SEEDS if quick else SEEDS
    forces = numpy.array([0.5 * (series["wall_force_x_lower"] + series["wall_force_x_upper"])
                          for series in (runs_by_name[f"row_{seed}"].series() for seed in seeds)])
    force, exact_force = of_blocks(forces), force_at_length(ROW_LENGTH, RADIUS - 0.5)
    report.compare(f"{ROW} spheres in a tube of length {ROW_LENGTH:g} D: force on an end", force, (exact_force, 0.0), 0.01)
    row_table = [["force, kT/D", with_error(*force, 4), f"{exact_force:.4f}"]]
    numbers.append(["force", *force, exact_force, 0.0])
    report.table(f"A row of {ROW} spheres in a tube of radius {RADIUS:g} D between ends {ROW_LENGTH:g} D apart.", ["quantity", "measured", "exact"], row_table)
    if not quick:
        numbers += evaluate_pistons(report, runs_by_name)
    report.numbers(["quantity", "measured", "error", "expected", "expected_error"], numbers)


def evaluate_pistons(report, runs_by_name):
    rows, numbers = [], []
    for count, mobility in PISTONS:
        series = [runs_by_name[piston_name(count, mobility, seed)].series() for seed in SEEDS]
        lengths = numpy.array([one["edge_x"] for one in series])
        forces = numpy.array([one["wall_force_x_upper"] for one in series])
        mean, variance = length_under_load(LOAD, RADIUS - 0.5, count)
        length, spread, load = of_blocks(quiet(lengths, forces, variance)), of_blocks((lengths - mean)**2), of_blocks(forces / LOAD)
        row = f"{count} spheres under a piston {mobility:g} times as mobile as one"
        report.compare(f"{row}: mean length", length, (mean, 0.0), 0.007)
        report.compare(f"{row}: its variance", spread, (variance, 0.0), 0.03)
        report.compare(f"{row}: force over load", load, (1.0, 0.0), 0.007)
        rows.append([f"{count}", f"{mobility:g}", with_error(*length), f"{mean:.4f}", with_error(*spread), f"{variance:.4f}", with_error(*load)])
        numbers += [[f"length_{count}_{mobility:g}", *length, mean, 0.0], [f"variance_{count}_{mobility:g}", *spread, variance, 0.0],
                    [f"load_{count}_{mobility:g}", *load, 1.0, 0.0]]
    report.table(f"Rows of spheres in a tube of radius {RADIUS:g} D under a piston with a load of {LOAD:g} kT/D.",
                 ["spheres", "mobility over a sphere's", "mean length, D", "exact", "variance, D2", "exact", "force over load"], rows)
    draw(report, lengths, count, mean)
    return numbers


def quiet(lengths, forces, variance):
    """Lengths with the same mean, and less noise. In the mean the force on the piston is its load less the noise, which
    is 0 in a long run, and moves the length by as much as a load would: by its variance over kT a force."""
    return lengths + variance * (forces - LOAD)


def draw(report, lengths, count, mean):
    figure, panel = figures.axes(size=(5.0, 3.2))
    panel.hist(lengths.ravel(), bins=80, density=True, color="C0", alpha=0.6, label="measured")
    panel.axvline(mean, color="black", linewidth=0.8, label="exact mean")
    panel.set(xlabel="length/D", ylabel="probability density")
    panel.legend(frameon=False)
    report.figure(figure, f"Length of a row of {count} spheres under a piston with a load of {LOAD:g} kT/D.")


def with_blocks(values):
    return values.mean(), error_of_blocks(values)


def of_blocks(rows_of_runs):
    """Mean over runs and blocks of them, with its error."""
    blocks = numpy.concatenate([rows[len(rows) % 8:].reshape(8, -1).mean(axis=1) for rows in rows_of_runs])
    return blocks.mean(), blocks.std(ddof=1) / math.sqrt(len(blocks))


def disc(radius, rings=12, spokes=24):
    """Points and weights of the mean over a disc."""
    nodes, weights = numpy.polynomial.legendre.leggauss(rings)
    r = radius * numpy.sqrt(0.5 * (nodes + 1.0))  # equal areas
    angle = 2.0 * math.pi * numpy.arange(spokes) / spokes
    points = numpy.array([(a * math.cos(t), a * math.sin(t)) for a in r for t in angle])
    return points, numpy.repeat(0.5 * weights / spokes, spokes)


def spacings(radius):
    """Between neighbours that touch, along the tube, for each pair of places across it; and the weights of places."""
    points, weights = disc(radius)
    apart = ((points[:, None, :] - points[None, :, :])**2).sum(axis=2)
    return numpy.sqrt(1.0 - apart), weights


def length_under_load(load, radius, count):
    """Mean and variance, by derivatives of the partition function of theory, section 10."""
    spacing, weights = spacings(radius)

    def log_sum(f):
        chain = weights
        for _ in range(count - 1):
            chain = weights * (numpy.exp(-f * spacing) @ chain)
        return -(count + 1) * math.log(f) - f + math.log(chain.sum())

    h = 1e-3
    below, here, above = (log_sum(load + d) for d in (-h, 0.0, h))
    return (below - above) / (2.0 * h), (above - 2.0 * here + below) / h**2


def force_at_length(length, radius):
    """kT d ln Z/dl, with Z = <(l - D - s)^3> over places across the tube, s the sum of the two spacings."""
    spacing, weights = spacings(radius)
    powers = [spacing**k @ weights for k in range(4)]  # means over the place of one neighbour
    moments = [sum(math.comb(k, a) * weights @ (powers[a] * powers[k - a]) for a in range(k + 1)) for k in range(4)]
    free = length - 1.0

    def mean_of_power(n):
        return sum(math.comb(n, k) * free**(n - k) * (-1) ** k * moments[k] for k in range(n + 1))

    return 3.0 * mean_of_power(2) / mean_of_power(3)
