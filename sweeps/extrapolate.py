"""jostle extrapolate: averages at time step 0, from runs at several steps and the known order of the error.

    extrapolate.py --jostle=PROGRAM --out=DIR --rms-steps=X1,X2 --replicas=R --processes=P [--set=KEY=V1,V2 ...] -- SCENE

With the time-step correction the error of an average is of order 1 in the time step, that is in proportion to the square of the rms step x
(docs/theory, section 3): a + b x^2. Without it, it is of order 1/2, and its next term of order 1: a + b x + c x^2. Called by the command, which
has read the command line. Empty values stand for what was not given.
"""

import argparse
import math
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "presentation"))

import durable  # noqa: E402  (the path comes first)
import refusal  # noqa: E402
import sweep  # noqa: E402
from refusal import Refusal  # noqa: E402

STEP = "time.rms_step"
DEFAULT_STEPS = "0.06,0.042,0.03"
LEAST_PROBABILITY = 0.01  # of a chi squared as large as found, below which the model fails


def arguments():
    parser = argparse.ArgumentParser()
    for name in ("jostle", "out", "replicas", "processes", "rms-steps"):
        parser.add_argument(f"--{name}", default="")
    parser.add_argument("--set", action="append", default=[])
    parser.add_argument("scene")
    options = parser.parse_args()
    options.zip = False
    return options


def steps_of(text):
    """The steps as they are typed, largest first."""
    from points import parsed, split

    steps = split(text or DEFAULT_STEPS)
    numbers = [parsed(step) for step in steps]
    if not all(isinstance(number, (int, float)) and not isinstance(number, bool) and number > 0 for number in numbers):
        raise Refusal(f"--rms-steps = {text}", "are not all numbers above 0", "Write --rms-steps 0.06,0.03")
    if len(set(numbers)) < 2 or len(set(numbers)) < len(numbers):
        raise Refusal(f"--rms-steps = {text}", "are not at least two different steps", "Write --rms-steps 0.06,0.03")
    return [step for _, step in sorted(zip(numbers, steps), reverse=True)]


def powers_of(scene):
    """Powers of the rms step in the error of a scene. Raises Refusal where the order is not known."""
    thermal = scene["motion"]["brownian"] and scene["fluid"]["kT"] > 0
    if not thermal:
        raise Refusal(STEP, "is the step of Brownian motion, and nothing is known of the order of the error without it",
                      "Compare runs at several time.step, by `jostle sweep`")
    if scene.get("growth", {}).get("rate", 0) > 0:
        raise Refusal("growth.rate", "while cells multiply there are no averages to extrapolate", "Compare runs at several time.step, by `jostle sweep`")
    contact = scene["contact"]
    return (2,) if contact["model"] != "hard" or contact["brownian_correction"] else (1, 2)


def model_of(powers):
    return "a" + "".join(f" + {letter} x" + ("^2" if power == 2 else "") for letter, power in zip("bc", powers))


def extrapolated(rows, name, powers):
    """What is known of an average at step 0, as columns of a table; {} where no run has it."""
    from runs_table import DONE, number
    from weighted_fit import WeightedFit

    measured = [(row[STEP], number(row, name), number(row, f"{name}_standard_error")) for row in rows if row["status"] == DONE]
    if not any(not math.isnan(mean) for _, mean, _ in measured):
        return {}
    told = {"average": name, "runs": len(measured)}
    if len(measured) < len(rows):
        return {**told, "verdict": "not extrapolated: runs are missing"}
    if not all(error > 0.0 for *_, error in measured):
        return {**told, "verdict": "not extrapolated: a run has no error bar"}
    x, means, errors = zip(*measured)
    fit = WeightedFit(means, errors, [[at**power for at in x] for power in (0, *powers)])
    told.update(mean=fit.value[0], standard_error=fit.error[0], chi_squared=fit.chi_squared, degrees=fit.degrees, probability=fit.probability)
    told.update({f"coefficient_x{power}": value for power, value in zip(powers, fit.value[1:])})
    if fit.degrees == 0:
        return {**told, "verdict": "not tested: there are as many steps as unknowns"}
    if fit.probability < LEAST_PROBABILITY:
        return {**told, "standard_error": None, "verdict": "the model fails: smaller steps are needed"}
    return {**told, "verdict": "the model holds"}


def states_of(rows, keys):
    """[({key: value}, rows)]: rows that differ in nothing but step and seed."""
    states = {}
    for row in rows:
        values = {key: row[key] for key in keys if key not in (STEP, "seed")}
        states.setdefault(str(values), (values, []))[1].append(row)
    return list(states.values())


def text_of(found, rows, powers):
    """The lines for the terminal: what was measured at each step, and what follows."""
    from outcome import text_of as with_error
    from outcome import mean_of_runs

    steps = list(dict.fromkeys(row[STEP] for row in rows))
    table = [["rms step", *(f"{step:g}" for step in steps), "0", "chi squared"]]
    for told in found:
        at_steps = [mean_of_runs([row for row in rows if row[STEP] == step], told["average"]) for step in steps]
        result = told["verdict"]
        if "mean" in told:
            error = told["standard_error"]
            result = f"{told['mean']:.5g}" + ("" if error is None else f" +- {error:.2g}")
        chi_squared = f"{told['chi_squared']:.3g} of {told['degrees']}" if told.get("degrees") else ""
        warning = f"  WARNING: {told['verdict']}" if told.get("mean") is not None and told["standard_error"] is None else ""
        table.append([told["average"], *(with_error(mean) if mean else "" for mean in at_steps), result, chi_squared + warning])
    widths = [max(len(row[column]) for row in table) for column in range(len(table[0]))]
    yield from ("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in table)
    yield f"model: {model_of(powers)}, x the rms step" + ("" if any(told.get("degrees") for told in found) else
                                                          "; not tested: that takes more steps than unknowns")


def extrapolate():
    options = arguments()
    refusal.require_modules(sweep.NEEDED)
    from runs_table import AVERAGES, SCALARS, columns, csv_text

    for text in options.set:
        if text.partition("=")[0].strip() in (STEP, "time.step"):
            raise Refusal(f"--set {text}", "says what the step is, and --rms-steps does", "Leave it out")
    asked = sweep.Sweep(options, ".extrapolate", steps_of(options.rms_steps))
    jobs = asked.jobs()
    powers = [powers_of(tomllib.loads(job.told.resolved)) for job in jobs]
    if len(steps_of(options.rms_steps)) <= max(map(len, powers)):
        raise Refusal("--rms-steps", f"the model has {max(map(len, powers)) + 1} unknowns: {model_of(max(powers, key=len))}", "Give as many steps at least")
    with asked.opened():
        stopped = sweep.run_jobs(asked, jobs)
        rows = sweep.rows_of(asked, jobs)
        durable.write(asked.folder / "sweep.csv", csv_text(rows, columns(rows, asked.keys)))
        table, powers_of_row = [], dict(zip((row["folder"] for row in rows), powers))
        for values, of_state in states_of(rows, asked.keys):
            of_powers = powers_of_row[of_state[0]["folder"]]
            found = [told for name in AVERAGES if (told := extrapolated(of_state, name, of_powers))]
            table += [{**values, **told} for told in found]
            print(*(f"{key} = {value}" for key, value in values.items()), sep=", ", end="\n" if values else "")
            print(*text_of([told for told in found if told["average"] in SCALARS], of_state, of_powers), sep="\n")
        names = dict.fromkeys(name for row in table for name in row)
        durable.write(asked.folder / "extrapolated.csv", csv_text(table, [name for name in names if name != "verdict"] + ["verdict"]))
    for row in rows:
        if row.get("warnings"):
            print(f"{row['folder']}: WARNING: {row['warnings']}")
    print(f"tables in {asked.folder}")
    return sweep.stopped_or_failed(jobs, stopped)


if __name__ == "__main__":
    raise SystemExit(refusal.exit_status(extrapolate))
