"""What a step tells of itself."""

from dataclasses import dataclass

import numpy as np


class StepFailure(RuntimeError):
    """Contacts were not resolved, or rods overlap by more than `contact.overlap_limit`; where `jostle run` exits with 3.

    report : StepReport of the step. If it did not converge, no rod has been moved.
    """

    def __init__(self, message, report):
        super().__init__(message, report)  # both, or it could not be brought from one process to another
        self.report = report

    def __str__(self):
        return self.args[0]


@dataclass(frozen=True)
class StepReport:
    """What happened in one step.

    step, time : number of the step, and when it began
    rods, contacts, active_contacts : how many took part; contacts that might touch, and those with a force
    converged, residual, iterations, solves : of the contact problem
    max_overlap : length, largest overlap of two rods when the step began, after growth
    collision_virial, spring_virial : (3, 3) arrays, volume times the stress of collisions, and of springs
    seconds : dict, wall time of the five parts of the step
    """
    step: int
    time: float
    rods: int
    converged: bool
    residual: float
    iterations: int
    solves: int
    contacts: int
    active_contacts: int
    max_overlap: float
    collision_virial: np.ndarray
    spring_virial: np.ndarray
    seconds: dict


@dataclass(frozen=True)
class Clock:
    """Steps done, simulated time, and the length of a step."""
    step: int
    time: float
    time_step: float
