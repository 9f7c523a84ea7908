#!/usr/bin/env python3
"""Z and order S of hard spherocylinders by Metropolis Monte Carlo, with errors that know how slowly S moves: rows of monte_carlo.csv

    python3 studies/reference/monte_carlo.py FOLDER              runs the states of L/D = 5 (two processors, an hour and a half), and prints their rows
    python3 studies/reference/monte_carlo.py FOLDER --evaluate   prints the rows of what is there

monte_carlo.cpp, compiled into FOLDER, moves the rods. "expanded" starts from aligned rods at the highest density and goes down, "compressed" at the lowest and
goes up; others start from aligned rods at one density. Each chain leaves its measurements in FOLDER.
"""

import argparse
import collections
import math
import pathlib
import subprocess
import sys

import numpy

LENGTH, COUNT = 5, 1000
SWEEPS_APART, BIN_WIDTH = 50, 0.0025  # as in monte_carlo.cpp
COLUMNS_BEFORE_COUNTS = 2             # volume fraction, S
# (volume fraction, thousands of sweeps to equilibrate, and to measure), one after the other.
CHAINS = {
    "expanded": [(0.50, 200, 1000), (0.48, 100, 1000), (0.46, 100, 1000), (0.44, 100, 1000), (0.42, 150, 1000)],
    "compressed": [(0.42, 300, 1100), (0.44, 200, 900), (0.46, 200, 1900), (0.48, 100, 1000)],
    "aligned_0.46": [(0.46, 60, 1500)],
    "aligned_0.42": [(0.42, 200, 1100)],
}


def correlation_time(series):
    """Integrated correlation time in rows, 1/2 for white noise: summed up to five times itself (Sokal)."""
    deviation = series - series.mean()
    spectrum = numpy.abs(numpy.fft.rfft(deviation, 2 * len(series))) ** 2
    correlation = numpy.fft.irfft(spectrum)[: len(series)] / spectrum.mean()
    correlation /= correlation[0]
    time = 0.5
    for lag in range(1, len(series)):
        time += correlation[lag]
        if lag > 5 * time:
            break
    return time


def weights_of_bins(bins):
    """What the counts of the bins are to be multiplied with for Z - 1: the density of touching pairs at no compression, over 3 N. A parabola through the
    bins by least squares; of each bin it has the mean."""
    left = numpy.arange(bins) * BIN_WIDTH
    right = left + BIN_WIDTH
    means = numpy.column_stack([(right**k - left**k) / (k * BIN_WIDTH) for k in (1, 2, 3)])
    return numpy.linalg.pinv(means)[0] / (BIN_WIDTH * 3 * COUNT)


def mean_and_error(columns, slowest):
    """Means of the columns of one run, and their standard errors from blocks of four correlation times of the slowest: at most 40 blocks, at least 4."""
    blocks = int(min(40, max(4, len(columns) / (4 * slowest))))
    means = numpy.array([block.mean(axis=0) for block in numpy.array_split(columns, blocks)])
    return columns.mean(axis=0), means.std(axis=0, ddof=1) / math.sqrt(blocks)


def build(folder):
    """The program, compiled from monte_carlo.cpp."""
    program, source = folder / "monte_carlo", pathlib.Path(__file__).resolve().with_suffix(".cpp")
    subprocess.run(["g++", "-std=c++20", "-O3", "-march=native", "-fopenmp-simd", "-ffast-math", "-isystem", "/usr/include/eigen3", source, "-o", program],
                   check=True)
    return program


def measurements(table):
    """(rows, 2): Z and S of each measurement of one density."""
    return numpy.column_stack([1 + table[:, COLUMNS_BEFORE_COUNTS:] @ weights_of_bins(table.shape[1] - COLUMNS_BEFORE_COUNTS), table[:, 1]])


def evaluate(folder):
    rows = collections.defaultdict(list)
    for name in CHAINS:
        file = folder / f"{name}.txt"
        if not file.exists():
            continue
        table = numpy.atleast_2d(numpy.loadtxt(file))
        for phi in sorted(set(table[:, 0])):
            run = measurements(table[table[:, 0] == phi])
            slowest = correlation_time(run[:, 1])
            (mean_Z, mean_S), (error_Z, error_S) = mean_and_error(run, slowest)
            print(f"# {name} {phi:.2f}: Z {mean_Z:.4f} +- {error_Z:.4f}, S {mean_S:.4f} +- {error_S:.4f}, {len(run) * SWEEPS_APART} sweeps, "
                  f"S correlated over {slowest * SWEEPS_APART:.0f}")
            rows[phi].append((mean_Z, error_Z, mean_S, error_S, len(run) * SWEEPS_APART))
    print("L_over_D,phi,N,start,Z,Z_err,P_star,S,S_err,sweeps")
    for phi, runs in sorted(rows.items()):
        Z, Z_error, S, S_error, sweeps = numpy.array(runs).T
        share = sweeps / sweeps.sum()
        Z, S = share @ Z, share @ S
        Z_error, S_error = (math.sqrt(share**2 @ error**2) for error in (Z_error, S_error))
        print(f"{LENGTH},{phi:g},{COUNT},aligned,{Z:.4f},{Z_error:.4f},{Z * phi:.5f},{S:.4f},{S_error:.4f},{sweeps.sum():.0f}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    parser.add_argument("--evaluate", action="store_true")
    arguments = parser.parse_args()
    folder = arguments.folder
    if not arguments.evaluate:
        folder.mkdir(parents=True, exist_ok=True)
        program = build(folder)
        running = []
        for seed, (name, chain) in enumerate(CHAINS.items(), 1):
            states = "".join(f"{phi} {1000 * equilibration} {1000 * production} {folder / name}_{phi:.2f}.rods\n" for phi, equilibration, production in chain)
            process = subprocess.Popen([program, str(LENGTH), str(COUNT), str(seed)], stdin=subprocess.PIPE, text=True,
                                       stdout=(folder / f"{name}.txt").open("w"))
            process.stdin.write(states)
            process.stdin.close()
            running.append(process)
        if any(process.wait() for process in running):
            sys.exit("monte_carlo.py: a run has failed")
    evaluate(folder)


if __name__ == "__main__":
    main()
