"""Hard rods against a soft potential

The paper's motive: a method for hard bodies takes longer steps than a stiff potential. The same rods (L/D = 5, phi = 0.20, 500 of them, the same program) as hard
bodies with the correction, as hard bodies in the paper's plain scheme, and with a WCA potential of energy kT on the nearest distance, whose diameter is chosen so that its effective
hard diameter (Barker and Henderson 1967) is that of the hard rods. How long may a step be for the same error of Z, and what does a unit of simulated time then cost?
"""

import math

import numpy

import figures
import reference_values
from report import with_error
from runs import Run

BETA, PHI, COUNT = 5.0, 0.20, 500
TIME_PER_SQUARED_STEP = 12.8  # mu D/kT: time step over (rms step)^2 for this rod
STEPS = {  # method: {rms step / D: simulated time, mu D3/kT}
    "hard, corrected": {0.02: 800, 0.03: 1200, 0.06: 2000, 0.1: 2000, 0.15: 2000},
    "hard, plain": {0.0025: 160, 0.005: 400, 0.01: 800, 0.02: 800, 0.03: 1200},
    "WCA": {0.0025: 240, 0.004: 400, 0.006: 600, 0.01: 800, 0.015: 800, 0.02: 200},  # the last: beyond it rods pass through each other
}
QUICK_STEPS = {"hard, corrected": {0.06: 80}, "WCA": {0.006: 15}}
TARGETS = (0.01, 0.02)  # error of Z


def effective_diameter(energy=1.0):
    """Barker-Henderson diameter of the WCA potential over its own: integral of 1 - exp(-U/kT)."""
    r = (numpy.arange(200000) + 0.5) / 200000 * 2**(1 / 6)
    with numpy.errstate(over="ignore"):
        U = 4 * energy * (r**-12 - r**-6) + energy
        return float((1 - numpy.exp(-U)).mean() * 2**(1 / 6))


def runs(quick):
    edge = (COUNT * reference_values.rod_volume(BETA) / PHI) ** (1 / 3)
    chosen = []
    for method, steps in (QUICK_STEPS if quick else STEPS).items():
        soft = method == "WCA"
        for rms, time in steps.items():
            contact = {"model": "wca", "energy": 1.0, "overlap_limit": 0.9} if soft else {
                "brownian_correction": method == "hard, corrected"}
            if rms >= 0.1:
                contact["overlap_limit"] = 0.9  # such steps are to fail by their Z, not by their largest overlap
            scene = {"seed": 5, "box": {"edges": (edge, edge, edge)},
                     "rods": {"count": COUNT, "length": BETA, "diameter": 1 / effective_diameter() if soft else 1.0},
                     "contact": contact, "time": {"rms_step": rms}}
            if not soft:
                scene["solver"] = {"tolerance": 1e-4}
            production = math.ceil(time / (TIME_PER_SQUARED_STEP * rms**2))
            chosen.append(Run(f"{method.replace(', ', '_').lower()}_rms{rms}", scene,
                              max(500, production // 10), production))
    return chosen


class Method:
    """Deviation of Z and cost of simulated time against the time step."""

    def __init__(self, name, found):
        self.name = name
        reference = reference_values.monte_carlo_at(BETA, PHI)
        self.rms = numpy.array([run.scene["time"]["rms_step"] for run in found])
        self.time_step = numpy.array([run.time_step for run in found])
        self.Z, self.error = numpy.array([run.value("Z") for run in found]).T
        self.deviation = self.Z / reference.Z - 1
        self.deviation_error = numpy.hypot(self.error, reference.Z_error) / reference.Z
        self.seconds = numpy.array([run.wall_seconds / run.record["steps"] for run in found]) / self.time_step

    def longest_step(self, target):
        """(time step, seconds per unit of time) above which |deviation| is above `target`, between two steps in
        proportion; the last step measured if it is not reached; None if all are beyond.

        The error of a step grows with it. So a shorter step that is beyond the target, where a longer one is not, is
        beyond it by the scatter of its mean."""
        inside = numpy.flatnonzero(numpy.abs(self.deviation) <= target)
        if inside.size == 0:
            return None
        k = int(inside[-1]) + 1
        if k == len(self.deviation):
            return self.time_step[-1], self.seconds[-1], False
        low, high = abs(self.deviation[k - 1]), abs(self.deviation[k])
        fraction = min(max((target - low) / (high - low), 0.0), 1.0)

        def between(values):
            return math.exp(math.log(values[k - 1]) + fraction * (math.log(values[k]) - math.log(values[k - 1])))

        return between(self.time_step), between(self.seconds), True


def evaluate(report, runs_by_name, quick):
    methods = [Method(name, [run for run in runs_by_name.values() if run.name.startswith(name.replace(", ", "_").lower())])
               for name in (QUICK_STEPS if quick else STEPS)]
    rows = [[method.name, f"{rms:g}", f"{step:.2e}", with_error(Z, error), f"{100 * deviation:+.2f} +- {100 * d_error:.2f}",
             f"{seconds:.3f}"]
            for method in methods for rms, step, Z, error, deviation, d_error, seconds in
            zip(method.rms, method.time_step, method.Z, method.error, method.deviation, method.deviation_error, method.seconds)]
    reference = reference_values.monte_carlo_at(BETA, PHI)
    report.table(f"Z against {with_error(reference.Z, reference.Z_error)} (Monte Carlo), and processor seconds per unit of time (mu D3/kT), {COUNT} rods.",
                 ["method", "rms step / D", "time step", "Z", "deviation, %", "s per time"], rows)
    report.numbers(["method", "rms_step", "time_step", "Z", "standard_error", "deviation", "deviation_error", "seconds_per_time"],
                [[m.name, *values] for m in methods for values in
                 zip(m.rms, m.time_step, m.Z, m.error, m.deviation, m.deviation_error, m.seconds)])
    report.remark(f"The WCA rods have a diameter of {1 / effective_diameter():.4f} D. Their longest step is 0.02 D, though Z is not off by much there: at longer ones rods "
                  "pass through each other ([beside the studies](beside_the_studies.md#the-longest-step-of-soft-rods)).")
    for method in methods:
        if method.name == "hard, plain":
            continue
        # A potential has no hard diameter to be exact for: what is left of it at the smallest step may be two per cent.
        report.compare(f"{method.name}, smallest step", (method.Z[0], method.error[0]), (reference.Z, reference.Z_error),
                       0.02 if method.name == "WCA" else 0.01)
    if not quick:
        race(report, methods)
    draw(report, methods)


def race(report, methods):
    rows = []
    corrected = methods[0]
    for target in TARGETS:
        best = corrected.longest_step(target)
        for method in methods:
            found = method.longest_step(target)
            if not found or not best:
                rows.append([f"{100 * target:g}", method.name, "beyond the target at every step", "", "", ""])
                continue
            step, seconds, reached = found
            least, most = ("", "") if reached else ("at least ", "at most ")
            rows.append([f"{100 * target:g}", method.name, f"{least}{step:.2e}", f"{most}{seconds:.3f}",
                         f"{most}{best[0] / step:.1f}", f"{most}{seconds / best[1]:.1f}"])
    report.table("The longest step for an error of Z, and what simulated time costs there; ratios to the hard rods with the correction.",
                 ["error, %", "method", "time step", "s per time", "steps needed, ratio", "processor time, ratio"], rows)


def draw(report, methods):
    figure, panels = figures.axes(1, 2, size=(8.6, 3.6))
    for number, method in enumerate(methods):
        style = {"color": f"C{number}", "marker": "o", "markersize": 4, "linewidth": 1}
        panels[0].errorbar(method.rms, 100 * method.deviation, 100 * method.deviation_error, label=method.name, **style)
        panels[1].errorbar(method.seconds, 100 * numpy.abs(method.deviation), 100 * method.deviation_error, **style)
    panels[0].axhspan(-1, 1, color="0.92")
    panels[0].set(xscale="log", xlabel="rms step / D", ylabel="deviation of Z, %")
    panels[0].legend(fontsize=8)
    panels[1].axhspan(0, 1, color="0.92")
    panels[1].set(xscale="log", xlabel="processor seconds per unit of time", ylabel="|deviation of Z|, %")
    report.figure(figure, "Deviation of Z against the step, and against the cost of simulated time; grey: within one per cent.")
