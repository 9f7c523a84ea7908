"""Viscosity at rest: fluctuations of the stress against a slow flow

The viscosity that jostle reads off the fluctuations of the stress of a run at rest, beside that of sheared runs of the same program at the same steps: spheres at volume fraction 0.3, and rods.
Free rods have the viscosity of Smoluchowski's equation; spheres so dilute that they meet two at a time, without a fluid between them, have 12/5 phi^2 times that of the fluid.
"""

import math

import figures
from report import with_error
from runs import Run

D0 = 1.0 / (3.0 * math.pi)  # of a sphere, D = kT = viscosity = 1
PHI = 0.3
STEPS = (0.06, 0.04, 0.03)
LONGEST_GOOD = 0.04  # the default; longer ones are shown
QUICK_STEP = 0.08
RATES = (0.5, 1.0, 2.0)  # in D0/D2
BOUND = 0.05
DILUTE, DILUTE_STEP, DILUTE_COUNT = (0.01, 0.03), 0.03, 100  # volume fractions, from which pairs alone follow by a straight line
PAIRS, PAIRS_BOUND = 12 / 5, 0.04
FREE_DENSITY = 1e-6
FREE_ROTATION = 0.00651347  # D_R of L/D = 5, by the mobility model "capsule"
ANISOTROPY = 0.955626  # B of L/D = 5


def runs(quick):
    steps = (QUICK_STEP,) if quick else STEPS
    rest = [spheres(f"rest_{rms:g}", 216, rms, (400.0 if quick else 1500.0 * rms / STEPS[0])) for rms in steps]
    sheared = [spheres(f"sheared_{rate:g}_{rms:g}", 500, rms, 100.0 if quick else 600.0 / rate**1.5, rate)
               for rms in steps for rate in ((1.0,) if quick else RATES) if rms in (QUICK_STEP, LONGEST_GOOD) or rate == 1.0]
    free = Run(name="free", scene={"seed": 5, "box": {"volume_fraction": FREE_DENSITY}, "rods": {"count": 50, "length": 5.0},
                                   "time": {"step": 0.005 / FREE_ROTATION}, "output": {"series_every": 5}},
               equilibration=400, production=80000 if quick else 400000)
    dilute = [] if quick else [spheres(f"dilute_{phi:g}", DILUTE_COUNT, DILUTE_STEP, 4500.0, phi=phi) for phi in DILUTE]
    return [*rest, *sheared, free, *dilute]


def spheres(name, count, rms, duration, rate=None, phi=PHI):
    """`duration` in D2/D0."""
    steps = round(duration / (0.5 * rms**2))
    scene = {"seed": 5, "box": {"volume_fraction": phi}, "rods": {"count": count, "length": 0.0}, "time": {"rms_step": rms},
             "output": {"series_every": 20}}
    if rate is not None:
        scene["flow"] = {"shear_rate": rate * D0}
    return Run(name=name, scene=scene, equilibration=round(5.0 / (0.5 * rms**2)), production=steps)


def evaluate(report, runs_by_name, quick):
    rows, numbers = [], []
    figure, panel = figures.axes(size=(5.6, 3.0))
    for rms in (QUICK_STEP, *STEPS):
        rest = runs_by_name.get(f"rest_{rms:g}")
        if not rest:
            continue
        found = average_of(rest.summary["viscosity_at_rest"])
        panel.errorbar(0.0, found[0], yerr=found[1], marker="s", color=f"C{STEPS.index(rms) if rms in STEPS else 0}", label=f"at rest, rms step {rms:g}")
        numbers.append(["rest", PHI, rms, 0.0, *found])
        for rate in RATES:
            if run := runs_by_name.get(f"sheared_{rate:g}_{rms:g}"):
                sheared = average_of(run.summary["flow"]["viscosity"])
                panel.errorbar(rate, sheared[0], yerr=sheared[1], marker="o", color=f"C{STEPS.index(rms) if rms in STEPS else 0}")
                numbers.append(["sheared", PHI, rms, rate, *sheared])
                rows.append([f"{rms:g}", f"{rate:g}", with_error(*found), with_error(*sheared)])
                if rate <= 1.0 and (quick or rms <= LONGEST_GOOD):
                    report.compare(f"spheres, phi {PHI:g}, rms step {rms:g}: viscosity at rest, against a rate of {rate:g} D0/D2", found, sheared, BOUND)
    report.table("Spheres at volume fraction 0.3: viscosity over that of the fluid, at rest and sheared.", ["rms step", "rate D2/D0", "at rest", "sheared"], rows)
    if run := runs_by_name.get("free"):
        density = FREE_DENSITY / (math.pi * (5.0 / 4.0 + 1.0 / 6.0))
        known = density * ANISOTROPY**2 / (10.0 * FREE_ROTATION)
        mean, error = average_of(run.summary["viscosity_at_rest"])
        report.compare("free rods L/D = 5: viscosity at rest over n kT B2/(10 D_R)", (mean / known, error / known), (1.0, 0.0), 0.02)
    if not quick:
        compare_pairs(report, runs_by_name, numbers)
    panel.set_xlabel("shear rate D2/D0")
    panel.set_ylabel("viscosity / that of the fluid")
    panel.legend(frameon=False)
    report.figure(figure, "Viscosity of spheres at volume fraction 0.3.")
    report.numbers(["what", "phi", "rms_step", "rate", "viscosity", "viscosity_error"], numbers)


def compare_pairs(report, runs_by_name, numbers):
    """eta/phi^2 of spheres that meet two at a time: of two volume fractions, on a straight line to none."""
    (first, first_error), (last, last_error) = (average_of(runs_by_name[f"dilute_{phi:g}"].summary["viscosity_at_rest"]) for phi in DILUTE)
    low, high = DILUTE
    numbers += [["rest", low, DILUTE_STEP, 0.0, first, first_error], ["rest", high, DILUTE_STEP, 0.0, last, last_error]]
    weight = high / (high - low)
    mean = weight * first / low**2 + (1 - weight) * last / high**2
    error = math.hypot(weight * first_error / low**2, (1 - weight) * last_error / high**2)
    report.compare("dilute spheres: viscosity at rest over phi^2, without phi", (mean, error), (PAIRS, 0.0), PAIRS_BOUND)
    report.table("Dilute spheres: viscosity at rest, over that of the fluid and the square of the volume fraction.", ["phi", "eta/(mu phi^2)"],
                 [[f"{low:g}", with_error(first / low**2, first_error / low**2)], [f"{high:g}", with_error(last / high**2, last_error / high**2)],
                  ["0", with_error(mean, error)]])


def average_of(entry):
    """Mean and error; nothing where the program gives none."""
    return tuple(math.nan if entry[name] is None else entry[name] for name in ("mean", "standard_error"))
