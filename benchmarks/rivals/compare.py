#!/usr/bin/python3
"""Time per rod and step of jostle and of what one would use instead, in turns on the same machine.

    benchmarks/rivals/compare.py [--build DIR] [--count N] [--quick] [--output FILE.csv]

The rival is LAMMPS (Debian's package lammps) with rods of L/D = 5 as 6 or 11 rigid WCA beads; README.md says how the
two are made comparable. Without LAMMPS it says so and ends with status 0.
"""

import argparse
import csv
import io
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
LENGTH = 5.0
RMS_STEP = 0.03  # of jostle, in D
DAMPING_TIME = 0.1  # of LAMMPS, in sqrt(m_bead D^2/kT)
TIME_STEP = 0.005  # of LAMMPS, in the same unit
SETTLED = 2000  # rods brought to rest; larger systems are copies side by side

SCENE = """seed = 1
[box]
volume_fraction = {phi}
[rods]
count = {count}
length = {length}
start = "random"
[time]
rms_step = {rms}
equilibration = 0.0
production = 2.0
[output]
trajectory_every = 50
"""


def run(command, folder, threads=1):
    """What a command prints; ends the program where it fails."""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OMPI_ALLOW_RUN_AS_ROOT="1",
                       OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1")
    done = subprocess.run([str(word) for word in command], cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"compare.py: {command[0]} failed with status {done.returncode}:\n{(done.stdout + done.stderr)[-2000:]}")
    return done.stdout


def settled_rods(jostle, phi, folder):
    """Box edge, centres and axes of isotropic rods that do not overlap."""
    name = f"settled-{phi}"
    scene = SCENE.format(phi=phi, count=SETTLED, length=LENGTH, rms=RMS_STEP)
    (Path(folder) / f"{name}.toml").write_text(scene)
    run([jostle, "run", f"{name}.toml", "--out", name, "--quiet"], folder)
    with h5py.File(Path(folder) / name / "trajectory.h5", "r") as file:
        rods = file["particles/rods"]
        edges = rods["box/edges"]
        edge = np.ravel(edges["value"][-1] if isinstance(edges, h5py.Group) else edges[()])[0]
        return float(edge), rods["position/value"][-1], rods["orientation/value"][-1]


def write_beads(path, edge, centres, axes, copies, beads):
    """A LAMMPS data file: rods in copies of the box side by side along x, each a molecule of equally spaced beads."""
    along = np.linspace(-0.5 * LENGTH, 0.5 * LENGTH, beads)
    rods = np.concatenate([centres + [k * edge, 0.0, 0.0] for k in range(copies)])
    points = (rods[:, None, :] + along[None, :, None] * np.tile(axes, (copies, 1))[:, None, :]).reshape(-1, 3)
    box = np.array([copies * edge, edge, edge])
    image = np.floor(points / box).astype(int)
    points -= image * box
    molecule = np.repeat(np.arange(1, len(rods) + 1), beads)
    with open(path, "w") as file:
        file.write(f"rods\n\n{len(points)} atoms\n1 atom types\n\n")
        for axis, length in zip("xyz", box):
            file.write(f"0.0 {length:.17g} {axis}lo {axis}hi\n")
        file.write("\nMasses\n\n1 1.0\n\nAtoms # molecular\n\n")
        for number, (rod, point, shift) in enumerate(zip(molecule, points, image), start=1):
            file.write(f"{number} {rod} 1 {point[0]:.9g} {point[1]:.9g} {point[2]:.9g} {shift[0]} {shift[1]} {shift[2]}\n")


def seconds_of_lammps(data, steps, processes, folder):
    """Seconds a step, from the last of the runs of in.rods."""
    command = ["lmp", "-in", HERE / "in.rods", "-log", "none"]
    for name, value in (("data", data), ("damp", DAMPING_TIME), ("step", TIME_STEP),
                        ("warm", max(steps // 2, 200)), ("steps", steps), ("seed", 12345)):
        command += ["-var", name, value]
    if processes > 1:
        command = ["mpirun", "--oversubscribe", "-np", processes] + command
    loops = re.findall(r"Loop time of (\S+) on \d+ procs for (\d+) steps", run(command, folder))
    return float(loops[-1][0]) / int(loops[-1][1])


def seconds_of_jostle(benchmark, phi, count, steps, threads, folder):
    words = ["--state", f"rods/{phi:.2f}", "--count", count, "--steps", steps, "--threads", threads]
    row = next(csv.DictReader(io.StringIO(run([benchmark] + words, folder, threads))))
    return 1e-9 * float(row["step_ns"]) * int(row["bodies"])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--build", default=HERE.parents[1] / "build" / "release", type=Path, help="folder of the build")
    parser.add_argument("--count", default=20000, type=int, help="rods, a multiple of 2000 (default 20000)")
    parser.add_argument("--quick", action="store_true", help="2000 rods, few steps: a trial of this program")
    parser.add_argument("--output", type=Path, help="write the table here as CSV too")
    options = parser.parse_args()
    if shutil.which("lmp") is None:
        print("compare.py: skipped, there is no LAMMPS here (command lmp; Debian: apt-get install lammps)")
        return
    count = SETTLED if options.quick else options.count
    if count < SETTLED or count % SETTLED != 0:
        parser.error(f"--count must be a multiple of {SETTLED}")
    steps, rounds = (200, 1) if options.quick else (400, 3)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        for phi in (0.1, 0.3):
            edge, centres, axes = settled_rods(options.build / "apps" / "jostle", phi, folder)
            programs = {"jostle": RMS_STEP**2 / 2}  # one step in D^2/D_t
            for beads in (6, 11):
                write_beads(Path(folder) / f"{phi}-{beads}.data", edge, centres, axes, count // SETTLED, beads)
                programs[f"LAMMPS, {beads} beads"] = TIME_STEP * DAMPING_TIME / beads  # D_t = kT damping time/m
            for threads in (1, 2):
                seconds = {name: [] for name in programs}
                for _ in range(rounds):
                    seconds["jostle"].append(seconds_of_jostle(options.build / "benchmarks" / "benchmark_step", phi,
                                                               count, steps // 4, threads, folder))
                    for beads in (6, 11):
                        seconds[f"LAMMPS, {beads} beads"].append(
                            seconds_of_lammps(f"{phi}-{beads}.data", steps, threads, folder))
                for name, physical in programs.items():
                    step = statistics.median(seconds[name])
                    rows.append({"program": name, "phi": phi, "rods": count, "threads": threads,
                                 "ns_per_rod_and_step": round(1e9 * step / count, 1),
                                 "us_per_rod_and_D2_over_Dt": round(1e6 * step / count / physical, 1)})
                    print(*(f"{key}={value}" for key, value in rows[-1].items()), sep="  ", flush=True)
    for row in rows:
        own = next(r for r in rows if r["program"] == "jostle" and r["phi"] == row["phi"] and r["threads"] == row["threads"])
        row["time_against_jostle_per_step"] = round(row["ns_per_rod_and_step"] / own["ns_per_rod_and_step"], 2)
        row["time_against_jostle_per_physical_time"] = round(
            row["us_per_rod_and_D2_over_Dt"] / own["us_per_rod_and_D2_over_Dt"], 2)
    if options.output:
        with open(options.output, "w", newline="") as file:
            writer = csv.DictWriter(file, rows[0].keys())
            writer.writeheader()
            writer.writerows(rows)
    for row in rows:
        print(",".join(str(value) for value in row.values()))


if __name__ == "__main__":
    main()
