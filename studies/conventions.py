"""Three conventions of the collision stress, and the whole stress

What does each convention give for the same forces? Rigid body (theory, eq. 1.1; what jostle reports), centre of mass to centre of mass, and centre line to
centre line (Snook et al. 2014). Measured are the collision pressure and the normal stress difference along less across the mean direction, or along z where rods have none, over n kT. Equilibrium
demands 3 B S of the difference of the first two, which is the geometric stress (theory, eq. 1.8); and in a fluid the second is isotropic. So is, whatever B, the whole stress: n kT, what rotation carries
and collisions together (theory, eqs. 1.19 and 1.21).
"""

import numpy

import figures
import reference_values
from report import with_error
from runs import Run
from stress_tensor import CONVENTIONS, Tensor, predicted_normal_difference, whole_stress

NEMATIC = 0.5  # normal difference over n kT that order demands: below, the mean order is only what rotation has not yet forgotten
ERRORS = 3  # standard errors
ALONG_Z = numpy.array([0.0, 0.0, 1.0])
# L/D, volume fraction, start, thousands of steps to equilibrate and to average: rods that order have shorter steps by default.
STATES = ((5, 0.30, "random", 40, 80), (5, 0.44, "aligned", 100, 200), (5, 0.48, "aligned", 100, 200), (2, 0.40, "random", 40, 80))


def runs(quick):
    return [Run(name=f"L{beta}_phi{phi:.2f}",
                scene={"seed": 4, "box": {"volume_fraction": phi},
                       "rods": {"count": 300 if quick else 1000, "length": float(beta), "start": start},
                       "solver": {"tolerance": 1e-4},
                       "output": {"stress_conventions": True}},
                equilibration=1000 * (4 if quick else equilibration),
                production=1000 * (10 if quick else production))
            for beta, phi, start, equilibration, production in (STATES[1:2] if quick else STATES)]


def evaluate(report, runs_by_name, quick):
    rows, numbers, bars = [], [], []
    for run in runs_by_name.values():
        beta, phi = run.scene["rods"]["length"], run.scene["box"]["volume_fraction"]
        state = f"L/D = {beta:g}, phi = {phi:.2f}"
        series = run.series()
        director = numpy.array(run.summary["director"])
        tensors = {convention: Tensor(run, series, convention) for convention in CONVENTIONS}
        if abs(predicted_normal_difference(run, series, director)[0]) < NEMATIC:
            director = ALONG_Z  # along a mean direction that is chance noise of the stress is not noise about 0
        predicted = predicted_normal_difference(run, series, director)
        differences = {convention: tensor.normal_difference(director) for convention, tensor in tensors.items()}
        for convention, tensor in tensors.items():
            pressure, difference = tensor.pressure(), differences[convention]
            of_row, of_mean = tensor.asymmetry()
            rows.append([f"{beta:g}", f"{phi:.2f}", convention, with_error(*pressure), with_error(*difference),
                         f"{predicted[0]:.3f}" if convention == "rigid body" else "", f"{of_row:.1e}", f"{of_mean:.1e}"])
            numbers.append([beta, phi, convention, *pressure, *difference, predicted[0], of_row, of_mean])
            bars.append((state, convention, pressure, difference))
        whole = whole_stress(run, series)
        difference = whole.normal_difference(director)
        rows.append([f"{beta:g}", f"{phi:.2f}", "whole stress", with_error(*run.value("Z")), with_error(*difference), "0",
                     *(f"{asymmetry:.1e}" for asymmetry in whole.asymmetry())])
        numbers.append([beta, phi, "whole stress", *run.value("Z"), *difference, 0.0, *whole.asymmetry()])
        total, centre = tensors["rigid body"], tensors["centre of mass"]
        trace_apart = numpy.abs(numpy.trace(total.rows - centre.rows, axis1=1, axis2=2)).max()
        report.require(f"{state}: difference of the traces of rigid body and centre of mass, largest of any row",
                       trace_apart, upper=1e-9 * abs(total.pressure()[0]))
        report.require(f"{state}: asymmetry of the rigid-body stress, largest of any row", total.asymmetry()[0], upper=1e-9)
        report.require(f"{state}: asymmetry of the centre-line stress, largest of any row",
                       tensors["centre line"].asymmetry()[0], upper=1e-9)
        nematic = abs(predicted[0]) > NEMATIC
        if nematic:
            report.compare(f"{state}: normal difference of the geometric stress against 3 B S",
                           (total - centre).normal_difference(director), predicted, 0.01, errors=ERRORS)
        if phi < reference_values.LAYERS_ABOVE:
            report.compare(f"{state}: normal difference, centre of mass, against 0", differences["centre of mass"],
                           (0.0, 0.0), 0.0, errors=ERRORS)
            report.compare(f"{state}: normal difference, whole stress, against 0", difference, (0.0, 0.0), 0.0, errors=ERRORS)
    report.table("Collision pressure (whole stress: Z) and normal stress difference over n kT, and what equilibrium demands of it (rigid body: 3 B S); asymmetry relative to the trace, of the worst row and of the mean. "
                 "Errors are from 20 blocks of the run, those of Z by the program, which knows how slow the order is.",
                 ["L/D", "phi", "convention", "pressure", "normal difference", "demanded", "asymmetry, row", "mean"], rows)
    report.numbers(["L_over_D", "phi", "convention", "pressure", "pressure_error", "normal_difference",
                 "normal_difference_error", "predicted_normal_difference", "asymmetry_row", "asymmetry_mean"], numbers)
    report.remark("Rigid body and centre of mass have the same pressure, row by row: the geometric stress has no trace. The centre-of-mass stress is "
                  "isotropic even in the nematic, so all of the normal stress difference is geometric; row by row it is not symmetric. The centre-line "
                  "stress is symmetric, but leaves out of the pressure what forces along the axes carry between the centres.")
    report.remark("What rotation carries takes back what the geometric stress adds: the whole stress of a nematic at rest is as isotropic as that of a liquid has to be, "
                  "with collisions alone along the director some fifth above what they are across.")
    report.remark("At volume fraction 0.48 rods form layers ([nematic_transition](#nematic_transition) measures them), and a cube does not fit a whole "
                  "number of them: the centre-of-mass stress is then the elastic stress of a strained smectic. It is shown, and not judged; the "
                  "geometric stress is right there, too.")
    for run in runs_by_name.values():
        if run.scene["box"]["volume_fraction"] >= reference_values.LAYERS_ABOVE:
            report.remark(of_layers(run))
    draw(report, bars)


def of_layers(run):
    """What an error bar cannot know: of a state that the run is too short to reach."""
    reference = reference_values.monte_carlo_at(run.scene["rods"]["length"], run.scene["box"]["volume_fraction"], "aligned")
    checks = [check["agree"] for check in run.summary["checks"].values()]
    return (f"Layers take longer to form than this run lasts. Its Z is {with_error(*run.value('Z'))}, that of Monte Carlo {with_error(reference.Z, reference.Z_error)}, "
            f"and the error bar does not know of that. Of the run's exact checks {checks.count(False)} of {len(checks)} disagree.")


def draw(report, bars):
    figure, panels = figures.axes(1, 2, size=(8.6, 3.6))
    states = list(dict.fromkeys(state for state, *_ in bars))
    for panel, entry, label in ((panels[0], 2, "collision pressure/(n kT)"), (panels[1], 3, "normal stress difference/(n kT)")):
        for number, convention in enumerate(CONVENTIONS):
            values = [bar[entry] for bar in bars if bar[1] == convention]
            places = [k + 0.27 * (number - 1) for k in range(len(states))]
            panel.bar(places, [v for v, _ in values], 0.25, yerr=[e for _, e in values], label=convention, color=f"C{number}")
        panel.set_xticks(range(len(states)), [state.replace(", ", "\n") for state in states], fontsize=8)
        panel.set_ylabel(label)
        panel.axhline(0, color="black", linewidth=0.8)
    panels[0].legend(fontsize=8)
    report.figure(figure, "The same forces, three conventions: collision pressure and normal stress difference.")
