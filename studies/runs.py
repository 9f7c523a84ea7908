"""Runs of a study: scenes, run as `jostle sweep` runs its points, and what they found."""

import csv
import dataclasses
import functools
import json
import math
import pathlib
import sys
import tomllib

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent
sys.path += [str(ROOT / "sweeps"), str(ROOT / "presentation")]

import side_by_side  # noqa: E402  (the path comes first)
from run_folder import RunFolder, structured  # noqa: E402
from runs_table import flat  # noqa: E402
from side_by_side import duration  # noqa: E402

STOPPED_EARLY = 75


class RunFailed(Exception):
    """Runs ended with an error; the message says which, and what they wrote."""


class Stopped(Exception):
    """Ctrl-C or SIGTERM: the runs have written their checkpoints."""


@dataclasses.dataclass
class Run:
    """One run: a scene, given as {table: {key: value}}, and for how many steps.

    `equilibration` steps are not averaged over, `production` steps are. `scene` leaves out their times, and may leave
    out the table [time] altogether: then the step is the default one.
    """

    name: str
    scene: dict
    equilibration: int
    production: int

    def __post_init__(self):
        self.folder = None  # set by `run_all`
        self.time_step = None
        self.errors_from_blocks = False  # the program would not tell them; set by `value`

    @property
    def steps(self):
        return self.equilibration + self.production

    def text(self, time_step):
        """The scene file. The program rounds times up to whole rows of the series."""
        times = {"equilibration": self.equilibration * time_step,
                 "production": self.production * time_step}
        tables = {"title": self.name, **self.scene, "time": {**self.scene.get("time", {}), **times}}
        return toml(tables)

    def beside(self, ending):
        """A file beside the run's folder."""
        return self.folder.with_name(self.folder.name + ending)

    @functools.cached_property
    def left(self):
        """What the run left: its folder as everybody reads it."""
        return RunFolder(self.folder, refuse)

    @property
    def summary(self):
        return self.left.summary

    @property
    def record(self):
        return self.left.record

    @property
    def threads(self):
        """Of the last session."""
        return self.record["sessions"][-1]["threads"]

    @property
    def wall_seconds(self):
        return sum(session["wall_seconds"] for session in self.record["sessions"])

    @property
    def killed(self):
        """Whether a session of it was, whose time since its last checkpoint is not known."""
        return any(session["exit_reason"] == "running" for session in self.record["sessions"])

    @property
    def time_taken(self):
        return ("more than " if self.killed else "") + duration(self.wall_seconds)

    def value(self, *keys):
        """(mean, standard error) of an entry of the summary.

        Where the program gives none because the run is too short to tell whether it is in equilibrium, as runs of a study may
        be that is to be affordable, the error is that of 16 blocks of the column, and the report says so. Any other error
        bar that is missing is an error here.
        """
        entry = functools.reduce(lambda table, key: table[key], keys, self.summary)
        if entry["standard_error"] is not None:
            return entry["mean"], entry["standard_error"]
        if self.summary["equilibrated"] or keys[0] not in self.series().dtype.names:
            reason = entry.get("no_standard_error_because", "it is not defined")
            raise RunFailed(f"{self.name}: no error bar of {'.'.join(keys)}: {reason}")
        self.errors_from_blocks = True
        return entry["mean"], error_of_blocks(self.series()[keys[0]])

    def value_if_any(self, *keys):
        """The same, with a standard error of nan where it is missing."""
        entry = functools.reduce(lambda table, key: table[key], keys, self.summary)
        return entry["mean"], numpy.nan if entry["standard_error"] is None else entry["standard_error"]

    def series(self):
        """The rows of production, by column name."""
        rows = structured(self.left.series_columns)
        return rows[rows["step"] > self.equilibration]


def refuse(path, problem, advice):
    raise RunFailed(f"{path}: {problem}. {advice}") from None


def error_of_blocks(rows, count=16):
    """Half of the half width of the 95 % interval of the mean: from 16 or 8 blocks, by Student's t."""
    blocks = rows[len(rows) % count:].reshape(count, -1).mean(axis=1)
    return {16: 2.131, 8: 2.365}[count] / 1.960 * blocks.std(ddof=1) / count**0.5


def jackknife_error(left_out):
    """Standard error of a quantity, given what it is without each block in turn."""
    return math.sqrt((len(left_out) - 1) / len(left_out) * ((left_out - left_out.mean())**2).sum())


def toml(tables):
    """TOML of {key: value} and {table: {key: value}}."""
    def value_text(value):
        return json.dumps(list(value) if isinstance(value, tuple) else value)

    lines = [f"{key} = {value_text(value)}" for key, value in tables.items() if not isinstance(value, dict)]
    for table, entries in tables.items():
        if isinstance(entries, dict):
            lines += ["", f"[{table}]", *(f"{key} = {value_text(value)}" for key, value in entries.items())]
    return "\n".join(lines) + "\n"


FRAMES = "output.trajectory_every"


class Job(side_by_side.Job):
    """Of a study a run is known by its scene as it is written: what was measured by an earlier version of the program is used again."""

    def is_same(self):
        """Frames are no matter."""
        there, wanted = (flat(tomllib.loads(path.read_text())) for path in (self.folder / "scene.toml", self.folder.with_name(self.name + ".toml")))
        return {**there, FRAMES: wanted.get(FRAMES)} == {**wanted, FRAMES: wanted.get(FRAMES)}


def job_of(jostle, run, folder):
    """Gives the run its folder and its time step, and writes its scene."""
    run.folder = folder / run.name
    scene = run.beside(".toml")
    try:
        scene.write_text(run.text(1.0))  # first to learn the time step, then with the times that follow from it
        run.time_step = side_by_side.ask(jostle, scene).time_step
        scene.write_text(run.text(run.time_step))
        frames = [] if "trajectory_every" in run.scene.get("output", {}) else ["--set", f"{FRAMES}=0"]
        job = Job(run.name, run.folder, [jostle, "run", scene, *frames, "--out", run.folder], side_by_side.ask(jostle, scene, *frames))
    except side_by_side.BadScene as refusal:
        raise RunFailed(f"{run.name}: {refusal}") from None
    if (run.folder / "scene.toml").exists() and not job.is_same():
        job.words.append("--fresh")
    return job


def run_all(jostle, runs, folder, processes):
    """Runs all, `processes` of one thread at a time, the longest first. What has been run before is used again.

    Raises RunFailed if any failed, after all have ended, and Stopped on Ctrl-C or SIGTERM.
    """
    folder.mkdir(parents=True, exist_ok=True)
    jobs = [job_of(jostle, run, folder) for run in runs]
    done = sum(job.is_done() for job in jobs)
    left = f"; the others: {side_by_side.foretold(jobs, processes)}" if done < len(jobs) else ""
    print(f"{len(jobs)} runs, {done} of them done before{left}", flush=True)
    if side_by_side.run_all(jobs, processes, beside=folder):
        raise Stopped
    failed = [f"{job.name}: {job.failure}" for job in jobs if job.failure]
    if failed:
        raise RunFailed("\n".join(failed))


def write_csv(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def read_csv(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def program(given):
    """The program to run: as given, or where the README's commands build it."""
    places = [pathlib.Path(given)] if given else [ROOT / "build" / preset / "apps/jostle"
                                                  for preset in ("release", "quickstart")]
    for place in places:
        if place.exists():
            return place.resolve()
    raise RunFailed(f"there is no program {' or '.join(str(place) for place in places)}: build it by ./quickstart, or\n"
                    "  cmake --preset release && cmake --build --preset release --target jostle")
