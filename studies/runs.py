"""Runs of the jostle program: scenes, many side by side, resumed where they were stopped."""

import csv
import dataclasses
import functools
import json
import os
import pathlib
import signal
import subprocess
import sys
import time

import numpy

SECONDS_BETWEEN_LOOKS = 0.3
SECONDS_BETWEEN_LINES = 30.0
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
        self.seconds = None  # foretold, of one thread
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

    def fraction_done(self):
        """How much of the run lies in its series, from 0 to 1."""
        try:
            with open(self.folder / "series.csv", "rb") as series:
                series.seek(0, os.SEEK_END)
                series.seek(max(0, series.tell() - 4096))
                last_row = series.read().rsplit(b"\n", 2)[-2]
            return min(1.0, float(last_row.split(b",")[0]) / self.steps)
        except (OSError, ValueError, IndexError):
            return 0.0

    @functools.cached_property
    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())

    @functools.cached_property
    def record(self):
        return json.loads((self.folder / "run.json").read_text())

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
        rows = numpy.genfromtxt(self.folder / "series.csv", delimiter=",", names=True)
        return rows[rows["step"] > self.equilibration]


def error_of_blocks(rows):
    """Half of the half width of the 95 % interval of the mean: from 16 blocks, by Student's t of 15 degrees of freedom."""
    blocks = rows[len(rows) % 16:].reshape(16, -1).mean(axis=1)
    return 2.131 / 1.960 * blocks.std(ddof=1) / 4.0


def toml(tables):
    """TOML of {key: value} and {table: {key: value}}."""
    def value_text(value):
        return json.dumps(list(value) if isinstance(value, tuple) else value)

    lines = [f"{key} = {value_text(value)}" for key, value in tables.items() if not isinstance(value, dict)]
    for table, entries in tables.items():
        if isinstance(entries, dict):
            lines += ["", f"[{table}]", *(f"{key} = {value_text(value)}" for key, value in entries.items())]
    return "\n".join(lines) + "\n"


def prepare(jostle, runs, folder):
    """Gives every run its folder, and asks the program for its time step and its cost."""
    folder.mkdir(parents=True, exist_ok=True)
    for run in runs:
        run.folder = folder / run.name
        scene = run.beside(".check.toml")
        for time_step in (1.0, None):  # first to learn the time step, then with the times that follow from it
            scene.write_text(run.text(time_step or run.time_step))
            told = subprocess.run([jostle, "check", scene], capture_output=True, text=True, check=False)
            if told.returncode != 0:
                raise RunFailed(f"{run.name}: {told.stderr}")
            run.time_step = number_after(told.stdout, "time step")
        run.seconds = number_after(told.stdout, "time on one thread, about")
        scene.unlink()


def number_after(text, label):
    line = next(line for line in text.splitlines() if line.startswith(label + " "))
    return float(line[len(label):].split()[0])


def run_all(jostle, runs, folder, processes):
    """Runs all, `processes` of one thread at a time, the longest first; with more threads if there are fewer runs than
    processors. What has been run before is used again.

    Raises RunFailed if any failed, after all have ended, and Stopped on Ctrl-C or SIGTERM.
    """
    prepare(jostle, runs, folder)
    waiting = sorted((run for run in runs if not is_done(run)), key=lambda run: run.seconds)
    foretold = sum(run.seconds * (1.0 - run.fraction_done()) for run in waiting)
    print(f"{len(runs)} runs, {len(runs) - len(waiting)} of them done before; the others take about "
          f"{duration(foretold / processes)} on {processes} processors", flush=True)
    threads = max(1, processes // max(1, len(waiting)))
    running, failed, stopped = {}, [], []
    progress = Progress(runs)
    # Not by an exception: one between the start of a run and its place in the list would leave it running for ever.
    former = {number: signal.signal(number, lambda *_: stopped.append(True)) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        while (waiting or running) and not stopped:
            while waiting and len(running) < processes:
                run = waiting.pop()
                running[start(jostle, run, threads)] = run
            for process in [process for process in running if process.poll() is not None]:
                run = running.pop(process)
                if process.returncode != 0:
                    failed.append(f"{run.name} ended with exit status {process.returncode}:\n"
                                  + run.beside(".log").read_text())
            progress.show(len(runs) - len(waiting) - len(running))
            if running:
                time.sleep(SECONDS_BETWEEN_LOOKS)
    finally:
        progress.end()
        for number, handler in former.items():
            signal.signal(number, handler)
    if waiting or running:
        for process in running:
            process.send_signal(signal.SIGINT)
        for process in running:
            process.wait()
        raise Stopped
    if failed:
        raise RunFailed("\n".join(failed))


def is_done(run):
    """Whether the folder holds this very run, finished."""
    try:
        same = (run.folder / "scene.toml").read_text() == run.text(run.time_step)
        return same and run.record["exit_reason"] == "done"
    except (OSError, ValueError):
        return False
    finally:
        run.__dict__.pop("record", None)  # it will change


def start(jostle, run, threads):
    """Starts, or goes on with, a run, in a process group of its own; its messages go to a log beside its folder."""
    scene, text = run.beside(".toml"), run.text(run.time_step)
    command = [jostle, "run", scene, "--out", run.folder, "--threads", str(threads), "--quiet"]
    former = run.folder / "scene.toml"
    if former.exists() and former.read_text() != text:
        command.append("--fresh")
    scene.write_text(text)
    with open(run.beside(".log"), "w", encoding="utf-8") as log:
        return subprocess.Popen(command, stdout=log, stderr=log, start_new_session=True)


class Progress:
    """One live line on a terminal, a plain line every half minute elsewhere."""

    def __init__(self, runs):
        self.runs = runs
        self.total = sum(run.seconds for run in runs)
        self.began = time.monotonic()
        self.done_before = self.done()
        self.last_line = self.began
        self.live = sys.stdout.isatty()

    def done(self):
        return sum(run.seconds * run.fraction_done() for run in self.runs) / self.total

    def show(self, finished):
        now = time.monotonic()
        if not self.live and now - self.last_line < SECONDS_BETWEEN_LINES:
            return
        self.last_line = now
        done, elapsed = self.done(), now - self.began
        gained = done - self.done_before
        left = f"{duration(elapsed * (1.0 - done) / gained)} left" if gained > 0.01 else ""
        line = f"{100 * done:3.0f} %  {finished} of {len(self.runs)} runs done  {left}"
        print("\r\033[K" + line if self.live else line, end="" if self.live else "\n", flush=True)

    def end(self):
        if self.live:
            print("\r\033[K", end="", flush=True)


def duration(seconds):
    minutes, seconds = divmod(int(round(seconds)), 60)
    hours, minutes = divmod(minutes, 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min {seconds:02d} s"


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
    root = pathlib.Path(__file__).resolve().parent.parent
    places = [pathlib.Path(given)] if given else [root / "build" / preset / "apps/jostle"
                                                  for preset in ("release", "quickstart")]
    for place in places:
        if place.exists():
            return place.resolve()
    raise RunFailed(f"there is no program {' or '.join(str(place) for place in places)}: build it by ./quickstart, or\n"
                    "  cmake --preset release && cmake --build --preset release --target jostle")
