"""Error of the time step

How far is Z off at a finite time step, in the scheme of the paper ("plain") and with the correction (theory, section 3)? The plain error should fall as the
square root of the step in time, that is in proportion to the rms step (order 1/2); the corrected one at least as the step in time (order 1).
"""

import math

import numpy

import figures
import reference_values
from report import with_error
from runs import Run
from weighted_fit import WeightedFit

STATES = ((0, 0.2), (0, 0.4), (5, 0.2), (5, 0.3))  # L/D, volume fraction
STEPS = {0.005: 100000, 0.01: 60000, 0.02: 50000, 0.03: 50000, 0.045: 30000, 0.06: 40000, 0.1: 20000, 0.15: 20000, 0.2: 20000}  # rms step: production
QUICK_STEPS = {0.02: 12000, 0.03: 10000, 0.06: 6000, 0.1: 5000}
AIMS = {0.03: 0.005, 0.06: 0.01}  # rms step: largest error of the corrected Z, beside two combined standard errors
SHARE = {"plain": 0.5, "corrected": 1.0}  # of STEPS: the plain errors are the larger ones
SCHEMES = tuple(SHARE)
TURNING = 35.0  # mu D3/kT: in this time rods of L/D = 5 turn so far that their order is forgotten
ORDER_UP_TO, FIT_UP_TO = 0.045, 0.1  # rms steps
LONGEST_PLAIN = 0.1  # at 0.2 rods pass through each other


def runs(quick):
    steps = QUICK_STEPS if quick else STEPS
    states = STATES[:1] if quick else STATES
    return [Run(name=f"L{beta}_phi{phi}_rms{rms}_{scheme}",
                scene={"seed": 2, "box": {"volume_fraction": phi},
                       "rods": {"count": 500 if quick else 1000, "length": float(beta)},
                       "contact": {"brownian_correction": scheme == "corrected", "overlap_limit": 0.9},
                       "time": {"rms_step": rms},
                       "solver": {"tolerance": 1e-4}},
                # A random start is forgotten, and the order of rods, which Z follows, is averaged over.
                equilibration=max(production // 10 + int(1000 * (0.03 / rms)**1.5), turning_time(beta, rms)),
                production=max(int(SHARE[scheme] * production), 4 * turning_time(beta, rms)))
            for beta, phi in states for scheme in SCHEMES for rms, production in steps.items()
            if scheme == "corrected" or rms <= LONGEST_PLAIN]


def turning_time(beta, rms):
    """TURNING in steps, for rods at short steps; spheres do not turn, and longer steps last for about four of it anyhow, or more."""
    return math.ceil(TURNING / (12.8 * rms**2)) if beta > 0 and rms < 0.02 else 0


class Series:
    """Z against the rms step, of one state and scheme."""

    def __init__(self, beta, phi, scheme, runs_by_name):
        self.beta, self.phi, self.scheme = beta, phi, scheme
        found = [run for run in runs_by_name.values() if run.name.startswith(f"L{beta}_phi{phi}_")
                 and run.name.endswith(scheme)]
        self.rms = numpy.array([run.scene["time"]["rms_step"] for run in found])
        self.Z, self.error = numpy.array([run.value("Z") for run in found]).T
        self.reference, self.reference_error, _ = reference_values.best(beta, phi)
        self.deviation = self.Z / self.reference - 1
        self.deviation_error = numpy.hypot(self.error, self.reference_error) / self.reference

    @property
    def label(self):
        return f"L/D = {self.beta}, phi = {self.phi}"

    def deviation_at(self, rms):
        """In per cent, as text; empty where it was not measured."""
        point = numpy.flatnonzero(self.rms == rms)
        return f"{100 * self.deviation[point[0]]:+.2f}({100 * self.deviation_error[point[0]]:.2f})" if len(point) else ""

    def order_of_all(self):
        """(order in the step in time, standard error): deviation = c rms^(2 order), the best fit to all steps and where its chi squared is larger by 1; None
        where no deviation is above five standard errors."""
        if numpy.all(numpy.abs(self.deviation) < 5 * self.deviation_error):
            return None
        orders = numpy.arange(0.25, 4, 0.005)
        powers = self.rms[None, :]**(2 * orders[:, None]) / self.deviation_error
        scaled = self.deviation / self.deviation_error
        chi_squared = (scaled**2).sum() - (powers @ scaled)**2 / (powers**2).sum(axis=1)
        near = orders[chi_squared < chi_squared.min() + 1]
        return orders[chi_squared.argmin()], (near[-1] - near[0]) / 2

    def order_of_small_steps(self):
        """(order in the step in time, standard error): half the slope of log |deviation| against log rms, over points up
        to ORDER_UP_TO whose deviation is above three standard errors; None from fewer than three such points."""
        clear = (numpy.abs(self.deviation) > 3 * self.deviation_error) & (self.rms <= ORDER_UP_TO)
        if clear.sum() < 3:
            return None
        fit = WeightedFit(numpy.log(numpy.abs(self.deviation[clear])),
                          self.deviation_error[clear] / numpy.abs(self.deviation[clear]),
                          [self.rms[clear]**0, numpy.log(self.rms[clear])])
        return fit.value[1] / 2, fit.error[1] / 2


def fit_both(plain, corrected):
    """Both schemes have one limit: fits Z0 + a1 x + a2 x^2 + a3 x^3 to the plain and Z0 + b1 x + b2 x^2 to the corrected Z,
    x the rms step up to FIT_UP_TO.

    Returns (Z0, its error) with b1 = 0, and (b1/|a1|, its error) with b1 free: what is left of the error of order 1/2.
    """
    x = numpy.concatenate([plain.rms, corrected.rms])
    scheme = numpy.repeat([1.0, 0.0], [len(plain.rms), len(corrected.rms)])
    values, errors = numpy.concatenate([plain.Z, corrected.Z]), numpy.concatenate([plain.error, corrected.error])
    near = x <= FIT_UP_TO
    columns = [column[near] for column in (x**0, scheme * x, scheme * x**2, scheme * x**3, (1 - scheme) * x**2,
                                           (1 - scheme) * x)]
    limit = WeightedFit(values[near], errors[near], columns[:-1])
    free = WeightedFit(values[near], errors[near], columns)
    return (limit.value[0], limit.error[0]), (free.value[-1] / abs(free.value[1]), free.error[-1] / abs(free.value[1]))


def evaluate(report, runs_by_name, quick):
    states = STATES[:1] if quick else STATES
    every = {(state, scheme): Series(*state, scheme, runs_by_name) for state in states for scheme in SCHEMES}
    numbers = [[s.beta, s.phi, s.scheme, rms, Z, error, 100 * deviation, 100 * deviation_error]
               for s in every.values() for rms, Z, error, deviation, deviation_error
               in zip(s.rms, s.Z, s.error, s.deviation, s.deviation_error)]
    report.numbers(["L_over_D", "phi", "scheme", "rms_step", "Z", "standard_error", "deviation_per_cent",
                    "deviation_error_per_cent"], numbers)
    every_rms = sorted({rms for s in every.values() for rms in s.rms})
    rows = [[f"{s.beta}", f"{s.phi}", s.scheme, *(s.deviation_at(rms) for rms in every_rms)] for s in every.values()]
    report.table("Deviation of Z from the reference, in per cent (standard error of both), against the rms step in D.",
                 ["L/D", "phi", "scheme", *(f"{rms:g}" for rms in every_rms)], rows)
    for s in every.values():
        for rms, aim in AIMS.items() if s.scheme == "corrected" else ():
            point = numpy.flatnonzero(s.rms == rms)[0]
            report.compare(f"{s.label}, corrected, rms step {rms}", (s.Z[point], s.error[point]),
                           (s.reference, s.reference_error), aim)
    if not quick:
        judge_orders(report, {state: [every[state, scheme] for scheme in SCHEMES] for state in states})
    draw(report, every)


def judge_orders(report, by_state):
    rows = []
    for plain, corrected in by_state.values():
        limit, left = fit_both(plain, corrected)
        orders = [plain.order_of_small_steps(), corrected.order_of_all()]
        rows.append([f"{plain.beta}", f"{plain.phi}",
                     *(with_error(*order, 2) if order else "too small to fit" for order in orders),
                     with_error(*(100 * value for value in left), 1), with_error(*limit),
                     with_error(plain.reference, plain.reference_error)])
        report.compare(f"{plain.label}, both schemes at step 0", limit, (plain.reference, plain.reference_error), 0.005)
        report.compare(f"{plain.label}, plain, order", orders[0] or (math.nan, 0.0), (0.5, 0.0), 0.2)
        if orders[1]:
            report.require(f"{plain.label}, corrected, order and two standard errors", orders[1][0] + 2 * orders[1][1], lower=1)
        report.compare(f"{plain.label}, what the correction leaves of the error of order 1/2", (1 + left[0], left[1]),
                       (1.0, 0.0), 0.05)
    report.table(f"Order of the error in the step in time (plain: up to rms step {ORDER_UP_TO:g}; 1/2: in proportion to the rms step; corrected: the best fit "
                 f"of one power to all steps), what the correction leaves of the term of order 1/2, and Z at step 0, from a fit to both schemes up to rms step {FIT_UP_TO:g}.",
                 ["L/D", "phi", "order, plain", "order, corrected", "left of order 1/2, %", "Z at step 0", "reference"], rows)


def draw(report, every):
    figure, panels = figures.axes(1, 2, size=(8.4, 3.8))
    for number, ((state, scheme), s) in enumerate(every.items()):
        colour = f"C{number // 2}"
        style = {"color": colour, "marker": "o" if scheme == "corrected" else "s", "markersize": 4, "linewidth": 1,
                 "linestyle": "-" if scheme == "corrected" else "--",
                 "markerfacecolor": colour if scheme == "corrected" else "none"}
        panels[0].errorbar(s.rms, 100 * s.deviation, 100 * s.deviation_error, **style,
                           label=s.label if scheme == "corrected" else None)
        seen = numpy.abs(s.deviation) > 2 * s.deviation_error  # the others are zero within their errors
        panels[1].errorbar(s.rms[seen], 100 * numpy.abs(s.deviation[seen]), 100 * s.deviation_error[seen], **style)
    panels[0].axhline(0, color="black", linewidth=0.8)
    panels[0].set_ylabel("deviation of Z, %")
    panels[0].legend(fontsize=8, title="corrected: full, plain: dashed", title_fontsize=8)
    x = numpy.array([0.005, 0.1])
    panels[1].plot(x, 600 * x**1, color="0.6", linewidth=0.8)
    panels[1].plot(x, 1500 * x**2, color="0.6", linewidth=0.8)
    panels[1].annotate("order 1/2", (0.02, 14), color="0.4", fontsize=8)
    panels[1].annotate("order 1", (0.04, 1.6), color="0.4", fontsize=8)
    panels[1].set(xscale="log", yscale="log", ylim=(0.02, 60), ylabel="|deviation of Z|, %")
    for panel in panels:
        panel.set_xlabel("rms step / D")
    report.figure(figure, "Deviation of Z from the reference against the rms step, in the plain scheme and with the "
                          "correction; right, the same in logarithms where it is above two standard errors, with lines of order 1/2 and 1.")
