"""jostle sweep: one scene at many values of its keys, and with many seeds: runs side by side, a table, curves.

    sweep.py --jostle=PROGRAM --typed=COMMAND --out=DIR --replicas=R --processes=P [--zip] [--print-commands]
             [--set=KEY=V1,V2 ...] [--plot=NAME ...] --against=KEY -- SCENE

Called by the command, which has read the command line. Empty values stand for what was not given.
"""

import argparse
import contextlib
import fcntl
import json
import os
import shlex
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "presentation"))

import durable  # noqa: E402  (the path comes first)
import refusal  # noqa: E402
import side_by_side  # noqa: E402
from points import asked_for, parsed, points_of  # noqa: E402
from refusal import Refusal  # noqa: E402
from runs_table import NOT_BEGUN, flat, row_of, units_of  # noqa: E402

RECORD = "sweep.json"
NEEDED = {"numpy": "python3-numpy", "scipy": "python3-scipy"}
NEEDED_TO_DRAW = {"matplotlib": "python3-matplotlib"}
MOST = {"replicas": 10000, "processes": 4096}
MOST_POINTS = 100000
FAILED = 3


def arguments():
    parser = argparse.ArgumentParser()
    for name in ("jostle", "typed", "out", "replicas", "processes", "against"):
        parser.add_argument(f"--{name}", default="")
    for name in ("zip", "print-commands"):
        parser.add_argument(f"--{name}", action="store_true")
    for name in ("set", "plot"):
        parser.add_argument(f"--{name}", action="append", default=[])
    parser.add_argument("scene")
    return parser.parse_args()


def count_of(name, text, default):
    if text == "":
        return default
    if not text.isascii() or not text.isdigit() or not 1 <= int(text) <= MOST[name]:
        raise Refusal(f"--{name} = {text}", f"is no such number (allowed: 1 to {MOST[name]})")
    return int(text)


class BadScene(Refusal):
    """What `jostle check` refuses; its words tell all, a line for each mistake of a scene."""

    def __init__(self, words):
        Exception.__init__(self, words)

    def lines(self):
        return str(self).splitlines()


class Sweep:
    """What is asked for, and the folder that holds it."""

    def __init__(self, options, ending=".sweep", steps=()):
        """`steps`: values of time.rms_step, as texts, with which every point is run."""
        self.jostle, self.scene = options.jostle, options.scene
        self.folder = Path(options.out or Path(self.scene).stem + ending)
        self.processes = count_of("processes", options.processes, side_by_side.processors())
        content = scene_content(self.jostle, self.scene)
        table = content.pop("sweep", {})
        table = table if isinstance(table, dict) else {}  # which `jostle check` refuses
        keys = asked_for(options.set, table)
        seeds = self.seeds(options.replicas or str(table.get("replicas", "")), keys, content)
        if not any(len(values) > 1 for values in keys.values()) and not steps and len(seeds) < 2:
            raise Refusal(self.scene, "nothing to vary", "Give --set KEY=V1,V2, --replicas R, or a table [sweep] in the scene")
        at_steps = [(("time.rms_step", step),) for step in steps] or [()]
        repeated = [step + seed for step in at_steps for seed in [(("seed", seed),) for seed in seeds] or [()]]
        self.points = points_of(keys, options.zip or table.get("zip") is True, repeated)
        if len(self.points) > MOST_POINTS:
            raise Refusal("--set", f"makes {len(self.points)} points (allowed: at most {MOST_POINTS})")
        # What does not vary is part of the scene.
        constants = {key: parsed(values[0]) for key, values in keys.items() if len(values) == 1}
        self.keys = [*(key for key in keys if key not in constants), *(["time.rms_step"] if steps else []), *(["seed"] if seeds else [])]
        base = {**flat(content), **constants}
        free = side_by_side.keys_that_may_change(self.jostle)
        self.base = {key: value for key, value in base.items() if key not in self.keys and key not in free}

    @staticmethod
    def seeds(replicas, keys, content):
        """Of the replicas, as texts; none if there is one."""
        count = count_of("replicas", replicas, 1)
        if count > 1 and "seed" in keys:
            raise Refusal("--replicas", "sets the seed, and so does --set seed", "Give one of the two")
        first = content.get("seed", 1)
        return [str(first + number) for number in range(count)] if count > 1 and isinstance(first, int) else []

    def value(self, point, key):
        return parsed(point.value(key))

    def command(self, point, program):
        return [program, "run", self.scene, *point.words(), "--out", str(self.folder / point.name)]

    def jobs(self):
        """Every point with what `jostle check` tells of it. Raises Refusal for the first that it refuses."""
        told = side_by_side.ask_all(self.jostle, [(self.scene, *point.words()) for point in self.points], self.processes)
        for point, answer in zip(self.points, told):
            if isinstance(answer, side_by_side.BadScene):
                of_all = "unknown" in str(answer) or len(self.points) == 1
                raise BadScene(str(answer)) if of_all else BadScene(f"point {point.name}: {answer}")
        return [side_by_side.Job(point.name, self.folder / point.name, self.command(point, self.jostle), answer)
                for point, answer in zip(self.points, told)]

    def require_own_folder(self):
        """Refuses a folder that holds anything but this sweep."""
        if not os.path.lexists(self.folder):
            if not self.folder.absolute().parent.is_dir():
                raise Refusal(self.folder.absolute().parent, "there is no such folder", "Make it first, or give another --out")
            return
        if not self.folder.is_dir() or (any(self.folder.iterdir()) and not (self.folder / RECORD).exists()):
            raise Refusal(self.folder, "is there already, and is not the folder of a sweep", "Give another folder with --out")
        if not (self.folder / RECORD).exists():
            return
        try:
            record = json.loads((self.folder / RECORD).read_text())
            before, base = list(record["keys"]), record["scene"]
        except (OSError, ValueError, KeyError, TypeError):
            raise Refusal(self.folder / RECORD, "cannot be read: it is damaged", "Give another folder with --out") from None
        if set(before) != set(self.keys):
            raise Refusal(self.folder, f"holds another sweep: over {', '.join(before)}, and this one is over {', '.join(self.keys)}",
                          "Give another folder with --out")
        for key in sorted({*base, *self.base}):
            if base.get(key) != self.base.get(key):
                raise Refusal(self.folder, f"holds a sweep of another scene: {key} {said(base.get(key))} and {said(self.base.get(key), 'is')}",
                              "Restore the scene, or give another folder with --out")

    @contextlib.contextmanager
    def opened(self):
        """Makes the folder and holds its lock."""
        self.require_own_folder()
        self.folder.mkdir(exist_ok=True)
        with open(self.folder / "lock", "a", encoding="utf-8") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError:
                raise Refusal(self.folder, "another sweep goes on in this folder", "Wait for it, or give another folder with --out") from None
            before = {}
            if (self.folder / RECORD).exists():
                before = json.loads((self.folder / RECORD).read_text())["keys"]
            values = {key: [self.value(point, key) for point in self.points] for key in self.keys}
            values = {key: unique([*before.get(key, []), *values[key]]) for key in self.keys}
            durable.write(self.folder / RECORD, json.dumps({"made_by": "jostle sweep", "keys": values, "scene": self.base}, indent=1) + "\n")
            yield


def unique(values):
    return [value for number, value in enumerate(values) if value not in values[:number]]


def said(value, verb="was"):
    return f"{verb} not given" if value is None else f"{verb} {json.dumps(value)}"


def scene_content(jostle, path):
    """The tables of a scene. Raises BadScene, in the words of `jostle check`, if it cannot be read."""
    try:
        return tomllib.loads(Path(path).read_text(encoding="utf-8-sig"))
    except (OSError, ValueError):
        try:
            side_by_side.ask(jostle, path)
        except side_by_side.BadScene as refused:
            raise BadScene(str(refused)) from None
        raise Refusal(path, "cannot be read a second time", "Give a file, and no pipe") from None


def rows_of(sweep, jobs):
    """A row for every point, with its keys as they were asked for."""
    rows = []
    for point, job in zip(sweep.points, jobs):
        row = row_of(job.folder)
        row["folder"] = job.name
        if job.failure:
            row = {"status": f"failed ({job.failure})", "folder": job.name}
        elif row["status"] == NOT_BEGUN and job.folder.exists():
            row["status"] = "stopped"
        row.update({key: sweep.value(point, key) for key in sweep.keys})
        rows.append(row)
    return rows


def stopped_or_failed(jobs, stopped):
    if stopped:
        print("jostle: stopped; the same command goes on from here", file=sys.stderr)
        return refusal.STOPPED
    failed = sum(bool(job.failure) for job in jobs)
    if failed:
        print(f"jostle: {failed} of {len(jobs)} runs failed; the same command tries them again", file=sys.stderr)
    return FAILED if failed else refusal.DONE


def tell_failure(job):
    if job.failure:
        print(f"jostle: {job.name} failed: {refusal.on_one_line(job.failure)}", file=sys.stderr, flush=True)


def run_jobs(sweep, jobs):
    """Runs what is not done; whether it was stopped."""
    done = sum(job.is_done() for job in jobs)
    print(f"jostle: {len(jobs)} runs in {sweep.folder}" + (f", {done} of them done before" if done else "")
          + (f"; {side_by_side.foretold(jobs, sweep.processes)}" if done < len(jobs) else ""),
          file=sys.stderr, flush=True)
    return side_by_side.run_all(jobs, sweep.processes, tell_failure, sweep.folder)


def sweep():
    options = arguments()
    refusal.require_modules({**NEEDED, **(NEEDED_TO_DRAW if options.plot else {})})
    import outcome

    asked = Sweep(options)
    outcome.require(options.plot, options.against, asked.keys)
    jobs = asked.jobs()
    with asked.opened():
        if options.print_commands:
            for point in asked.points:
                print(shlex.join(asked.command(point, options.typed)))
            return refusal.DONE
        stopped = run_jobs(asked, jobs)
        rows = rows_of(asked, jobs)
        text = outcome.leave(rows, asked.keys, options.plot, options.against, units_of([job.folder for job in jobs]),
                                     asked.folder)
    print(text, f"tables in {asked.folder}", sep="\n")
    return stopped_or_failed(jobs, stopped)


if __name__ == "__main__":
    raise SystemExit(refusal.exit_status(sweep))
