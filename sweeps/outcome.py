"""What runs leave together: the table, means over replicas, curves, and a few lines for the terminal."""

import math

from refusal import Refusal
from replicas import LEAST_PROBABILITY, Mean, mean_of, probability_of
from runs_table import AVERAGES, DONE, columns, csv_text, number

DRAWABLE = (*AVERAGES, "max_overlap")
PARTS_OF_MEAN = {"": "value", "_standard_error": "error", "_error_within": "within", "_error_scatter": "scatter",
                 "_chi_squared": "chi_squared", "_degrees": "degrees", "_probability": "probability"}


def require(plots, against, keys):
    """Refuses pictures that no table of runs with these keys has."""
    for name in plots:
        if name not in DRAWABLE:
            raise Refusal(f"--plot {name}", "is no average of a run", f"Choose among {', '.join(DRAWABLE[:8])} ...")
    if against and not full_keys(against, keys):
        raise Refusal(f"--against {against}", "is no key of these runs", f"Choose among {', '.join(keys)}" if keys else "")


def full_keys(name, keys):
    """The keys of this name; "volume_fraction" stands for "box.volume_fraction"."""
    return [key for key in keys if name in (key, key.rpartition(".")[2])]


def leave(rows, keys, plots, against, units, folder):
    """Writes sweep.csv, replicas.csv where seeds differ, and the curves into the folder. Result: lines to print."""
    from durable import write

    write(folder / "sweep.csv", csv_text(rows, columns(rows, keys)))
    states = states_of(rows, keys)
    repeated = any(len(runs) > 1 for _, runs in states)
    if repeated:
        write(folder / "replicas.csv", replica_table(states, keys))
    draw(states, keys, plots, against, units, folder)
    return "\n".join(lines(states, keys, repeated, units))


def states_of(rows, keys):
    """[({key: value}, rows)]: rows that differ in nothing but their seed."""
    states = {}
    for row in rows:
        values = {key: row[key] for key in keys if key != "seed"}
        states.setdefault(str(values), (values, []))[1].append(row)
    return list(states.values())


def mean_of_runs(runs, name):
    """Over runs that are done, of one average; None if none has it."""
    found = [(number(run, name), number(run, f"{name}_standard_error")) for run in runs if run["status"] == DONE]
    found = [(mean, error) for mean, error in found if not math.isnan(mean)]
    return mean_of(*zip(*found)) if found else None


def replica_table(states, keys):
    rows = []
    for values, runs in states:
        row = {**values, "replicas": sum(run["status"] == DONE for run in runs)}
        for name in AVERAGES:
            mean = mean_of_runs(runs, name)
            if mean:
                row.update({name + ending: getattr(mean, part) for ending, part in PARTS_OF_MEAN.items()})
                row[f"{name}_agree"] = mean.agree
        rows.append(row)
    names = [*(key for key in keys if key != "seed"), "replicas",
             *(name + ending for name in AVERAGES for ending in (*PARTS_OF_MEAN, "_agree") if any(name in row for row in rows))]
    return csv_text(rows, names)


def draw(states, keys, plots, against, units, folder):
    if not plots:
        return
    import curve_figure

    varied = [key for key in keys if key != "seed" and len({str(values[key]) for values, _ in states}) > 1]
    axis = (full_keys(against, keys) or varied or [key for key in keys if key != "seed"] or ["seed"])[0]
    for name in plots:
        points = []
        for values, runs in states:
            mean = mean_of_runs(runs, name)
            points.append(({**values, "seed": runs[0].get("seed", "")}, mean.value, mean.error) if mean else (values, math.nan, math.nan))
        curve_figure.draw(points, name, axis, [key for key in varied if key != axis], units.get(name, ""), folder / name)


def shown_average(states):
    """What the terminal shows: Z, or the collision pressure where there is none."""
    return next((name for name in ("Z", "pressure_collision") if any(name in run for _, runs in states for run in runs)), "Z")


def lines(states, keys, repeated, units):
    name = shown_average(states)
    keys = [key for key in keys if key != "seed"]
    header = [*(key.rpartition(".")[2] for key in keys), " ".join(part for part in (name, units.get(name, "")) if part)]
    table = [[*header, "runs", "chi squared"] if repeated else header]
    remarks, total, degrees = [], 0.0, 0
    for values, runs in states:
        mean = mean_of_runs(runs, name)
        row = [*(str(values[key]) for key in keys), text_of(mean) if mean else ""]
        if mean and mean.agree is None and not math.isnan(mean.scatter):
            row[-1] += " (of the scatter)"
        if repeated:
            row.append(str(sum(run["status"] == DONE for run in runs)))
            row.append(f"{mean.chi_squared:.3g} of {mean.degrees}" if mean and mean.degrees else "")
        table.append(row)
        if mean and mean.degrees:
            total, degrees = total + mean.chi_squared, degrees + mean.degrees
        remarks += [f"{run['folder']}: {run['status']}" for run in runs if run["status"] != DONE]
        remarks += [f"{run['folder']}: WARNING: {run['warnings']}" for run in runs if run.get("warnings")]
    widths = [max(len(row[column]) for row in table) for column in range(len(table[0]))]
    yield from ("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in table)
    if degrees:
        yield verdict(name, total, degrees)
    yield from remarks


def text_of(mean: Mean):
    """Mean and error, as `jostle run` prints them."""
    return f"{mean.value:.5g}" + ("" if math.isnan(mean.error) else f" +- {mean.error:.2g}")


def verdict(name, chi_squared, degrees):
    probability = probability_of(chi_squared, degrees)
    told = f"chi squared of {name} {chi_squared:.3g} of {degrees} degrees of freedom, probability {probability:.2g}"
    if probability >= LEAST_PROBABILITY:
        return f"replicas agree within their errors ({told})"
    return f"WARNING: replicas differ by more than their errors ({told}): errors are those of the scatter"
