"""What the trajectories of rods tell: how they move, how they stand to each other, which hang together.

    mean_square_displacements   in all, along and across the rods
    orientation_memory          <n(0).n(t)>, and of the second Legendre polynomial
    pair_correlation            g(r) and g2(r)
    structure_factor            S(q)
    clusters                    rods that touch, or nearly
    frames_of                   the frames of what these take, to choose among them

All take `rods`: the folder of a run; a trajectory file (trajectory.h5, .journal, .gsd, or what `Simulation.record` left); what
`jostle.load` returned, its `trajectory`, or some of its frames (`run.trajectory[50:]` leaves equilibration out); a Simulation, as it
stands; or a dict of arrays:

    centre (T, N, 3), or (N, 3) of one time, length; unwrapped where rods are followed in time
    edges (3) or (T, 3), length; the lowest corner of the box is the origin
    axis, unit vectors; length, diameter: (T, N), or what broadcasts to it; else spheres of diameter 1
    time (T), else 0, 1, 2, ...; periodic (3), else all True

They need SciPy, and h5py or gsd for files.
"""

from .displacements import Displacements, Memory, mean_square_displacements, orientation_memory
from .frames import frames_of
from .structure import Clusters, PairCorrelation, StructureFactor, clusters, pair_correlation, structure_factor

__all__ = ["Clusters", "Displacements", "Memory", "PairCorrelation", "StructureFactor", "clusters", "frames_of", "mean_square_displacements",
           "orientation_memory", "pair_correlation", "structure_factor"]
