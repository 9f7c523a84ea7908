"""One HTML page with everything in it: verdict, numbers, rods that turn, plots, and how the run was made.

It can be read as it is; the programs inside it replace pictures by what moves, where the browser can.
"""

import base64
import html
import math

import viewer_parts
from units import superscript, with_unit
from verdict import expected_range, verdict

MARK = '<meta name="generator" content="jostle report">'
NAME = "report.html"
# Nothing is fetched, from nowhere.
POLICY = ("default-src 'none'; script-src 'unsafe-inline' data:; style-src 'unsafe-inline'; img-src data: blob:; "
          "connect-src 'none'")
AVERAGES = {"Z": "compressibility factor Z", "pressure": "pressure", "pressure_collision": "collision pressure",
            "pressure_springs": "pressure of springs", "pressure_active": "active pressure",
            "nematic_order": "nematic order S", "anisotropy": "stress anisotropy",
            "anisotropy_collision": "anisotropy of the collision stress",
            "wall_pressure": "wall pressure", "wall_pressure_x": "wall pressure x", "wall_pressure_y": "wall pressure y",
            "wall_pressure_z": "wall pressure z",
            "viscosity_at_rest": "viscosity at rest, of Brownian motion and collisions"}
# Of a table of the summary, in the same form.
FLOW = {"viscosity": "viscosity, of Brownian motion and collisions", "viscosity_of_turning": "viscosity of turning",
        "N1": "first normal stress difference N1", "N2": "second normal stress difference N2",
        "storage_modulus": "storage modulus G′, of Brownian motion and collisions",
        "loss_modulus": "loss modulus G″, of Brownian motion and collisions"}
BATH = {"volume_fraction": "mean volume fraction", "Z": "Z = P V/(N kT)", "volume": "volume of the box"}
CHECKS = {"total_stress_ratio": "stress along/across the director", "collision_stress_ratio": "collision stress along/across the director"}
WALLS = "wall_pressure"       # begins the names of pressures on walls; between walls a third of the trace of a stress is no pressure
THIRDS_OF_TRACE = ("pressure", "pressure_collision")
KEY_AVERAGES = {"Z": "Z", "pressure": "pressure", "wall_pressure": "wall pressure", "wall_pressure_x": "wall pressure x",
                "wall_pressure_y": "wall pressure y", "wall_pressure_z": "wall pressure z", "pressure_active": "active pressure", "nematic_order": "nematic order S"}
SIGNS = {"good": "✓", "bad": "!", "open": "·"}


def text(run, folder, curves, view, rods, tiles, notes):
    """curves: of the plots; view: (file name, caption) of the still or None; rods: of the page, or None; tiles: numbers that
    come first, (words, number, unit, note); notes: what the page could not show."""
    plotting = viewer_parts.plotting()
    title = html.escape(run.title)
    parts = [f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{MARK}\n'
             '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
             f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">\n'
             f"<title>{title}</title>\n<style>{viewer_parts.style()}</style>\n{plotting or ''}</head>\n<body>\n"
             f'<header><h1>{title}</h1><p class="subtitle">{html.escape(subtitle(run))}</p></header>\n',
             f'<main>\n<div class="first">\n{figure(folder, view, rods)}<aside>\n{verdict_list(run)}{tile_list(tiles)}'
             f"</aside>\n</div>\n{notes_list(notes)}",
             plots(folder, curves), averages(run), the_run(run), "</main>\n"]
    told = {"time": dict(zip(("label", "unit"), ("time", run.in_unit("time")[1]))), "curves": [told_curve(c) for c in curves]}
    if rods:
        told.update(rods.told)
        parts.append(viewer_parts.packed(rods.elements))
    parts += [viewer_parts.described(told), viewer_parts.modules(), "</body></html>\n"]
    return "".join(parts)


def subtitle(run):
    last = {name: values[-1] for name, values in run.series.items()}
    factor, unit = run.in_unit("time")
    time = " ".join(part for part in (f"{factor * last['time']:.4g}", unit) if part)
    if run.is_colony:
        return f"{last['N']:.0f} cells from {run.series['N'][0]:.0f}, time {time}, {last['step']:.0f} steps"
    kind = "cells" if run.grows else "rods" if run.scene["rods"].get("length", 1.0) != 0 else "spheres"
    return f"{last['N']:.0f} {kind} at {run.fraction} {last['phi']:.4g}, time {time}, {last['step']:.0f} steps"


def verdict_list(run):
    lines = "".join(f'<li class="{state}"><i>{SIGNS[state]}</i><div><b>{html.escape(words)}</b> '
                    f"<span>{html.escape(more)}</span></div></li>\n" for state, words, more in verdict(run))
    return f'<ul class="verdict">\n{lines}</ul>\n'


def tile_list(tiles):
    made = "".join(f'<div class="tile"><dt>{html.escape(words)}</dt><dd>{html.escape(number)} '
                   f"<small>{html.escape(unit)}</small></dd>{'<p>' + html.escape(note) + '</p>' if note else ''}</div>\n"
                   for words, number, unit, note in tiles)
    return f'<dl class="tiles">\n{made}</dl>\n' if made else ""


def average_tiles(run):
    """The most important averages, with their errors."""
    for words, average in averages_of(run.summary, KEY_AVERAGES):
        if average["mean"] is not None:
            factor, unit = run.readable(average.get("unit", "1"))
            mean, error = factor * average["mean"], average.get("standard_error")
            note = "no error bar" if error is None else f"{average['n_eff']:.0f} independent samples"
            yield (words, number(mean, error and factor * error) + ("" if error is None else f" ± {factor * error:.2g}"), unit, note)


def notes_list(notes):
    return "".join(f'<p class="note">{html.escape(note)}</p>\n' for note in notes)


def figure(folder, view, rods):
    """The still, which the rods that turn replace."""
    if not view and not rods:
        return ""
    still = embedded(folder / view[0], view[1]) if view else \
        '<p class="no-still">The rods turn in a browser that has WebGL 2 and runs the programs of this page.</p>'
    caption = f'<figcaption class="still-caption">{html.escape(view[1])}</figcaption>' if view else ""
    return f'<figure id="view"><div class="stage">{still}</div>{caption}</figure>\n'


def plots(folder, curves):
    def cell(curve):
        note = f'<p class="curve-note">{html.escape(curve.note)}</p>' if curve.note else ""
        return (f'<section class="plot" data-curve="{curve.name}"><h3>{html.escape(curve.title)}</h3>'
                f'{embedded(folder / (curve.name + ".png"), curve.title)}{note}</section>\n')

    first = "".join(cell(curve) for curve in curves if not curve.aside)
    aside = "".join(cell(curve) for curve in curves if curve.aside)
    parts = [f'<h2>Over time</h2>\n<div class="plots">\n{first}</div>\n' if first else ""]
    if aside:
        parts.append(f'<details class="aside"><summary>How the steps went</summary><div class="plots">\n{aside}</div></details>\n')
    return "".join(parts)


def told_curve(curve):
    """A curve as the programs of the page take it, in at most as many parts as a screen has columns."""
    from plots import limits, of_parts

    time, low, middle, high = of_parts(curve, most=1500)
    ranged = low is not None
    rows = [[_number(t), [_number(a), _number(b), _number(c)] if ranged else _number(b)]
            for t, a, b, c in zip(time, low if ranged else middle, middle, high if ranged else middle)]
    told = {"name": curve.name, "title": curve.title, "label": with_unit(curve.label, curve.unit), "unit": curve.unit,
            "rows": rows, "ranged": ranged, "logarithmic": curve.logarithmic, "from_zero": curve.from_zero,
            "whole": curve.whole}
    if curve.average and not curve.logarithmic:
        told["range"] = [_number(end) for end in limits(curve, room=0.1)]
    if curve.average:
        told.update(mean=curve.average["mean"], error=curve.average.get("standard_error"),
                    window=[float(curve.time[row]) for row in curve.window])
    return told


def _number(value):
    return float(f"{value:.6g}") if math.isfinite(value) else None


STRESSES = {"Stress": "", "Orientation stress": "_orientation", "Collision stress": "_collision"}
AVERAGE_HEADS = ("Quantity", "mean", "standard error", "independent samples", "unit")


def averages(run):
    if not run.summary or run.is_colony:
        return ""
    return "".join(['<h2>Averages</h2>\n<div class="tables">', table(AVERAGE_HEADS, average_rows(run)),
                    *(table((words, "", "", ""), stress_rows(run, f"stress{part}", f"principal_stresses{part}"))
                      for words, part in STRESSES.items() if f"stress{part}" in run.summary), "</div>\n", reasons(run),
                    checks(run)])


def all_averages(run):
    """(words, average) of all that the summary has."""
    yield from averages_of(run.summary, AVERAGES)
    yield from averages_of(run.summary.get("flow", {}), FLOW)
    yield from averages_of(run.summary.get("pressure_control", {}), BATH)


def averages_of(table, names):
    walled = any(name.startswith(WALLS) for name in table)
    for name, words in names.items():
        if name in table and not (walled and name in THIRDS_OF_TRACE):
            yield words, table[name]


def average_rows(run):
    for words, average in all_averages(run):
        if average["mean"] is not None:
            error = average.get("standard_error")
            n_eff = average.get("n_eff")
            factor, unit = run.readable(average.get("unit", "1"))
            yield (words, number(factor * average["mean"], error and factor * error),
                   "–" if error is None else f"{factor * error:.2g}", "–" if n_eff is None else f"{n_eff:.0f}", unit)
    filled = "area" if "area_fraction" in run.summary else "volume"
    yield (f"{filled} fraction in the end", f"{run.summary[filled + '_fraction']:.5g}", "", "", "")
    yield ("largest overlap of the run", f"{run.summary['max_overlap']:.2e}", "", "", "D")


def stress_rows(run, name, principal_name):
    """The tensor, and its principal values where the summary has them."""
    stress, principal = run.summary[name], run.summary.get(principal_name)
    factor, unit = run.readable(stress.get("unit", "1"))
    largest = max(abs(factor * mean) for row in stress["mean"] for mean in row)
    power = math.floor(math.log10(largest)) if largest > 0.0 else 0
    power = 0 if -2 <= power <= 3 else power
    scale = 10.0**power / factor

    def cells(means, errors):
        return [number(mean / scale, error and error / scale) + ("" if error is None else f" ± {error / scale:.1g}") for mean, error in zip(means, errors)]

    for row, axis in enumerate("xyz"):
        yield (f"{axis}x, {axis}y, {axis}z", *cells(stress["mean"][row], stress["standard_error"][row]))
    if principal:
        values = cells(principal["mean"], principal["standard_error"])
        yield ("principal", *values, *[""] * (3 - len(values)))
    yield ("unit", (f"10{superscript(power)} " if power else "") + unit, "", "")


def checks(run):
    """What is measured beside the value in equilibrium, where a run is in equilibrium."""
    rows = [check_row(words, run.summary["checks"][name]) for name, words in CHECKS.items() if name in run.summary.get("checks", {})]
    return "<h2>Checks</h2>\n" + table(("Ratio", "measured", "standard error", "in equilibrium", ""), rows) if rows else ""


def check_row(words, check):
    measured, error = check["measured"]["mean"], check["measured"]["standard_error"]
    verdict = {True: "agrees", False: "disagrees", None: "no error bar"}[check["agree"]]
    return (words, "–" if measured is None else number(measured, error), "–" if error is None else f"{error:.2g}",
            expected_range(check), verdict)


def reasons(run):
    """Why some averages have no error bar."""
    missing = {}
    for words, average in all_averages(run):
        reason = average.get("no_standard_error_because")
        if reason:
            missing.setdefault(reason, []).append(words)
    return "".join(f'<p class="note">No error bar of {html.escape(", ".join(words))}: {html.escape(reason)}</p>\n'
                   for reason, words in missing.items())


def the_run(run):
    scene = (run.folder / "resolved.toml").read_text()
    return ('<h2>The run</h2>\n<div class="tables">' + table(("", ""), facts(run)) + "</div>\n"
            f"<details><summary>The scene with every default</summary><pre>{html.escape(scene)}</pre></details>\n")


def facts(run):
    record = run.record
    sessions = record.get("sessions", [])
    factor, unit = run.in_unit("time")
    yield ("program", f"{record.get('program', '')} {record.get('version', '')} {record.get('git', '')}".strip())
    yield ("compiler", record.get("compiler", ""))
    yield ("seed", str(record.get("seed", "")))
    yield ("time step", " ".join((f"{factor * record.get('time_step', 0.0):.4g}", unit)))
    if (record.get("start") or {}).get("in_words"):
        yield ("start", record["start"]["in_words"])
    if sessions:
        yield ("processor", sessions[-1].get("processor", ""))
        yield ("threads", str(sessions[-1].get("threads", "")))
        yield ("wall time", f"{sum(one.get('wall_seconds') or 0.0 for one in sessions):.0f} s")
    yield ("ended", record.get("exit_reason") or "goes on, or was ended from outside")


def number(value, error):
    """With as many digits as the error leaves, five where there is none."""
    if not error:
        return f"{value:.5g}"
    first = int(f"{error:.0e}".split("e")[1])  # power of ten of its first digit
    return f"{value:.{max(0, 1 - first)}f}" if first > -7 else f"{value:.5g}"


def table(heads, rows):
    columns = ["" if k == 0 else ' class="number"' for k in range(len(heads))]
    lines = []
    if any(heads):
        lines.append("".join(f"<th{kind}>{html.escape(head)}</th>" for kind, head in zip(columns, heads)))
    else:
        columns = [""] * len(heads)
    for row in rows:
        lines.append("".join(f"<td{kind}>{html.escape(cell)}</td>" for kind, cell in zip(columns, row)))
    return '<div class="wide"><table>' + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</table></div>\n"


def embedded(path, title):
    content = base64.b64encode(path.read_bytes()).decode()
    return f'<img alt="{html.escape(title)}" src="data:image/png;base64,{content}">'
