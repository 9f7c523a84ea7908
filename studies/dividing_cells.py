"""Growing, dividing, swimming cells

The second application of the paper: 100 cells in a periodic box of (100 um)^3 lengthen by 1 um/s from 2.5 to 6 um and divide, all at once, every 3.5 s; they
swim at U_0. What collision pressure do they make, and do they cluster? D = 1 um, water at room temperature, 1/D_R = 1.887 s.
"""

import numpy

import figures
from clusters import clusters_of, counts_in_cells, rods_of_frame
from report import with_error
from runs import Run

SPEEDS = (0.0, 0.5, 1.0, 2.0)  # um/s
EDGE, FOUNDERS, DIVISION_TIME = 100.0, 100, 3.5  # um, s
TIME_STEP = 5e-4  # s; the paper's is 1e-4, and its scheme needs it
END, QUICK_END = 35.1, 21.06  # s: 10 and 6 generations
FRAME_EVERY = 0.78  # s
MOMENTS = (24.96, 35.1)  # s, two of the frames: t D_R = 13.2 and 18.6, as in the paper
RELAXATION = 1.8873  # 1/D_R, s
DILUTE = 8  # divisions; after the ninth the volume fraction is above 0.1
SLAB = 5.0  # um, of the pictures
CELL = 10.0  # um, in which cells are counted


def runs(quick):
    return [Run(name=f"U{speed:g}",
                scene={"seed": 1, "units": {"system": "micro"}, "box": {"edges": (EDGE, EDGE, EDGE)},
                       "rods": {"count": FOUNDERS, "length": 2.5, "diameter": 1.0},
                       "fluid": {"viscosity": 1e-3, "kT": 0.00411}, "mobility": {"model": "slender_body"},
                       "motion": {"self_propulsion": speed},
                       "growth": {"rate": 1.0, "division_length": 6.0},
                       "time": {"step": TIME_STEP},
                       "output": {"series_every": 20, "trajectory_every": round(FRAME_EVERY / TIME_STEP)}},
                equilibration=0, production=round((QUICK_END if quick else END) / TIME_STEP))
            for speed in (SPEEDS[::3] if quick else SPEEDS)]


class Growth:
    """What a run has shown."""

    def __init__(self, run, moments):
        series = run.series()
        self.run, self.speed = run, run.scene["motion"]["self_propulsion"]
        self.time, self.N, self.phi = series["time"], series["N"], series["phi"]
        self.pressure = series["Z"] - 1.0  # Pi_col/(n kT), each row over 10 ms
        self.overlap = series["max_overlap"].max()
        self.iterations = series["iterations"]
        self.moments = []
        for time in moments:
            frame = rods_of_frame(run, time)
            self.moments.append((time, frame, counts_in_cells(frame, EDGE, CELL), clusters_of(frame, EDGE)))

    def peak(self, generation):
        """The largest pressure in the second after a division."""
        after = self.time - generation * DIVISION_TIME
        return self.pressure[(after > 0.0) & (after < 1.0)].max()

    def of_generation(self, generation):
        """(mean pressure, standard error from seven parts) between two divisions."""
        part = self.pressure[(self.time > generation * DIVISION_TIME) & (self.time <= (generation + 1) * DIVISION_TIME)]
        means = numpy.array([block.mean() for block in numpy.array_split(part, 7)])
        return means.mean(), means.std(ddof=1) / 7**0.5


def evaluate(report, runs_by_name, quick):
    moments = (QUICK_END,) if quick else MOMENTS
    grown = [Growth(run, moments) for run in runs_by_name.values()]
    last = int((QUICK_END if quick else END) / DIVISION_TIME)
    for growth in grown:
        label = f"U_0 = {growth.speed:g} um/s"
        due = FOUNDERS * 2**numpy.floor(growth.time / DIVISION_TIME + 1e-9)
        report.require(f"{label}: rows whose number of cells is not 100 2^generation", numpy.sum(growth.N != due), upper=0)
        report.require(f"{label}: largest overlap, um", growth.overlap, upper=0.1)
        peaks = [growth.peak(generation) for generation in range(1, min(last, DILUTE) + 1)]
        report.require(f"{label}: highest over lowest peak below volume fraction 0.1", max(peaks) / min(peaks), upper=1.5)
    for slower, faster in zip(grown, grown[1:]):
        report.require(f"pressure of the last generation at U_0 = {faster.speed:g} over that at {slower.speed:g} um/s",
                       faster.of_generation(last - 1)[0] / slower.of_generation(last - 1)[0], upper=1.0)
    still, fast = grown[0].moments[-1], grown[-1].moments[-1]
    report.require("variance over mean of the numbers in (10 um)^3, U_0 = 2 um/s over that of cells that do not swim",
                   fast[2] / still[2], upper=0.5)
    tables(report, grown, last)
    draw(report, grown)
    if not quick:
        draw_cells(report, grown)


def tables(report, grown, last):
    report.table("Pi_col/(n kT): largest in the second after each division (mean of 10 ms).",
                 ["U_0, um/s", *(f"{FOUNDERS * 2**g}" for g in range(1, last + 1))],
                 [[f"{growth.speed:g}", *(f"{growth.peak(g):.2f}" for g in range(1, last + 1))] for growth in grown])
    report.table("The same, mean between two divisions.",
                 ["U_0, um/s", *(f"{FOUNDERS * 2**g}" for g in range(1, last))],
                 [[f"{growth.speed:g}", *(with_error(*growth.of_generation(g), 2) for g in range(1, last))]
                  for growth in grown])
    rows = []
    for growth in grown:
        for time, frame, fluctuation, sizes in growth.moments:
            rows.append([f"{growth.speed:g}", f"{time / RELAXATION:.1f}", str(len(frame["id"])),
                         f"{100 * growth.phi[numpy.searchsorted(growth.time, time - 1e-9)]:.2f}", f"{fluctuation:.2f}",
                         f"{len(frame['id']) / len(sizes):.2f}", str(sizes.max())])
    report.table("Clusters: variance over mean of the numbers of cells in (10 um)^3 (1: Poisson's), mean and largest number of cells that "
                 "touch within 0.1 um.",
                 ["U_0, um/s", "t D_R", "cells", "phi, %", "variance over mean", "mean cluster", "largest"], rows)
    report.table("Cost on one thread.", ["U_0, um/s", "steps", "time", "largest overlap, um", "most sweeps a step"],
                 [[f"{growth.speed:g}", str(growth.run.record["steps"]), growth.run.time_taken,
                   f"{growth.overlap:.4f}", f"{growth.iterations.max():.0f}"] for growth in grown])
    report.numbers(["U_0", "time", "N", "phi", "collision_pressure_over_n_kT"],
                   [[growth.speed, *row] for growth in grown
                    for row in zip(growth.time[9::10], growth.N[9::10], growth.phi[9::10], growth.pressure[9::10])])


def draw(report, grown):
    figure, panels = figures.axes(1, 2, size=(9.2, 3.6))
    for number, growth in enumerate(grown):
        panels[0].plot(growth.time / RELAXATION, growth.pressure, linewidth=0.6, color=f"C{number}",
                       label=f"{growth.speed:g} um/s")
    panels[1].plot(grown[0].time / RELAXATION, grown[0].phi, color="black", linewidth=1)
    panels[0].set(ylabel="Pi_col/(n kT)", ylim=(0, None))
    panels[0].legend(fontsize=8, title="U_0", title_fontsize=8)
    panels[1].set(ylabel="volume fraction", yscale="log")
    for panel in panels:
        panel.set_xlabel("t D_R")
    report.figure(figure, "Collision pressure of dividing cells, and their volume fraction.")


def draw_cells(report, grown):
    """A slab of the box at the two moments, slowest and fastest; a colour for every founder's line."""
    chosen = (grown[0], grown[-1])
    figure, panels = figures.axes(2, 2, size=(9.0, 9.4))
    for row, growth in zip(panels, chosen):
        for panel, (time, frame, *_) in zip(row, growth.moments):
            figures.draw_slab(panel, frame["centre"], frame["axis"], frame["length"], frame["id"] % 128, EDGE, SLAB)
            panel.set_title(f"U_0 = {growth.speed:g} um/s, t D_R = {time / RELAXATION:.1f}", fontsize=9)
    report.figure(figure, f"Cells with their centres in a slab of {SLAB:g} um; one colour a founder's line.",
                  name="dividing_cells_pictures")
