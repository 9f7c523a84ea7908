"""Runs of the jostle program, many side by side, the longest first; each goes on where it was stopped."""

import concurrent.futures
import dataclasses
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

from runs_table import flat

SECONDS_BETWEEN_LOOKS = 0.1
SECONDS_BETWEEN_LINES = 30.0  # where there is no terminal
STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
RODS_A_THREAD = 2000          # as `jostle run` has it
OVER = ("done", "extinct")    # exit reasons of a run that has come to its end


class BadScene(Exception):
    """`jostle check` refuses a scene; its words."""


@dataclasses.dataclass
class Told:
    """What `jostle check` tells of a run; what it cannot tell is nan."""

    resolved: str     # the scene with every default
    time_step: float
    steps: float
    seconds: float    # on one thread
    rods: float       # in the end, where they grow and divide; else at the start


@dataclasses.dataclass
class Job:
    """A run that is wanted: its folder, the words of its command but for the number of threads, and what is told of it."""

    name: str
    folder: Path
    words: list
    told: Told
    failure: str = ""  # how it failed in this session
    over: bool = False  # done, as `run_all` found it

    def is_done(self):
        """Whether the folder holds this very run, at its end."""
        try:
            return self.is_same() and json.loads((self.folder / "run.json").read_text())["exit_reason"] in OVER
        except (OSError, ValueError, KeyError):
            return False

    def is_same(self):
        """Whether the folder is of this scene. Keys that one of the two does not have are of another version of the program."""
        there, wanted = (flat(tomllib.loads(text)) for text in ((self.folder / "resolved.toml").read_text(), self.told.resolved))
        return all(there[key] == value for key, value in wanted.items() if key in there)

    def fraction_done(self):
        """How much of the run lies in its series, from 0 to 1."""
        try:
            with open(self.folder / "series.csv", "rb") as series:
                series.seek(0, os.SEEK_END)
                series.seek(max(0, series.tell() - 4096))
                last_row = series.read().rsplit(b"\n", 2)[-2]
            return min(1.0, float(last_row.split(b",")[0]) / self.told.steps)
        except (OSError, ValueError, IndexError):
            return 0.0

    @property
    def is_foretold(self):
        """Whether `jostle check` knows how long it takes: of a colony it does not."""
        return self.told.seconds > 0.0

    @property
    def seconds(self):
        """Foretold; of a run of which nothing is known, as if it were a short one."""
        return self.told.seconds if self.is_foretold else 1.0


def ask(jostle, scene, *words):
    """What `jostle check SCENE WORDS` tells. Raises BadScene."""
    done = subprocess.run([jostle, "check", scene, *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        words = done.stderr.strip() or f"jostle check ended with status {done.returncode}"
        raise BadScene(words[("\n" + words).rfind("\njostle: "):].removeprefix("jostle: ") if "jostle: " in words else words.splitlines()[-1])
    resolved, _, follows = done.stdout.partition("\n# what follows from it\n")
    time_step, steps, seconds, first, last = (number_after(follows, label) for label in
                                              ("time step", "steps", "time on one thread, about", "N", "N in the end, about"))
    told = Told(resolved, time_step, steps, seconds, last if last > first else first)
    step = tomllib.loads(resolved)["time"].get("step", "auto")
    if step != "auto":
        told.time_step = step  # in the scene's own unit, where cells grow, too
    return told


def keys_that_may_change(jostle):
    """Full keys of a scene with which a run goes on as the same, by the program's own list."""
    told = subprocess.run([jostle, "keys", "--json"], capture_output=True, text=True, check=True).stdout
    return {key["key"] for key in json.loads(told) if key["may_change"]}


def ask_all(jostle, requests, processes):
    """The same for (scene, *words) of every request, in their order: Told or BadScene."""
    def answer(request):
        try:
            return ask(jostle, *request)
        except BadScene as refusal:
            return refusal

    with concurrent.futures.ThreadPoolExecutor(processes) as pool:
        return list(pool.map(answer, requests))


def number_after(text, label):
    """The number in the line that begins with the label; nan if there is none."""
    found = re.search(rf"^{re.escape(label)} +([-+.e0-9]+)", text, re.MULTILINE)
    return float(found[1]) if found else float("nan")


def run_all(jobs, processes, tell=lambda job: None, beside=None):
    """Runs what is not done, `processes` of one thread at a time; with more threads where that leaves processors idle, and
    runs are large. `tell(job)` is called as each ends, well or not. `beside`: a folder for small temporary files.

    Returns whether a signal stopped it: then all have written their checkpoints.
    """
    for job in jobs:
        job.over = job.is_done()
    waiting = sorted((job for job in jobs if not job.over), key=lambda job: job.seconds * (1.0 - job.fraction_done()))
    running, signals = {}, []
    progress = Progress(jobs)
    # Not by an exception: one between the start of a run and its place in the list would leave it running for ever.
    former = {number: signal.signal(number, lambda number, _: signals.append(number)) for number in STOPPING
              if signal.getsignal(number) != signal.SIG_IGN}
    passed_on = 0
    try:
        while (waiting and not signals) or running:
            while waiting and len(running) < processes and not signals:
                share = processes // min(processes, len(waiting) + len(running))
                job = waiting.pop()
                process, words = _start(job, min(share, max(1, int(job.told.rods / RODS_A_THREAD)) if job.told.rods > 0 else 1), beside)
                running[process] = (job, words)
            if len(signals) > passed_on:  # the second ends runs at once
                passed_on = len(signals)
                for process in running:
                    process.send_signal(signal.SIGINT)
            for process in [process for process in running if process.poll() is not None]:
                job, words = running.pop(process)
                if process.returncode != 0 and not (signals and process.returncode == 75):
                    job.failure = _failure(process.returncode, words)
                    progress.clear()
                words.close()
                job.over = job.is_done()
                tell(job)
            progress.show(waiting, running)
            if running:
                time.sleep(SECONDS_BETWEEN_LOOKS)
    finally:
        progress.clear()
        for number, action in former.items():
            signal.signal(number, action)
    return bool(signals)


def _start(job, threads, beside):
    """Starts, or goes on with, a run, in a session of its own: Ctrl-C reaches it through us alone."""
    words = tempfile.TemporaryFile(mode="w+", errors="replace", dir=beside)  # of its errors
    process = subprocess.Popen([*job.words, "--threads", str(threads), "--quiet"], stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=words, start_new_session=True)
    return process, words


def _failure(status, words):
    """One line; the first that a run says names what is wrong."""
    words.seek(0)
    said = [line for line in words.read().splitlines() if line.strip()]
    text = said[0].removeprefix("jostle: ") if said else "it said nothing"
    return f"exit status {status}: {text}" if status > 0 else f"ended by signal {-status}"


class Progress:
    """One live line on a terminal, a plain line every half minute elsewhere."""

    def __init__(self, jobs):
        self.jobs = jobs
        self.total = sum(job.seconds for job in jobs) or 1.0
        self.began = self.last_line = time.monotonic()
        self.done_before = self.done()
        self.live = sys.stderr.isatty()

    def done(self):
        return sum(job.seconds * (1.0 if job.over else 0.999 * job.fraction_done()) for job in self.jobs) / self.total

    def show(self, waiting, running):
        now = time.monotonic()
        if now - self.last_line < (0.5 if self.live else SECONDS_BETWEEN_LINES):
            return
        self.last_line = now
        done, elapsed = self.done(), now - self.began
        gained = done - self.done_before
        are_foretold = all(job.over or job.is_foretold for job in self.jobs)
        left = f"  {duration(elapsed * (1.0 - done) / gained)} left" if gained > 0.01 and are_foretold else ""
        failed = sum(bool(job.failure) for job in self.jobs)
        over = sum(job.over for job in self.jobs)
        line = (f"{100 * done:3.0f} %  {over} of {len(self.jobs)} runs done, {len(running)} running"
                + (f", {failed} failed" if failed else "") + left)
        print("\r\033[K" + line if self.live else line, end="" if self.live else "\n", file=sys.stderr, flush=True)

    def clear(self):
        if self.live:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def duration(seconds):
    minutes, seconds = divmod(int(round(seconds)), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes:02d} min"
    return f"{minutes} min {seconds:02d} s" if minutes else f"{seconds} s"


def foretold(jobs, processes):
    """How long the runs that are not done take, in words."""
    missing = [job for job in jobs if not job.is_done()]
    if not all(job.is_foretold for job in missing):
        return "how long it takes is not known, for cells multiply"
    left = sum(job.seconds * (1.0 - job.fraction_done()) for job in missing)
    return f"about {duration(max(1.0, left / processes))} on {processes} processors"


def processors():
    return len(os.sched_getaffinity(0))
