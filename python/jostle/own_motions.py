"""Motions of your own, as the extension asks for them."""

import numpy as np

from ._arrays import with_shape
from .step_report import Clock


def asking(core, motion):
    """The function that the extension calls for the (N, 6) velocities of a step. It holds `core`, never what holds the core's owner."""
    def ask(step, time_step):
        rods = core.rods()
        return _velocities(motion(rods, Clock(step, step * time_step, time_step)), len(rods))

    return ask


def _velocities(given, count):
    """What a motion returned, as (N, 6)."""
    both = isinstance(given, tuple) and len(given) == 2
    linear = with_shape("velocities of a motion", given[0] if both else given, (count, 3))
    angular = with_shape("angular velocities of a motion", given[1] if both else np.zeros((count, 3)), (count, 3))
    return np.hstack((linear, angular))
