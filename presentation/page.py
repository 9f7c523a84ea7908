"""One HTML page with everything in it: the view of the rods, the averages, the plots, and how the run was made."""

import base64
import html
import math

from run_folder import readable_unit, superscript

MARK = '<meta name="generator" content="jostle report">'
NAME = "report.html"
AVERAGES = {"Z": "compressibility factor Z", "pressure": "pressure", "pressure_collision": "collision pressure",
            "pressure_springs": "pressure of springs", "pressure_active": "active pressure",
            "nematic_order": "nematic order S", "anisotropy": "stress anisotropy",
            "anisotropy_collision": "anisotropy of the collision stress"}
CHECKS = {"total_stress_ratio": "stress along/across the director", "collision_stress_ratio": "collision stress along/across the director"}
STYLE = """
body { font: 16px/1.5 sans-serif; color: #222; max-width: 76rem; margin: 2rem auto; padding: 0 1.2rem; }
h1 { font-size: 1.7rem; margin-bottom: .2rem; } h2 { font-size: 1.2rem; margin-top: 2.2rem; }
.subtitle { color: #555; margin-top: 0; } img { max-width: 100%; height: auto; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(26rem, 1fr)); gap: 1rem; }
table { border-collapse: collapse; }
th, td { text-align: left; padding: .25rem 1.2rem .25rem 0; border-bottom: 1px solid #ddd; }
td.number { text-align: right; font-variant-numeric: tabular-nums; } th.number { text-align: right; }
.tables { display: flex; flex-wrap: wrap; gap: 1rem 4rem; align-items: flex-start; }
.warning { border-left: 5px solid #d55e00; background: #fdf1e7; padding: .5rem 1rem; }
.note { color: #555; } pre { background: #f5f5f5; padding: .8rem; overflow-x: auto; font-size: .85rem; }
@media print { .plots { grid-template-columns: 1fr 1fr; } }
"""


def text(run, folder, pictures, view, notes):
    """pictures: (file name, title); view: (file name, caption) or None; notes: what the page could not show."""
    parts = [f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{MARK}\n'
             f"<title>{html.escape(run.title)}</title><style>{STYLE}</style></head><body>\n",
             f"<h1>{html.escape(run.title)}</h1>\n<p class=\"subtitle\">{html.escape(subtitle(run))}</p>\n"]
    parts += [f'<p class="warning">{html.escape(warning)}</p>\n' for warning in warnings(run)]
    if view:
        caption = f'<span class="note">{html.escape(view[1])}</span>'
        parts.append(f"<p>{embedded(folder / view[0], view[1])}<br>{caption}</p>\n")
    parts += [f'<p class="note">{html.escape(note)}</p>\n' for note in notes]
    if run.summary:
        parts += ['<h2>Averages</h2>\n<div class="tables">', table(AVERAGE_HEADS, average_rows(run)),
                  table(("Stress", "", "", ""), stress_rows(run, "stress")),
                  table(("Collision stress", "", "", ""), stress_rows(run, "stress_collision")), "</div>\n", reasons(run)]
        parts += checks(run)
    parts += ["<h2>Over time</h2>\n<div class=\"plots\">\n"]
    parts += [f"<div>{embedded(folder / name, title)}</div>\n" for name, title in pictures]
    parts += ["</div>\n<h2>The run</h2>\n", table(("", ""), facts(run)),
              f"<details><summary>The scene with every default</summary>"
              f"<pre>{html.escape((run.folder / 'resolved.toml').read_text())}</pre></details>\n</body></html>\n"]
    return "".join(parts)


def subtitle(run):
    last = {name: values[-1] for name, values in run.series.items()}
    time = " ".join(part for part in (f"{last['time']:.4g}", run.unit("time")) if part)
    return f"{last['N']:.0f} rods at volume fraction {last['phi']:.4g}, time {time}, {last['step']:.0f} steps"


def warnings(run):
    if run.record.get("exit_reason") == "extinct":
        return ["All cells have died: there are no averages."]
    if not run.summary:
        return ["The run is not done: there are no averages yet."]
    if run.summary.get("equilibrated") is False:
        return ["Equilibrium was not reached: use none of the averages."]
    return []


AVERAGE_HEADS = ("Quantity", "mean", "standard error", "independent samples", "unit")


def average_rows(run):
    for name, words in AVERAGES.items():
        average = run.summary.get(name)
        if average and average["mean"] is not None:
            error = average.get("standard_error")
            n_eff = average.get("n_eff")
            yield (words, number(average["mean"], error), "–" if error is None else f"{error:.2g}",
                   "–" if n_eff is None else f"{n_eff:.0f}", readable_unit(average.get("unit", "1")))
    yield ("volume fraction in the end", f"{run.summary['volume_fraction']:.5g}", "", "", "")
    yield ("largest overlap of the run", f"{run.summary['max_overlap']:.2e}", "", "", "D")


def stress_rows(run, name):
    stress = run.summary.get(name)
    if not stress:
        return
    largest = max(abs(mean) for row in stress["mean"] for mean in row)
    power = math.floor(math.log10(largest)) if largest > 0.0 else 0
    power = 0 if -2 <= power <= 3 else power
    scale = 10.0**power
    for row, axis in enumerate("xyz"):
        yield (f"{axis}x, {axis}y, {axis}z", *(
            number(mean / scale, error and error / scale) + ("" if error is None else f" ± {error / scale:.1g}")
            for mean, error in zip(stress["mean"][row], stress["standard_error"][row])))
    yield ("unit", (f"10{superscript(power)} " if power else "") + readable_unit(stress.get("unit", "1")), "", "")


def checks(run):
    """What is measured beside what equilibrium has, where a run is in equilibrium."""
    rows = [check_row(words, run.summary["checks"][name]) for name, words in CHECKS.items() if name in run.summary.get("checks", {})]
    return ["<h2>Checks</h2>\n", table(("Ratio", "measured", "standard error", "in equilibrium", ""), rows)] if rows else []


def check_row(words, check):
    measured, error = check["measured"]["mean"], check["measured"]["standard_error"]
    least, most = (check["in_equilibrium"][end] for end in ("from", "to"))
    expected = "–" if least is None or most is None else " to ".join(dict.fromkeys(f"{end:.5g}" for end in (least, most)))
    verdict = {True: "agrees", False: "disagrees", None: "no error bar"}[check["agree"]]
    return (words, "–" if measured is None else number(measured, error), "–" if error is None else f"{error:.2g}", expected, verdict)


def reasons(run):
    """Why some averages have no error bar."""
    missing = [f"{words}: {run.summary[name]['no_standard_error_because']}" for name, words in AVERAGES.items()
               if run.summary.get(name, {}).get("no_standard_error_because")]
    if not missing:
        return ""
    return f'<p class="note">No error bar. {html.escape(" ".join(missing))}</p>\n'


def facts(run):
    record = run.record
    sessions = record.get("sessions", [])
    yield ("program", f"{record.get('program', '')} {record.get('version', '')} {record.get('git', '')}".strip())
    yield ("compiler", record.get("compiler", ""))
    yield ("seed", str(record.get("seed", "")))
    yield ("time step", " ".join((f"{record.get('time_step', 0.0):.4g}", run.unit("time"))))
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
    return "<table>" + "".join(f"<tr>{line}</tr>\n" for line in lines) + "</table>\n"


def embedded(path, title):
    content = base64.b64encode(path.read_bytes()).decode()
    return f'<img alt="{html.escape(title)}" src="data:image/png;base64,{content}">'
