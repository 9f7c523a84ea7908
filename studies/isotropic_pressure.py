"""Pressure of isotropic rods

Is Z right for spheres and for rods of L/D = 1 to 20, at the default time step (rms step 0.04 D) and at one and a half times its rms step? Compared with the hard-sphere equation of state and with
Carnahan-Starling, itself up to 0.3 % below it (L/D = 0), with Monte Carlo (2, 5, 10), and where dilute with the virial series to B4 (1, 3, 10, 20). Closed forms of
Parsons-Lee and Nezbeda are drawn beside it: they are no test for rods.
"""

import math

import figures
import reference_values
from report import per_cent, with_error
from runs import Run

SHAPES = {  # L/D: volume fractions
    0: (0.05, 0.10, 0.20, 0.30, 0.40, 0.45),
    1: (0.05, 0.08, 0.20, 0.30, 0.40),
    2: (0.10, 0.20, 0.30, 0.40, 0.45),
    3: (0.05, 0.08, 0.20, 0.30),
    5: (0.05, 0.10, 0.15, 0.20, 0.25, 0.30, 0.35),
    10: (0.02, 0.05, 0.10, 0.20),
    20: (0.01, 0.02, 0.03, 0.05),
}
QUICK_SHAPES = {0: (0.10, 0.40), 1: (0.08,), 2: (0.30,), 5: (0.20,), 10: (0.05,), 20: (0.02,)}
DEFAULT_STEP = 0.04
AIMS = {DEFAULT_STEP: 0.005, 0.06: 0.01}  # rms step: largest error of Z, beside two combined standard errors
QUICK_AIM = 0.01


def runs(quick):
    shapes, steps = (QUICK_SHAPES, [DEFAULT_STEP]) if quick else (SHAPES, AIMS)
    return [Run(name=f"L{beta}_phi{phi:.2f}_rms{rms:g}",
                scene={"seed": 1, "box": {"volume_fraction": phi},
                       "rods": {"count": 500 if quick else 1000, "length": float(beta)},
                       "time": {"rms_step": rms}, "solver": {"tolerance": 1e-4}},
                equilibration=2000 if quick else int(share * (20000 if phi * (beta + 1) > 2 or beta >= 10 else 6000)),
                production=8000 if quick else int(share * production(beta, phi)))
            for rms in steps for share in [0.03 / rms]  # half as many steps of twice the length: twice the time
            for beta, volume_fractions in shapes.items() for phi in volume_fractions]


def production(beta, phi):
    """Long rods take longer to forget their direction, and dilute ones collide more rarely."""
    return 120000 if beta >= 10 else 60000 if phi <= 0.1 else 30000


def evaluate(report, runs_by_name, quick):
    rows, numbers, points = {}, [], {}
    for run in runs_by_name.values():
        beta, phi, rms = run.scene["rods"]["length"], run.scene["box"]["volume_fraction"], run.scene["time"]["rms_step"]
        Z, error = run.value("Z")
        reference = reference_values.best(beta, phi)
        state = f"L/D = {beta:g}, phi = {phi:.2f}, rms step {rms:g}"
        aim = QUICK_AIM if quick else AIMS[rms]
        if reference:
            report.compare(state, (Z, error), reference[:2], aim)
        if beta == 0:
            closed_form = reference_values.carnahan_starling(phi)
            own_error = abs(closed_form - reference[0])  # 0.1 to 0.3 % from phi = 0.2 on
            report.compare(f"{state}, Carnahan-Starling", (Z, error), (closed_form, own_error), aim)
        closed = (reference_values.parsons_lee(beta, phi), reference_values.nezbeda(beta, phi))
        measured = [with_error(Z, error), per_cent(Z, reference[0], math.hypot(error, reference[1])) if reference else ""]
        if rms == DEFAULT_STEP:
            points.setdefault(beta, []).append((phi, Z, error, reference))
            rows[beta, phi] = [f"{beta:g}", f"{phi:.2f}", with_error(*reference[:2]) + f" ({reference[2]})" if reference else "",
                               *(f"{value:.3f}" for value in closed), *measured]
        else:
            rows[beta, phi] += measured
        numbers.append([beta, phi, rms, Z, error, *(reference or ("", "", "")), *closed])
    steps = [DEFAULT_STEP] if quick else list(AIMS)
    report.table("Z with its standard error at each rms step (in D); the difference from the reference with that of both values together.",
                 ["L/D", "phi", "reference", "Parsons-Lee", "Nezbeda", *(name for rms in steps for name in (f"Z, {rms:g}", "difference, %"))],
                 list(rows.values()))
    report.numbers(["L_over_D", "phi", "rms_step", "Z", "standard_error", "reference", "reference_error", "reference_kind", "parsons_lee",
                 "nezbeda"], numbers)
    for rms in steps:
        report.remark(spread(rms, [row for row in numbers if row[2] == rms]))
    draw(report, points)


def spread(rms, numbers):
    """How far the points of one step are from their references."""
    deviations = sorted((abs(Z / reference - 1), beta, phi, (Z - reference) / math.hypot(error, reference_error))
                        for beta, phi, _, Z, error, reference, reference_error, *_ in numbers if reference)
    worst, beta, phi, errors = deviations[-1]
    aim = AIMS[rms]
    mean_square = sum(deviation**2 for deviation, *_ in deviations) / len(deviations)
    beyond = sum(deviation > aim for deviation, *_ in deviations)
    return (f"At rms step {rms:g} the worst deviation of {len(deviations)} points with a reference is {math.copysign(100 * worst, errors):+.2f} %, "
            f"{errors:+.1f} combined standard errors (L/D = {beta:g}, phi = {phi:.2f}), the root mean square {100 * math.sqrt(mean_square):.2f} %; "
            f"{beyond} are beyond {100 * aim:g} % before their errors are counted. {len(numbers) - len(deviations)} have no reference, and are not judged.")


def draw(report, points):
    figure, (pressure, difference) = figures.axes(2, 1, size=(6.4, 6.4), sharex=True, height_ratios=[2.2, 1])
    for number, (beta, of_shape) in enumerate(points.items()):
        colour = f"C{number}"
        phi, Z, error, references = zip(*of_shape)
        pressure.errorbar(phi, Z, error, color=colour, marker="o", markersize=4, linestyle="none", label=f"L/D = {beta:g}")
        fine = [max(phi) * k / 100 for k in range(1, 101)]
        pressure.plot(fine, [reference_values.parsons_lee(beta, x) for x in fine], color=colour, linewidth=0.8,
                      linestyle="--")
        pressure.plot(fine, [reference_values.nezbeda(beta, x) for x in fine], color=colour, linewidth=0.8, linestyle=":")
        known = [(x, z, e, r) for x, z, e, r in zip(phi, Z, error, references) if r]
        pressure.plot([x for x, *_ in known], [r[0] for *_, r in known], color=colour, marker="s", markersize=8,
                      markerfacecolor="none", linestyle="none")
        difference.errorbar([x for x, *_ in known], [100 * (z / r[0] - 1) for _, z, _, r in known],
                            [100 * math.hypot(e, r[1]) / r[0] for _, _, e, r in known], color=colour, marker="o",
                            markersize=4, linestyle="none", capsize=2)
    pressure.set_yscale("log")
    pressure.set_ylabel("Z = P/(n kT)")
    pressure.plot([], [], color="black", marker="s", markersize=8, markerfacecolor="none", linestyle="none",
                  label="reference")
    pressure.plot([], [], color="black", linewidth=0.8, linestyle="--", label="Parsons-Lee")
    pressure.plot([], [], color="black", linewidth=0.8, linestyle=":", label="Nezbeda")
    pressure.legend(fontsize=8)
    difference.axhspan(-1, 1, color="0.92")
    difference.axhline(0, color="black", linewidth=0.8)
    difference.set_ylabel("difference, %")
    difference.set_xlabel("volume fraction")
    report.figure(figure, "Z of isotropic rods (points), references (squares), closed forms (lines); below, the difference.")
