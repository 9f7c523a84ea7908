"""Runs as rows of a table: what each was asked for, how it ended, and every average with its error."""

import csv
import io
import json
import math
import re
import tomllib
from pathlib import Path

from refusal import Refusal

AXES = "xyz"
# Averages of summary.json that are one number, in the order in which people look for them.
SCALARS = ("Z", "pressure", "pressure_collision", "pressure_active", "pressure_springs", "nematic_order", "anisotropy",
           "anisotropy_collision")
TENSORS = ("stress", "stress_collision", "stress_orientation", "stress_springs", "stress_active",
           "stress_dipoles", "stress_thermal")  # 3 x 3
TRIPLES = ("principal_stresses", "principal_stresses_collision")  # ascending
AVERAGES = (*SCALARS, *(f"{name}_{k}" for name in TRIPLES for k in (1, 2, 3)),
            *(f"{name}_{a}{b}" for name in TENSORS for a in AXES for b in AXES))
FACTS = ("L_over_D", "volume_fraction", "area_fraction", "rods", "seed", "time_step", "steps", "time", "equilibration_time", "max_overlap")
DONE, EXTINCT, NOT_BEGUN = "done", "extinct", "not begun"


def columns_of_average(name):
    return (name, f"{name}_standard_error", f"{name}_n_eff")


def row_of(folder):
    """{column: number or text} of the folder of a run; the status tells how far it is."""
    record, summary = _json(folder / "run.json"), _json(folder / "summary.json")
    status = _status(record)
    row = {"status": status, "folder": str(folder)}
    if status != DONE or not summary:
        return row
    row.update({name: summary[name] for name in FACTS if name in summary})
    row["self_propulsion"] = summary.get("self_propulsion", {}).get("mean", "")
    row["box"] = " x ".join(f"{edge:g}" for edge in summary.get("box", {}).get("edges", []))
    row["equilibrium"] = summary.get("equilibrium", {}).get("verdict", "")
    row["warnings"] = "; ".join(warnings_of(summary))
    row["version"] = f"{record.get('version', '')} ({record.get('git', '')})"
    row["wall_seconds"] = round(sum(session.get("wall_seconds", 0.0) for session in record.get("sessions", [])), 1)
    for name, mean, error, samples, _ in averages_of(summary):
        row.update(zip(columns_of_average(name), (mean, error, samples)))
    return row


def averages_of(summary):
    """(name, mean, standard error or None, n_eff or None, unit) of every average that is a number."""
    for name in SCALARS:
        entry = summary.get(name, {"mean": None})
        if entry["mean"] is not None:
            yield name, entry["mean"], entry["standard_error"], entry["n_eff"], entry.get("unit", "")
    for name in TRIPLES:
        for k, (mean, error) in enumerate(zip(*_of_parts(summary.get(name)))):
            yield f"{name}_{k + 1}", mean, error, None, summary[name]["unit"]
    for name in TENSORS:
        for a, rows in zip(AXES, zip(*_of_parts(summary.get(name)))):
            for b, mean, error in zip(AXES, *rows):
                yield f"{name}_{a}{b}", mean, error, None, summary[name]["unit"]


def units_of(folders):
    """{average: unit}, as summary.json writes it."""
    return {name: unit for folder in folders for name, *_, unit in averages_of(_json(folder / "summary.json")) if unit}


def warnings_of(summary):
    """What the run warns of."""
    equilibrium = summary.get("equilibrium", {})
    if equilibrium.get("verdict") in ("not reached", "too short to tell"):
        yield f"equilibrium: {equilibrium.get('in_words', equilibrium['verdict'])}"
    for name, check in summary.get("checks", {}).items():
        if check.get("agree") is False:
            yield f"{name.replace('_', ' ')} differs from that of equilibrium"


def number(row, column):
    """A cell as a number; nan if it holds none."""
    value = row.get(column)
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else math.nan


def columns(rows, first):
    """All columns that some row has: `first`, then facts, averages and the rest in the order above."""
    order = [*first, "status", *FACTS, "self_propulsion", "box", *(part for name in AVERAGES for part in columns_of_average(name)),
             "equilibrium", "warnings", "version", "wall_seconds", "folder"]
    there = {name for row in rows for name, value in row.items() if value is not None}
    return [name for name in dict.fromkeys(order) if name in there]


def csv_text(rows, names):
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(names)
    writer.writerows([_cell(row.get(name)) for name in names] for row in rows)
    return file.getvalue()


def run_folders(given):
    """The folders of runs among those that are given, and right in them. Raises Refusal where there is none."""
    found = []
    for folder in map(Path, given):
        if not folder.is_dir():
            raise Refusal(folder, "there is no such folder", "Give folders of runs, or folders that hold some")
        inside = [folder] if _is_run(folder) else sorted((path for path in folder.iterdir() if _is_run(path)), key=_natural)
        if not inside:
            raise Refusal(folder, "there is no run in it", "Give folders of runs, or folders that hold some")
        found += [path for path in inside if path not in found]
    return found


def differing_keys(folders):
    """Keys of the scenes that are not the same in all runs, but for times that only tell when to end."""
    scenes = [flat(scene_of(folder)) for folder in folders]
    keys = dict.fromkeys(key for scene in scenes for key in scene)
    return [key for key in keys if key not in ("title", "seed") and any(scene.get(key) != scenes[0].get(key) for scene in scenes)], scenes


def scene_of(folder):
    try:
        return tomllib.loads((folder / "resolved.toml").read_text())
    except (OSError, ValueError):
        return {}


def flat(table, above=""):
    """{"table.key": value}."""
    made = {}
    for key, value in table.items():
        made.update(flat(value, f"{above}{key}.") if isinstance(value, dict) else {above + key: value})
    return made


def _status(record):
    reason = record.get("exit_reason", "")
    if not reason:
        return NOT_BEGUN
    if reason in (DONE, EXTINCT):
        return reason
    unfinished = reason in ("running", "walltime") or reason.startswith("signal ")
    return f"stopped ({reason})" if unfinished else f"failed ({reason})"


def _is_run(folder):
    return folder.is_dir() and any((folder / name).exists() for name in ("run.json", "checkpoint"))


def _natural(path):
    """Numbers in names by their size: phi=0.05 before phi=0.1, and point-2 before point-10."""
    return [(0, float(part), "") if part.replace(".", "", 1).isdigit() else (1, 0.0, part)
            for part in re.split(r"(\d+\.?\d*)", path.name) if part]


def _of_parts(entry):
    return (entry["mean"], entry["standard_error"]) if entry else ((), ())


def _cell(value):
    if value is None or (isinstance(value, float) and not math.isfinite(value)):
        return ""
    return json.dumps(value) if isinstance(value, (bool, list)) else value


def _json(path):
    try:
        content = json.loads(path.read_text())
    except (OSError, ValueError):
        return {}
    return content if isinstance(content, dict) else {}
