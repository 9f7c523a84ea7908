"""Dilute swimming rods

The first application of the paper: rods that swim along their axes at U_0, so dilute that they meet in pairs. How does the collision pressure, over B2 n^2 kT,
grow with U_0/(L D_R)? Without swimming it is the virial series, a little above 1. The "effective length" sqrt(L (L + U_0/D_R)), put into B2, is drawn beside it.
"""

import math

import numpy

import figures
import reference_values
from report import with_error
from runs import Run
from weighted_fit import WeightedFit

SHAPES = {5: 0.0052, 10: 0.0065, 20: 0.0065}  # L/D: volume fraction
# L/D: rods. Few for long, rather than many for a fifth of a rotation time: until two rods have diffused past each other, which takes some L^2/(4 D_t), five rotation
# times of slender bodies, they meet again and again, and the scatter of a shorter run over its time does not show how far its mean is off.
COUNTS = {5: 30000, 10: 10000, 20: 3000}
QUICK_PART = 20  # so many times fewer in a quick study
SPEEDS = (0.0, 0.5, 1.0, 2.0, 3.5, 5.0)  # U_0/(L D_R)
# D, the default. The collision pressure of rods of L/D = 5 that meet in pairs is some 0.4 % too low at 0.06 D, with an error that goes with the square of the step
# (docs/decisions/0083-arms-half-way.md): some 0.2 % at this one.
RMS_STEP = 0.04
AVERAGED = 16  # rotation times 1/(2 D_R)
# Swimmers gather where they meet, and slow ones take long to: at U_0 = 0.5 L D_R the collision pressure of L/D = 5 and 10 rises by 3 % until rods
# have diffused over some seven diameters, 6 D_t t = 48 D2; longer rods take until they have turned.
LEVELLED = round(48 / 3 / RMS_STEP**2)  # steps


def rotational_diffusion(beta):
    """D_R of a slender body, in kT/(mu D3) (theory, eq. 2.10)."""
    return 3 * (1 + 2 * math.log(2 * beta)) / (2 * math.pi * beta**3)


def time_step(beta):
    """RMS_STEP^2 D2/(2 D_t) of a slender body."""
    b = 2 * math.log(2 * beta) - 1
    translational = (2 * b + 2 * (b + 2)) / 3 / (8 * math.pi * beta)
    return RMS_STEP**2 / (2 * translational)


def rotation(beta):
    """Steps of a rotation time."""
    return math.ceil(0.5 / (rotational_diffusion(beta) * time_step(beta)))


def runs(quick):
    return [Run(name=f"L{beta}_U{speed:g}",
                scene={"seed": 1 + number, "box": {"volume_fraction": phi},
                       "rods": {"count": COUNTS[beta] // (QUICK_PART if quick else 1), "length": float(beta)},
                       "mobility": {"model": "slender_body"},
                       "motion": {"self_propulsion": speed * beta * rotational_diffusion(beta)},
                       "time": {"step": time_step(beta)}, "contact": {"overlap_limit": 0.9}},
                equilibration=max(LEVELLED, rotation(beta)), production=AVERAGED * rotation(beta))
            for number, (beta, phi, speed) in enumerate((beta, phi, speed) for beta, phi in SHAPES.items() for speed in SPEEDS)]


class Shape:
    """Pi_col/(B2 n^2 kT) of one shape against U_0/(L D_R)."""

    def __init__(self, beta, phi, found):
        self.beta = beta
        pair = reference_values.second_virial(beta) * phi / reference_values.rod_volume(beta)  # B2 n
        self.value, self.error = numpy.array([run.value("Z") for run in found]).T
        self.value, self.error = (self.value - 1) / pair, self.error / pair
        self.speed = numpy.array(SPEEDS)
        third, fourth = reference_values.virial_ratios(beta)
        self.virial = 1 + third * pair + fourth * pair**2

    def line(self):
        """(intercept, slope, their errors) of a straight line through the points, weighted."""
        fit = WeightedFit(self.value, self.error, [self.speed**0, self.speed])
        return fit.value, fit.error

    def effective_length(self, speed):
        """B2 of rods of length sqrt(L (L + U_0/D_R)), over that of L."""
        longer = self.beta * numpy.sqrt(1 + speed)
        return reference_values.second_virial(longer) / reference_values.second_virial(self.beta)


def evaluate(report, runs_by_name, quick):
    shapes = [Shape(beta, phi, [run for run in runs_by_name.values() if run.name.startswith(f"L{beta}_")])
              for beta, phi in SHAPES.items()]
    rows, lines, farthest = [], [], 0.0
    for shape in shapes:
        (intercept, slope), errors = shape.line()
        residuals = shape.value - intercept - slope * shape.speed
        farthest = max(farthest, abs(residuals).max())
        formula = shape.effective_length(shape.speed)
        for k, speed in enumerate(SPEEDS):
            rows.append([str(shape.beta), f"{speed:g}", with_error(shape.value[k], shape.error[k], 4),
                         f"{residuals[k]:+.4f}", f"{formula[k]:.3f}"])
        lines.append([str(shape.beta), f"{shape.virial:.4f}", with_error(shape.value[0], shape.error[0], 4),
                      with_error(intercept, errors[0], 4), with_error(slope, errors[1], 4),
                      f"{(residuals**2 / shape.error**2).sum():.1f}"])
        report.compare(f"L/D = {shape.beta}, no swimming: against the virial series", (shape.value[0], shape.error[0]),
                       (shape.virial, 0.0), 0.01)
        report.compare(f"L/D = {shape.beta}, intercept of the line: against the virial series", (intercept, errors[0]),
                       (shape.virial, 0.0), 0.01)
        beyond = abs(formula[-1] - shape.value[-1]) / shape.error[-1]
        report.require(f"L/D = {shape.beta}: the effective length is off at U_0 = {SPEEDS[-1]:g} L D_R, in standard errors",
                       beyond, lower=5)
    longest, shortest = shapes[-1], shapes[0]
    report.require(f"at U_0 = {SPEEDS[-1]:g} L D_R, L/D = {longest.beta} over L/D = {shortest.beta}: below 1, where the effective length has more",
                   longest.value[-1] / shortest.value[-1], upper=1.0)
    report.table("Pi_col/(B2 n^2 kT), its distance from a straight line, and what the effective length would give.",
                 ["L/D", "U_0/(L D_R)", "Pi_col/(B2 n^2 kT)", "residual", "effective length"], rows)
    report.table("Straight lines through the six points of each shape; chi squared has four degrees of freedom.",
                 ["L/D", "virial series at rest", "measured at rest", "intercept", "slope", "chi squared"], lines)
    report.remark(f"The points bend: straight lines do not fit them within their errors, but none is farther from its line than {farthest:.3f}.")
    report.numbers(["L_over_D", "U_0_over_L_D_R", "collision_pressure_over_B2_n2_kT", "standard_error", "effective_length"],
                   [[shape.beta, speed, shape.value[k], shape.error[k], shape.effective_length(speed)]
                    for shape in shapes for k, speed in enumerate(SPEEDS)])
    draw(report, shapes)


def draw(report, shapes):
    figure, panel = figures.axes(size=(5.6, 4.0))
    fine = numpy.linspace(0, SPEEDS[-1], 100)
    for number, shape in enumerate(shapes):
        (intercept, slope), _ = shape.line()
        panel.errorbar(shape.speed, shape.value, shape.error, color=f"C{number}", marker="o", markersize=4, linestyle="none",
                       label=f"L/D = {shape.beta}")
        panel.plot(fine, intercept + slope * fine, color=f"C{number}", linewidth=0.8)
        panel.plot(fine, shape.effective_length(fine), color=f"C{number}", linewidth=0.8, linestyle=":")
    panel.set(xlabel="U_0/(L D_R)", ylabel="Pi_col/(B2 n^2 kT)", ylim=(0, None))
    panel.legend(fontsize=8)
    report.figure(figure, "Collision pressure of dilute swimmers; straight lines through the points, and dotted what the effective length "
                          "would give.")
