#!/usr/bin/python3
"""Cost of jostle beside that of LAMMPS with rods of rigid beads, and of Monte Carlo, in turns in the same run.

    benchmarks/rivals/compare.py [--jostle PATH] [--quick] [--count N] [--output DIR]

README.md says what is compared and how. DIR gets rivals.csv, rivals.md and the files of all runs. Needs Debian's
lammps, openmpi-bin, python3-numpy and python3-h5py; without LAMMPS it says so and ends with status 0.
"""

import argparse
import csv
import dataclasses
import importlib.util
import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import numpy

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
REFERENCE = ROOT / "studies" / "reference" / "monte_carlo.csv"
VOLUME_FRACTIONS = (0.1, 0.3)
LENGTH = 5.0  # of a rod, in D
RMS_STEP = 0.03  # of jostle, in D
TIME_STEP = 0.008  # of LAMMPS, in sqrt(m_rod sigma^2/kT)
DAMPING = 0.1  # the same unit: a rod forgets its velocity within 0.1 sigma
DAMPING_OF_NVT = 0.3
PRECISION = 0.01  # of Z, that the last column is about
FATTER = 1.01  # diameter of the rods that settle: so the start has no overlap
LEAST_BLOCKS = 24  # of an error estimate, which is then known to 15 %
STOPPED_EARLY = 75

SCENE = """seed = 1
[box]
edges = [{edge:.17g}, {edge:.17g}, {edge:.17g}]
[rods]
count = {count}
length = {length}
diameter = {diameter}
{start}
[time]
{step}
equilibration = 0.0
production = 1e7
[output]
series_every = 10
trajectory_every = {trajectory_every}
checkpoint_every = 1000000000
"""


@dataclasses.dataclass
class Session:
    """What one call of a program did."""

    steps: int
    wall: float  # seconds in steps, without reading and writing
    cpu: float  # the same, of all threads
    Z: numpy.ndarray  # one value a row of the program's series


@dataclasses.dataclass
class Start:
    """Rods L/D = 5, D = 1, in a cube."""

    phi: float
    edge: float
    centres: numpy.ndarray
    axes: numpy.ndarray

    def copied(self, copies):
        """As many copies side by side along each edge."""
        shifts = self.edge * numpy.stack(numpy.meshgrid(*3 * [numpy.arange(copies)]), -1).reshape(-1, 1, 3)
        return Start(self.phi, copies * self.edge, (self.centres + shifts).reshape(-1, 3),
                     numpy.tile(self.axes, (copies**3, 1)))

    @property
    def count(self):
        return len(self.centres)


def call(command, log, folder, threads=1, accepted=(0,)):
    """Runs a command in a folder, its output in a log; (wall seconds, CPU seconds)."""
    began = time.monotonic()
    with open(folder / log, "w") as file:
        child = subprocess.Popen([str(word) for word in command], cwd=folder, stdout=file, stderr=file,
                                 env=dict(os.environ, OMP_NUM_THREADS=str(threads)))
        _, status, used = os.wait4(child.pid, 0)
        child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode not in accepted:
        sys.exit(f"compare.py: {pathlib.Path(command[0]).name} ended with exit status {child.returncode}, "
                 f"see {folder / log}")
    return time.monotonic() - began, used.ru_utime + used.ru_stime


def write_rods(start, path):
    rods = numpy.hstack([start.centres, start.axes])
    numpy.savetxt(path, rods, "%.17g", ",", header="x,y,z,nx,ny,nz", comments="")


class Jostle:
    name = "jostle"
    diameter = 1.0
    most_threads = 2

    def __init__(self, program):
        self.program = program
        self.step = f"rms_step = {RMS_STEP}"
        self.time_step = None  # in jostle's unit, after a session

    @property
    def physical_step(self):
        """In D^2/D_t."""
        return RMS_STEP**2 / 2

    def prepare(self, start, folder):
        name = f"{self.name.replace(', ', '-').replace(' ', '-')}-{start.phi}-{start.count}"
        write_rods(start, folder / f"{name}.csv")
        (folder / f"{name}.toml").write_text(SCENE.format(
            edge=start.edge, count=start.count, length=LENGTH, diameter=1.0, step=self.step, trajectory_every=0,
            start=f'start = "file"\nfile = "{name}.csv"'))
        return name

    def session(self, name, number, threads, seconds, folder):
        """Goes on with a run for some seconds; one more is what the program keeps for its end."""
        whole = math.ceil(seconds) + 1
        wall, cpu = call([self.program, "run", f"{name}.toml", "--out", name, "--threads", threads, "--quiet",
                          "--walltime", f"0:{whole // 60:02d}:{whole % 60:02d}"],
                         f"{name}.{number}.log", folder, threads, (STOPPED_EARLY,))
        record = json.loads((folder / name / "run.json").read_text())
        self.time_step, record = record["time_step"], record["sessions"][-1]
        rows = numpy.genfromtxt(folder / name / "series.csv", delimiter=",", names=True)
        rows = rows[rows["step"] > record["first_step"]]
        return Session(record["last_step"] - record["first_step"], record["wall_seconds"],
                       cpu * record["wall_seconds"] / wall, rows["Z"])


class AccurateJostle(Jostle):
    """With the longest step that leaves Z accurate to PRECISION."""

    name = f"jostle, accuracy {PRECISION}"

    def __init__(self, usual):
        super().__init__(usual.program)
        self.usual = usual
        self.step = f"accuracy = {PRECISION}"

    @property
    def physical_step(self):
        return self.usual.physical_step * self.time_step / self.usual.time_step


class MonteCarlo:
    """Moves rods at random, and counts pairs that a smaller box would bring to overlap. A step is one move of each."""

    name = "Metropolis Monte Carlo"
    diameter = 1.0
    most_threads = 1
    physical_step = None

    def __init__(self, program):
        self.program = program
        self.edges = {}

    def prepare(self, start, folder):
        name = f"monte-carlo-{start.phi}-{start.count}"
        write_rods(start, folder / f"{name}.csv")
        self.edges[name] = start.edge
        return name

    def session(self, name, number, threads, seconds, folder):
        log, series = f"{name}.{number}.log", f"{name}.{number}.series"
        rods = f"{name}.csv"
        call([self.program, rods, self.edges[name], LENGTH, seconds, number + 1, series, rods], log, folder)
        sweeps, wall, cpu = re.search(r"(\d+) sweeps, (\S+) s, (\S+) s", (folder / log).read_text()).groups()
        return Session(int(sweeps), float(wall), float(cpu), numpy.loadtxt(folder / series, ndmin=1))


class Lammps:
    diameter = None  # of the hard sphere that stands for a WCA bead, in sigma; set below
    most_threads = 2

    def __init__(self, beads, thermostat):
        self.beads, self.thermostat = beads, thermostat
        self.name = f"LAMMPS, {beads} beads" + (", NVT" if thermostat == "nvt" else "")
        # D_t = kT damping/m_rod
        self.physical_step = TIME_STEP * DAMPING / self.diameter**2 if thermostat == "langevin" else None

    def prepare(self, start, folder):
        """Writes a data file: each rod a molecule of equally spaced beads, the first and last L apart."""
        name = f"lammps-{self.thermostat}-{self.beads}-{start.phi}-{start.count}"
        along = numpy.linspace(-0.5 * LENGTH, 0.5 * LENGTH, self.beads)[None, :, None]
        places = self.diameter * (start.centres[:, None] + along * start.axes[:, None]).reshape(-1, 3)
        edge = self.diameter * start.edge
        images = numpy.floor(places / edge).astype(int)
        molecules = numpy.repeat(numpy.arange(1, start.count + 1), self.beads)
        with open(folder / f"{name}.data", "w") as file:
            file.write(f"rods\n\n{len(places)} atoms\n1 atom types\n\n")
            file.writelines(f"0 {edge:.17g} {axis}lo {axis}hi\n" for axis in "xyz")
            file.write(f"\nMasses\n\n1 {1 / self.beads:.17g}\n\nAtoms # molecular\n\n")
            for number, (molecule, place, image) in enumerate(zip(molecules, places - images * edge, images), start=1):
                file.write(f"{number} {molecule} 1 {place[0]:.9g} {place[1]:.9g} {place[2]:.9g} "
                           f"{image[0]} {image[1]} {image[2]}\n")
        return name

    def session(self, name, number, threads, seconds, folder):
        log = f"{name}.{number}.log"
        first = 0 if (folder / f"{name}.restart").exists() else 1
        command = ["lmp", "-in", HERE / "in.rods", "-log", "none"]
        for word, value in (("first", first), ("name", name), ("session", number), ("beads", self.beads),
                            ("thermostat", self.thermostat), ("step", TIME_STEP), ("seconds", seconds),
                            ("damping", DAMPING if self.thermostat == "langevin" else DAMPING_OF_NVT)):
            command += ["-var", word, value]
        if threads > 1:
            command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", threads] + command
        call(command, log, folder)
        text = (folder / log).read_text()
        loop = re.search(r"Loop time of (\S+) on \d+ procs for (\d+) steps", text)
        share = re.search(r"([\d.]+)% CPU use with", text)
        if not loop or not share:
            sys.exit(f"compare.py: no times in {folder / log}")
        wall = float(loop[1])
        rows = numpy.loadtxt(folder / f"{name}.{number}.series", ndmin=2)
        return Session(int(loop[2]), wall, wall * threads * float(share[1]) / 100, rows[:, 1] if rows.size else rows)


def effective_diameter():
    """Barker and Henderson's diameter of the WCA potential at kT = epsilon, in sigma."""
    distances = numpy.linspace(0.3, 2 ** (1 / 6), 100001)  # no two beads come closer than 0.3
    energies = 4 * (distances**-12 - distances**-6) + 1
    missing = 1 - numpy.exp(-energies)
    return 0.3 + float(numpy.sum(0.5 * (missing[1:] + missing[:-1]) * numpy.diff(distances)))


def settled(jostle, phi, count, seconds, folder):
    """A start near equilibrium: a run of slightly fatter rods, so that these rods have room."""
    import h5py

    volume = count * math.pi * (1 / 6 + LENGTH / 4)
    edge = (volume / phi) ** (1 / 3)
    name = f"settled-{phi}"
    (folder / f"{name}.toml").write_text(SCENE.format(
        edge=edge, count=count, length=LENGTH, diameter=FATTER, step=f"rms_step = {RMS_STEP}", trajectory_every=100,
        start='start = "random"'))
    call([jostle, "run", f"{name}.toml", "--out", name, "--quiet", "--walltime", f"0:00:{math.ceil(seconds):02d}"],
         f"{name}.log", folder, 1, (STOPPED_EARLY,))
    with h5py.File(folder / name / "trajectory.h5", "r") as file:
        rods = file["particles/rods"]
        if len(rods["position/value"]) < 5:
            sys.exit(f"compare.py: {folder / name} came to too few steps in {seconds} s: use fewer rods (--count)")
        return Start(phi, edge, rods["position/value"][-1].astype(float), rods["orientation/value"][-1].astype(float))


def standard_error(values):
    """Of the mean of a correlated series: the largest that pairwise blocking gives; None if it is too short."""
    errors = []
    while len(values) >= LEAST_BLOCKS:
        errors.append(float(numpy.std(values, ddof=1)) / math.sqrt(len(values)))
        values = 0.5 * (values[0 : len(values) - 1 : 2] + values[1::2])
    return max(errors, default=None)


def read_reference():
    with open(REFERENCE, newline="") as file:
        return {round(float(row["phi"]), 4): float(row["Z"]) for row in csv.DictReader(file)
                if row["start"] == "isotropic" and float(row["L_over_D"]) == LENGTH}


@dataclasses.dataclass
class Plan:
    """Seconds of each part, and how often the programs take turns."""

    settle: int
    warm: int
    precise: int  # a session that Z is taken from: smaller box, one thread
    timed: int  # a session for time alone
    rounds: int


QUICK = Plan(settle=10, warm=2, precise=5, timed=2, rounds=1)
FULL = Plan(settle=20, warm=6, precise=40, timed=3, rounds=2)


def measure(programs, start, threads_and_seconds, plan, folder):
    """Runs all programs from one start, in turns; {(program, threads): sessions}."""
    names = {program: program.prepare(start, folder) for program in programs}
    sessions, number = {}, 0
    for program in programs:
        program.session(names[program], number, 1, plan.warm, folder)
    for _ in range(plan.rounds):
        for threads, seconds in threads_and_seconds:
            number += 1
            for program in programs:
                if threads > program.most_threads:
                    continue
                done = program.session(names[program], number, threads, seconds, folder)
                sessions.setdefault((program, threads), []).append(done)
    return sessions


def row_of(program, start, threads, sessions):
    steps = sum(session.steps for session in sessions)
    rod_steps = steps * start.count
    return {"program": program.name, "phi": start.phi, "rods": start.count, "threads": threads, "steps": steps,
            "wall_us_per_rod_and_step": 1e6 * sum(session.wall for session in sessions) / rod_steps,
            "cpu_us_per_rod_and_step": 1e6 * sum(session.cpu for session in sessions) / rod_steps}


def compare(programs, jostle, phi, counts, plan, folder, reference):
    """The rows of one volume fraction."""
    small, copies = counts
    start = settled(jostle, phi, small, plan.settle, folder)
    large = start.copied(copies)
    if copies > 1:
        runs = [(start, measure(programs, start, [(1, plan.precise)], plan, folder)),
                (large, measure(programs, large, [(1, plan.timed), (2, plan.timed)], plan, folder))]
    else:
        runs = [(start, measure(programs, start, [(1, plan.precise), (2, plan.timed)], plan, folder))]
    precise = runs[0][1]
    rows = []
    for state, sessions in runs:
        for (program, threads), done in sessions.items():
            row = row_of(program, state, threads, done)
            series = numpy.concatenate([session.Z for session in precise[program, 1]])
            error = standard_error(series)
            if program.physical_step:
                row["cpu_ms_per_rod_and_D2_over_Dt"] = 1e-3 * row["cpu_us_per_rod_and_step"] / program.physical_step
            if error is not None:
                # Steps times rods that a standard error takes do not depend on the size of the box.
                spent = small * sum(session.steps for session in precise[program, 1])
                needed = spent * (error / (PRECISION * reference)) ** 2
                row["cpu_s_to_1_per_cent"] = 1e-6 * needed * row["cpu_us_per_rod_and_step"]
                row.update(Z=float(series.mean()), standard_error=error)
            row.update(rods_of_Z=small, reference_Z=reference, effective_diameter=program.diameter,
                       deviation_per_cent=100 * (series.mean() / reference - 1))
            rows.append(row)
    return rows


COSTS = ("cpu_us_per_rod_and_step", "cpu_ms_per_rod_and_D2_over_Dt", "cpu_s_to_1_per_cent")
COLUMNS = ("program", "phi", "rods", "threads", "steps", "wall_us_per_rod_and_step", *COSTS,
           *(f"{cost}_over_jostle" for cost in COSTS), "Z", "standard_error", "rods_of_Z", "reference_Z",
           "deviation_per_cent", "effective_diameter")
HEADINGS = {"program": "program", "phi": "phi", "rods": "rods", "threads": "threads",
            "wall_us_per_rod_and_step": "wall/step", COSTS[0]: "CPU/step", f"{COSTS[0]}_over_jostle": "ratio",
            COSTS[1]: "CPU/(D2/D_t)", f"{COSTS[1]}_over_jostle": "ratio ", COSTS[2]: "CPU to 1 %",
            f"{COSTS[2]}_over_jostle": "ratio  ", "Z": "Z", "standard_error": "error", "deviation_per_cent": "off, %"}


def add_ratios(rows):
    for row in rows:
        same = next(other for other in rows if other["program"] == Jostle.name
                    and all(other[key] == row[key] for key in ("phi", "rods", "threads")))
        for cost in COSTS:
            if cost in row and cost in same:
                row[f"{cost}_over_jostle"] = row[cost] / same[cost]


def text_of(value):
    return "" if value is None else f"{value:.3g}" if isinstance(value, float) else str(value)


def table(rows):
    lines = [list(HEADINGS.values())] + [[text_of(row.get(key)) for key in HEADINGS] for row in rows]
    widths = [max(len(line[k]) for line in lines) for k in range(len(HEADINGS))]
    text = ["| " + " | ".join(cell.rjust(width) for cell, width in zip(line, widths)) + " |" for line in lines]
    text.insert(1, "|" + "|".join("-" * (width + 1) + ":" for width in widths) + "|")
    note = ("\nCPU/step and wall/step: microseconds per rod and step. CPU/(D2/D_t): milliseconds per rod and D^2/D_t of "
            f"physical time. CPU to 1 %: seconds\nuntil the standard error of Z is 1 % of the reference. ratio: to "
            f"jostle. Z and its error are of {rows[0]['rods_of_Z']} rods and one thread.\noff: Z from the Monte Carlo "
            "reference; what the standard error does not cover will not go away with more time.\n")
    return "\n".join(text) + "\n" + note


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--jostle", type=pathlib.Path, default=ROOT / "build" / "release" / "apps" / "jostle")
    parser.add_argument("--quick", action="store_true", help="2000 rods, a few seconds a session")
    parser.add_argument("--count", type=int, help="rods: 125 times those that Z is taken from (default 20000)")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("runs/rivals"), help="folder")
    return parser.parse_args()


def main():
    options = arguments()
    for word, package in (("lmp", "lammps"), ("mpirun", "openmpi-bin")):
        if shutil.which(word) is None:
            print(f"compare.py: skipped: there is no {word} (Debian: apt-get install {package})")
            return
    if importlib.util.find_spec("h5py") is None:
        sys.exit("compare.py: needs h5py (Debian: apt-get install python3-h5py)")
    if not os.access(options.jostle, os.X_OK):
        sys.exit(f"compare.py: there is no program {options.jostle}: build it, or name it with --jostle")
    # Few rods go far in time, and Z needs that more than many: its errors come from rods that turn slowly.
    counts = (2000, 1) if options.quick and not options.count else ((options.count or 20000) // 125, 5)
    folder = options.output.resolve()
    if folder.exists() and any(folder.iterdir()):
        sys.exit(f"compare.py: {folder} is not empty: name another folder with --output")
    folder.mkdir(parents=True, exist_ok=True)
    Lammps.diameter = effective_diameter()
    jostle = options.jostle.resolve()
    monte_carlo = jostle.parents[1] / "benchmarks" / "benchmark_monte_carlo"
    if not os.access(monte_carlo, os.X_OK):
        sys.exit(f"compare.py: there is no program {monte_carlo}: build it with the benchmarks")
    usual = Jostle(jostle)
    programs = [usual, AccurateJostle(usual), MonteCarlo(monte_carlo), Lammps(6, "langevin"), Lammps(11, "langevin"),
                Lammps(11, "nvt")]
    reference = read_reference()
    rows = []
    for phi in VOLUME_FRACTIONS:
        print(f"phi {phi} ...", file=sys.stderr, flush=True)
        rows += compare(programs, jostle, phi, counts, QUICK if options.quick else FULL, folder, reference[phi])
    add_ratios(rows)
    with open(folder / "rivals.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: f"{value:.6g}" if isinstance(value, float) else value for key, value in row.items()}
                         for row in rows)
    text = table(rows)
    (folder / "rivals.md").write_text(text)
    print(text, end="")


if __name__ == "__main__":
    main()
