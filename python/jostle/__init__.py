"""jostle: collision stress of rods and of rigid bodies of any shape.

    segment_distance        distances of segments
    body_moments, combined  mass and second moment of a body, made of parts
    pair_stress             stress of contacts between rigid bodies of any shape
    contact_stress          the same of a list of contacts, in all and of every body
    collision_stress        stress of rods from their contacts
    orientation_stress      stress that the Brownian rotation of rods carries
    solve_lcp               linear complementarity problems
    Scene, Simulation       what `jostle run` does, step by step
    load                    what `jostle run` left
    average                 mean and standard error of a correlated series
    sweep                   a scene at many values, what `jostle sweep` does
    analysis                displacements, correlations, structure factor, clusters of trajectories

Errors are InputError (a ValueError), StepFailure (a RuntimeError) and DiskError (an OSError). Arguments are converted
from whole numbers and float32; truth values, complex numbers, texts, NaN and infinity are refused.
"""

from . import _waiting_threads  # before OpenMP is loaded
from . import analysis
from ._jostle import DiskError, InputError
from ._jostle import version as __version__
from .bodies import Body, body_moments, combined
from .contact import segment_distance
from .lcp import LcpResult, solve_lcp
from .recording import Recording
from .run import Run, load
from .scene import Scene
from .simulation import Simulation
from .statistics import Average, average
from .step_report import StepFailure, StepReport
from .stress import ContactStress, PairStress, collision_stress, contact_stress, orientation_stress, pair_stress
from .sweeps import Sweep, sweep
from .threads import set_thread_count, thread_count

__all__ = ["Average", "Body", "ContactStress", "DiskError", "InputError", "LcpResult", "PairStress", "Recording", "Run", "Scene",
           "Simulation", "StepFailure", "StepReport", "Sweep", "analysis", "average", "body_moments", "collision_stress", "combined",
           "contact_stress", "load", "orientation_stress", "pair_stress", "segment_distance", "set_thread_count", "solve_lcp",
           "sweep", "thread_count"]
