"""The isotropic-nematic transition

L/D = 5 from aligned and from random starts: do Z, the nematic order S and the anisotropy of the collision stress jump where Monte Carlo and the literature say,
and is the anisotropy the one that equilibrium demands, (Z_c + 2 B S)/(Z_c - B S) with Z_c = Z - 1 (theory, eq. 1.8)? Every run here is a cube of
1000 rods, as is the Monte Carlo.

The demand has two parts. The geometric stress is 2 n kT B Q wherever directions are in equilibrium; the rest is isotropic in a fluid. Beyond volume fraction 0.46
layers form, which a cube does not fit: there the rest is not isotropic, and only the first part is judged.
"""

import math

import figures
import reference_values
from layers import layer_order
from report import per_cent, with_error
from runs import Run, error_of_blocks
from stress_tensor import Tensor, predicted_normal_difference, whole_stress

BETA = 5
ORDERS_BEYOND = 0.41  # volume fraction: there the default rms step is the shorter one
LONG_STEP = 0.06
# Thousands of steps to equilibrate and to average, from each start. Near the transition S is correlated over some 400 mu D3/kT, 20 thousand steps of 0.04 D or
# 50 thousand of 0.025 D, and a start from perfect alignment that has to lose most of its order is given five of them and more. At 0.50
# layers stand after 4500 mu D3/kT, and Z falls by 2 % with them; at 0.48 they come and go over 10,000, with 5 % of Z.
LENGTHS = {
    "aligned": {0.38: (60, 500), 0.42: (250, 1800), 0.44: (150, 900), 0.46: (150, 1000), 0.48: (1500, 1500), 0.50: (700, 1000)},
    "random": {0.30: (20, 140), 0.38: (30, 450), 0.40: (60, 450)},
}
LENGTHS_AT_LONG_STEP = {("aligned", 0.42): (60, 420), ("aligned", 0.46): (30, 190)}  # where S answers most to anything, and deep in the nematic
NEMATIC = 0.4  # S above this is called nematic: the transition jumps from 0.2 to 0.57


def default_step(phi):
    """The rms step that such a scene has by default, in D."""
    return 0.025 if phi > ORDERS_BEYOND else 0.04


def runs(quick):
    if quick:
        chosen = {("aligned", 0.44, 0.04): (10, 30)}
    else:
        chosen = {(start, phi, default_step(phi)): length for start, lengths in LENGTHS.items() for phi, length in lengths.items()}
        chosen |= {(*state, LONG_STEP): length for state, length in LENGTHS_AT_LONG_STEP.items()}
    return [Run(name=f"{start}_phi{phi:.2f}" + (f"_rms{rms:g}" if rms == LONG_STEP else ""),
                scene={"seed": 3, "box": {"volume_fraction": phi},
                       "rods": {"count": 300 if quick else 1000, "length": float(BETA), "start": start},
                       "time": {"rms_step": rms}, "contact": {"overlap_limit": 0.5},
                       "solver": {"tolerance": 1e-4}, "output": {"stress_conventions": True, "trajectory_every": 500 if quick else 2000}},
                equilibration=1000 * equilibration,
                production=1000 * production)
            for (start, phi, rms), (equilibration, production) in sorted(chosen.items(), key=lambda item: -sum(item[1]))]  # the longest first


def evaluate(report, runs_by_name, quick):
    rows, parts, numbers, points, not_judged = [], [], [], {}, []
    for run in sorted(runs_by_name.values(), key=lambda run: (run.scene["rods"]["start"], run.scene["box"]["volume_fraction"])):
        if run.scene["time"]["rms_step"] == LONG_STEP:
            continue
        start, phi = run.scene["rods"]["start"], run.scene["box"]["volume_fraction"]
        state = f"{start} start, phi = {phi:.2f}"
        Z, S = run.value_if_any("Z"), order(run)
        check = run.summary["checks"]["collision_stress_ratio"]
        measured, predicted = check["measured"]["mean"], check["in_equilibrium"]["to"]
        error = check["standard_error"] or math.nan
        entry = run.summary["nematic_order"]
        correlation = entry["correlation_time_rows"] * 10 * run.time_step
        equilibrium = reference_values.monte_carlo_at(BETA, phi, "aligned" if start == "aligned" else "isotropic")
        # Beyond the transition a random start is not in equilibrium: it is shown, and not judged.
        if equilibrium and not (start == "random" and phi > 0.40):
            trusted = 0.01 if phi > 0.49 else 0.005 if 0.37 < phi < 0.41 else 0.0  # of the reference, beside its error bar
            if math.isnan(Z[1]):
                not_judged.append(f"{state}: Z")
            elif not quick:
                report.compare(f"{state}: Z", Z, (equilibrium.Z, equilibrium.Z_error), 0.01 + trusted)
        if S[0] > NEMATIC:
            series, director = run.series(), run.summary["director"]
            centre = Tensor(run, series, "centre of mass")
            demanded = predicted_normal_difference(run, series, director)
            geometric = (Tensor(run, series, "rigid body") - centre).normal_difference(director)
            rest = centre.normal_difference(director)
            parts.append([start, f"{phi:.2f}", with_error(*geometric), with_error(*demanded),
                          per_cent(geometric[0], demanded[0], geometric[1]), with_error(*rest),
                          with_error(*whole_stress(run, series).normal_difference(director)),
                          *(f"{value:.2f}" for value in layer_order(run, director))])
            report.compare(f"{state}: normal difference of the geometric stress", geometric, demanded, 0.02)
            if phi < reference_values.LAYERS_ABOVE:
                report.compare(f"{state}: anisotropy of the stress", (measured, error), (predicted, 0.0), 0.005, errors=3)
            if equilibrium and not quick:
                allowed = 0.02 if phi < 0.43 else 0.01
                report.compare(f"{state}: S", S, (equilibrium.S, equilibrium.S_error), allowed / equilibrium.S, errors=3)
        points.setdefault(start, []).append((phi, Z, S, measured, predicted, error))
        reference = with_error(equilibrium.Z, equilibrium.Z_error) if equilibrium else ""
        difference = per_cent(Z[0], equilibrium.Z, math.hypot(Z[1], equilibrium.Z_error)) if equilibrium else ""
        rows.append([start, f"{phi:.2f}", with_error(*Z), reference, difference, with_error(*S),
                     f"{equilibrium.S:.3f}" if equilibrium else "", f"{correlation:.0f}", f"{entry['n_eff']:.0f}",
                     with_error(measured, check["measured"]["standard_error"] or math.nan), f"{predicted:.3f}"])
        numbers.append([start, phi, *Z, *S, correlation, entry["n_eff"], measured, predicted, error])
    report.table("Z, order S and anisotropy sigma_max/sigma_min; tau_S is the correlation time of S in mu D3/kT (free rods forget their direction in "
                 "1/(6 D_R) = 29), n_S how many independent samples of S the run holds (below 25 the error of S is that of 8 blocks). "
                 "In brackets what has no error bar.",
                 ["start", "phi", "Z", "Monte Carlo Z", "difference, %", "S", "Monte Carlo S", "tau_S", "n_S", "anisotropy",
                  "predicted"], rows)
    report.table("Normal stress difference along less across the director, over n kT, in the nematic: geometric part, what equilibrium demands of it, the rest, and the whole stress (theory, eq. 1.19). "
                 "Layers: mean of |sum exp(i q.r)|/N over the frames, largest of all q that fit the box (0.03 would be chance), and their spacing in D.",
                 ["start", "phi", "geometric", "3 B S", "difference, %", "rest", "whole", "layers", "spacing"], parts)
    report.numbers(["start", "phi", "Z", "Z_error", "S", "S_error", "S_correlation_time", "S_samples", "anisotropy",
                 "anisotropy_predicted", "anisotropy_error"], numbers)
    report.remark("The anisotropy is the one that equilibrium demands of Z and S as they are. Whether these are right is another question: near the "
                  "transition S wanders for hundreds of mu D3/kT, and a start from perfect alignment comes to it from above.")
    if not_judged:
        report.remark(f"Not judged, for want of an error bar (fewer than 25 independent samples): {'; '.join(not_judged)}.")
    if not quick:
        report.table("Published: McGrother, Williamson and Jackson (1996).", ["phi", "Z", "S"],
                     [[f"{phi:.3f}", f"{Z:.2f}", f"{S:.3f}"] for phi, Z, S in reference_values.mcgrother()])
        compare_starts(report, points)
        compare_steps(report, runs_by_name)
    draw(report, points)


def order(run):
    """(S, standard error): the program's, or where it gives none because a run holds fewer than 25 independent samples, that of 8 blocks. Such an error is
    itself known to a quarter, so S is judged by three of them."""
    mean, error = run.value_if_any("nematic_order")
    return mean, error_of_blocks(run.series()["nematic_order"], 8) if math.isnan(error) else error


def compare_starts(report, points):
    """Hysteresis: what the two starts still differ by."""
    random = {phi: (Z, S) for phi, Z, S, *_ in points["random"]}
    rows = [[f"{phi:.2f}", with_error(Z[0] - random[phi][0][0], math.hypot(Z[1], random[phi][0][1]), sign="+"),
             f"{S[0] - random[phi][1][0]:+.3f}"] for phi, Z, S, *_ in points["aligned"] if phi in random]
    report.table("Aligned less random start: hysteresis.", ["phi", "Z", "S"], rows)


def compare_steps(report, runs_by_name):
    """Two nematics at two time steps."""
    rows = []
    for start, phi in LENGTHS_AT_LONG_STEP:
        reference = reference_values.monte_carlo_at(BETA, phi, start)
        name = f"{start}_phi{phi:.2f}"
        rows += [[f"{phi:.2f}", f"{run.scene['time']['rms_step']:g}", with_error(*run.value_if_any("Z")), with_error(*order(run)),
                  f"{run.summary['max_overlap']:.3f}"]
                 for run in (runs_by_name[name], runs_by_name[f"{name}_rms{LONG_STEP:g}"])]
        rows.append([f"{phi:.2f}", "Monte Carlo", with_error(reference.Z, reference.Z_error), with_error(reference.S, reference.S_error), ""])
    report.table("What the time step does to a nematic next to the transition, and deep in it: rms step and largest overlap in D.",
                 ["phi", "rms step", "Z", "S", "overlap"], rows)


def draw(report, points):
    figure, panels = figures.axes(1, 3, size=(10.5, 3.8))
    published = reference_values.mcgrother()
    panels[0].plot([phi for phi, *_ in published], [Z for _, Z, _ in published], "k+", label="McGrother et al. 1996")
    panels[1].plot([phi for phi, *_ in published], [S for *_, S in published], "k+")
    for start, colour in (("aligned", "C0"), ("random", "C1")):
        if start not in points:
            continue
        phi, Z, S, measured, predicted, error = zip(*points[start])
        for panel, values in ((panels[0], Z), (panels[1], S)):
            panel.errorbar(phi, [v for v, _ in values], [e if e == e else 0 for _, e in values], color=colour, marker="o",
                           markersize=4, linewidth=0.8, label=f"{start} start")
        panels[2].errorbar(phi, measured, error, color=colour, marker="o", markersize=4, linestyle="none")
        panels[2].plot(phi, predicted, color=colour, marker="_", markersize=12, linestyle="none")
    for start in ("isotropic", "aligned"):
        states = [state for state in reference_values.monte_carlo(BETA, start) if state.phi >= 0.3]
        style = {"color": "black", "marker": "s" if start == "aligned" else "D", "markersize": 8, "linestyle": "none",
                 "markerfacecolor": "none"}
        panels[0].plot([s.phi for s in states], [s.Z for s in states], **style, label=f"Monte Carlo, {start}")
        panels[1].plot([s.phi for s in states], [s.S for s in states], **style)
        panels[2].plot([s.phi for s in states], [reference_values.predicted_anisotropy(BETA, s.Z, s.S) for s in states],
                       **style)
    for panel, name in zip(panels, ("Z = P/(n kT)", "nematic order S", "sigma_max/sigma_min")):
        panel.set(xlabel="volume fraction", ylabel=name)
    panels[0].legend(fontsize=7)
    report.figure(figure, "Z, order and anisotropy of the collision stress; dashes, and squares of Monte Carlo, in the right panel: as "
                          "equilibrium demands from Z and S.")
