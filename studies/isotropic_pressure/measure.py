#!/usr/bin/python3
"""Equation of state of isotropic rods L/D = 5: runs eight volume fractions, compares Z with Monte Carlo, plots.

    measure.py JOSTLE RESULTS [--processes N] [--threads N]

JOSTLE is the program, RESULTS a folder. Each point of points.csv is one run of scene.toml, of `--threads` threads;
`--processes` of them at a time. What has been run before is used again, and a run that was stopped goes on. RESULTS
then holds pressure.csv, pressure.md (the table as printed), pressure.png, pressure.svg and one folder a run.

Exit status: 0 all runs done, every standard error of Z at most 0.5 % and every Z within 1 % and two standard errors of
the reference; 1 not so; 75 stopped by Ctrl-C: the same command goes on.
"""

import argparse
import csv
import dataclasses
import json
import math
import os
import pathlib
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
REFERENCE = HERE.parent / "reference" / "rods_monte_carlo.csv"
SEED = 1
LARGEST_RELATIVE_ERROR = 0.005
TOLERANCE = 0.01  # of Z, beside two standard errors: the time step and the size of the system
SECONDS_BETWEEN_LOOKS = 0.5
STOPPED_EARLY = 75


@dataclasses.dataclass
class Point:
    """One volume fraction: what is run, and where."""

    phi: float
    equilibration: float
    production: float
    relative_cost: float  # of a step; only to foretell the time that is left
    folder: pathlib.Path

    @property
    def weight(self):
        return self.relative_cost * (self.equilibration + self.production)

    @property
    def scene(self):
        template = (HERE / "scene.toml").read_text()
        return template.format(phi=f"{self.phi:.2f}", seed=SEED, equilibration=self.equilibration,
                               production=self.production)

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
            return min(1.0, float(last_row.split(b",")[1]) / (self.equilibration + self.production))
        except (OSError, ValueError, IndexError):
            return 0.0

    def summary(self):
        return json.loads((self.folder / "summary.json").read_text())


class Comparison:
    """Z of one point beside its reference value."""

    def __init__(self, point, reference):
        measured = point.summary()["Z"]
        if measured["standard_error"] is None:
            raise SystemExit(f"quickstart: no error bar at phi {point.phi}: {measured['no_standard_error_because']}")
        self.phi = point.phi
        self.Z, self.standard_error = measured["mean"], measured["standard_error"]
        self.reference, self.reference_error = reference
        difference = self.Z - self.reference
        self.combined_error = math.hypot(self.standard_error, self.reference_error)
        self.difference_per_cent = 100.0 * difference / self.reference
        self.difference_in_errors = difference / self.combined_error

    @property
    def precise(self):
        return self.standard_error <= LARGEST_RELATIVE_ERROR * self.Z

    @property
    def agrees(self):
        allowed = TOLERANCE * self.reference + 2.0 * self.combined_error
        return abs(self.Z - self.reference) <= allowed


def read_points(results):
    with open(HERE / "points.csv", newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    return [Point(**row, folder=results / f"phi_{row['phi']:.2f}") for row in rows]


def read_reference():
    """(Z, standard error) of the isotropic states, by volume fraction."""
    with open(REFERENCE, newline="") as file:
        return {round(float(row["phi"]), 4): (float(row["Z"]), float(row["Z_err"])) for row in csv.DictReader(file)
                if row["start"] == "isotropic"}


class Progress:
    """One live line on a terminal, a plain line every half minute elsewhere."""

    def __init__(self, points):
        self.points = points
        self.total = sum(point.weight for point in points)
        self.began = time.monotonic()
        self.done_before = self.done()
        self.last_line = 0.0
        self.live = sys.stdout.isatty()

    def done(self):
        return sum(point.weight * point.fraction_done() for point in self.points) / self.total

    def show(self, running, finished):
        now = time.monotonic()
        if not self.live and now - self.last_line < 30.0:
            return
        self.last_line = now
        done, elapsed = self.done(), now - self.began
        gained = done - self.done_before
        left = f"{duration(elapsed * (1.0 - done) / gained)} left" if gained > 0.01 else ""
        states = " ".join(f"{point.phi:.2f}" for point in running)
        line = f"{100 * done:3.0f} %  {finished} of {len(self.points)} done, running phi {states}  {left}"
        print("\r\033[K" + line if self.live else line, end="" if self.live else "\n", flush=True)

    def end(self):
        if self.live:
            print("\r\033[K", end="", flush=True)


def duration(seconds):
    return f"{int(seconds) // 60} min {int(seconds) % 60:02d} s"


def start_run(jostle, point, threads):
    """Starts, or goes on with, the run of a point; its messages go to a log beside its folder."""
    scene = point.beside(".toml")
    command = [jostle, "run", scene, "--out", point.folder, "--threads", str(threads), "--quiet"]
    former = point.folder / "scene.toml"
    if former.exists() and former.read_text() != point.scene:
        command.append("--fresh")
    scene.write_text(point.scene)
    with open(point.beside(".log"), "w") as log:
        return subprocess.Popen(command, stdout=log, stderr=log)


def run_all(jostle, points, processes, threads):
    """Runs all points, the longest first; the folders of those that failed."""
    waiting = sorted(points, key=lambda point: point.weight)
    running, failed = {}, []
    progress = Progress(points)
    try:
        while waiting or running:
            while waiting and len(running) < processes:
                point = waiting.pop()
                running[start_run(jostle, point, threads)] = point
            for run in [run for run in running if run.poll() is not None]:
                point = running.pop(run)
                if run.returncode != 0:
                    failed.append((point, run.returncode))
            progress.show(running.values(), len(points) - len(waiting) - len(running))
            time.sleep(SECONDS_BETWEEN_LOOKS)
    except KeyboardInterrupt:
        progress.end()
        for run in running:  # Ctrl-C has reached them too: they write their checkpoints
            run.wait()
        print("quickstart: stopped; the same command goes on from here", file=sys.stderr)
        raise SystemExit(STOPPED_EARLY)
    progress.end()
    return failed


def table(comparisons):
    header = ["phi", "Z", "standard error", "reference Z", "difference, %", "in standard errors"]
    rows = [[f"{c.phi:.2f}", f"{c.Z:.3f}", f"{c.standard_error:.3f} ({100 * c.standard_error / c.Z:.2f} %)",
             f"{c.reference:.3f} +- {c.reference_error:.3f}", f"{c.difference_per_cent:+.2f}",
             f"{c.difference_in_errors:+.1f}"] for c in comparisons]
    widths = [max(len(row[k]) for row in [header, *rows]) for k in range(len(header))]
    lines = ["| " + " | ".join(cell.rjust(width) for cell, width in zip(row, widths)) + " |" for row in [header, *rows]]
    lines.insert(1, "|" + "|".join("-" * (width + 1) + ":" for width in widths) + "|")
    return "\n".join(lines)


def footnote(points):
    """What was run, from the runs' own records."""
    records = [json.loads((point.folder / "run.json").read_text()) for point in points]
    steps = sum(record["steps"] for record in records)
    seconds = sum(session["wall_seconds"] for record in records for session in record["sessions"])
    processors = sorted({session["processor"] for record in records for session in record["sessions"]})
    return (f"{points[0].summary()['rods']} rods L/D = 5, rms step 0.03 D, {steps} steps in all, {seconds:.0f} s of one thread each "
            f"on {', '.join(processors)}; jostle {records[0]['version']}. Standard errors are corrected for correlation; the "
            "difference in standard errors is in units of that of both values together.")


def write_csv(path, comparisons):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["phi", "Z", "standard_error", "reference_Z", "reference_standard_error", "difference_per_cent",
                         "difference_in_standard_errors"])
        for c in comparisons:
            writer.writerow([f"{c.phi:.2f}", f"{c.Z:.6f}", f"{c.standard_error:.6f}", f"{c.reference:.4f}",
                             f"{c.reference_error:.4f}", f"{c.difference_per_cent:.4f}", f"{c.difference_in_errors:.3f}"])


def plot(path_without_suffix, comparisons):
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "jostle", "font.size": 10, "axes.spines.top": False,
                                "axes.spines.right": False})
    from matplotlib import pyplot

    phi = [c.phi for c in comparisons]
    figure, (pressure, difference) = pyplot.subplots(2, 1, sharex=True, figsize=(5.6, 5.2), layout="constrained",
                                                     height_ratios=[3, 1])
    pressure.errorbar(phi, [c.Z for c in comparisons], [c.standard_error for c in comparisons], color="C0", marker="o",
                      markersize=4, linewidth=1.2, label="jostle")
    pressure.errorbar(phi, [c.reference for c in comparisons], [c.reference_error for c in comparisons], color="black",
                      marker="s", markersize=9, markerfacecolor="none", linestyle="none", label="Monte Carlo")
    pressure.set_ylabel("Z = P/(n kT)")
    pressure.set_ylim(0, None)
    pressure.legend(frameon=False, loc="upper left")
    pressure.set_title("Isotropic hard rods, L/D = 5", loc="left")
    difference.axhline(0.0, color="black", linewidth=0.8)
    difference.errorbar(phi, [c.difference_per_cent for c in comparisons],
                        [100.0 * c.combined_error / c.reference for c in comparisons], color="C0", marker="o",
                        markersize=4, linestyle="none", capsize=2)
    largest = max(2.0, *(abs(c.difference_per_cent) + 100.0 * c.combined_error / c.reference for c in comparisons))
    difference.set_ylim(-1.1 * largest, 1.1 * largest)
    difference.set_ylabel("difference, %")
    difference.set_xlabel("volume fraction")
    figure.savefig(path_without_suffix.with_suffix(".png"), dpi=160)
    figure.savefig(path_without_suffix.with_suffix(".svg"), metadata={"Date": None})


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("jostle", type=pathlib.Path, help="the program")
    parser.add_argument("results", type=pathlib.Path, help="folder for runs, table and figure")
    parser.add_argument("--processes", type=int, default=len(os.sched_getaffinity(0)), help="runs at a time")
    parser.add_argument("--threads", type=int, default=1, help="threads of each run")
    return parser.parse_args()


def verdict(comparisons):
    """One line of what came out, and whether it is as it should be."""
    imprecise = [f"{c.phi:.2f}" for c in comparisons if not c.precise]
    apart = [f"{c.phi:.2f}" for c in comparisons if not c.agrees]
    if imprecise:
        print(f"quickstart: the standard error of Z is above 0.5 % at phi {', '.join(imprecise)}", file=sys.stderr)
    if apart:
        print(f"quickstart: Z is not within 1 % and two standard errors of the reference at phi {', '.join(apart)}",
              file=sys.stderr)
    if not imprecise and not apart:
        print(f"All {len(comparisons)} agree: standard errors at most 0.5 %, Z within 1 % and two standard errors.")
    return not imprecise and not apart


def main():
    options = arguments()
    options.results.mkdir(parents=True, exist_ok=True)
    points = read_points(options.results)
    failed = run_all(options.jostle.resolve(), points, max(1, options.processes), options.threads)
    for point, status in failed:
        log = point.beside(".log")
        print(f"quickstart: the run at phi {point.phi:.2f} ended with exit status {status} ({log}):\n{log.read_text()}",
              file=sys.stderr)
    if failed:
        return 1
    reference = read_reference()
    comparisons = [Comparison(point, reference[round(point.phi, 4)]) for point in points]
    text = table(comparisons)
    print(text)
    (options.results / "pressure.md").write_text(f"{text}\n\n{footnote(points)}\n")
    write_csv(options.results / "pressure.csv", comparisons)
    plot(options.results / "pressure", comparisons)
    good = verdict(comparisons)
    print(f"Table and figure: {options.results}/pressure.csv, .md, .png, .svg")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
