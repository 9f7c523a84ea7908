"""How far rods come, and how long they remember their direction."""

from dataclasses import dataclass

import numpy as np

from .frames import lags_of, mean_over_rods, paths_of, second_order


@dataclass(frozen=True)
class Displacements:
    """Mean-square displacements of rods, each an array over times; errors are those of the scatter between rods.

    time : time between the two positions
    total : <|r(t) - r(0)|^2>, length**2
    along : of the part along the rod as it lay at the beginning
    across : of the part across it, both directions together: total = along + across
    total_error, along_error, across_error : standard errors; NaN of a single rod
    """
    time: np.ndarray
    total: np.ndarray
    along: np.ndarray
    across: np.ndarray
    total_error: np.ndarray
    along_error: np.ndarray
    across_error: np.ndarray


@dataclass(frozen=True)
class Memory:
    """How long rods remember their direction, each an array over times.

    time : time between the two directions
    first : <n(0).n(t)>; exp(-2 D_R t) of a free rod, in two dimensions exp(-D_R t)
    second : <3 (n(0).n(t))^2 - 1>/2; exp(-6 D_R t) of a free rod; in two dimensions <2 (n(0).n(t))^2 - 1>, exp(-4 D_R t)
    first_error, second_error : standard errors from the scatter between rods; NaN of a single rod
    """
    time: np.ndarray
    first: np.ndarray
    second: np.ndarray
    first_error: np.ndarray
    second_error: np.ndarray


def mean_square_displacements(rods):
    """Mean-square displacements of rods: in all, along and across their axes.

    Parameters
    ----------
    rods : see `jostle.analysis`; at least two frames

    Returns
    -------
    Displacements

    Raises
    ------
    InputError
        For a single frame, times that do not rise, and whatever is no trajectory.

    Notes
    -----
    A free rod with D_par, D_perp, D_R: with D = (D_par + 2 D_perp)/3 and tau = (1 - exp(-6 D_R t))/(6 D_R),
    along = 2 D t + (4/3)(D_par - D_perp) tau and total = 6 D t; in two dimensions with D = (D_par + D_perp)/2 and
    tau = (1 - exp(-4 D_R t))/(4 D_R), along = 2 D t + (D_par - D_perp) tau and total = 4 D t. Rods are taken for independent in the errors.

    Examples
    --------
    One rod that moves along itself, at speed 2:

    >>> t = np.arange(5.0)
    >>> path = {"centre": np.stack([2 * t, 0 * t, 0 * t], axis=1)[:, None], "axis": [1, 0, 0], "edges": [9, 9, 9], "time": t}
    >>> found = mean_square_displacements(path)
    >>> found.along, found.across
    (array([ 4., 16., 36., 64.]), array([0., 0., 0., 0.]))
    """
    paths = paths_of(rods)
    lags = lags_of(paths.time)
    rows = []
    for earlier, later in zip(lags.earlier, lags.later):
        step = paths.position[later] - paths.position[earlier]
        total = (step**2).sum(axis=2)
        along = (step * paths.axis[earlier]).sum(axis=2)**2
        rows.append([mean_over_rods(part) for part in (total, along, total - along)])
    means, errors = np.array(rows).transpose(2, 1, 0)
    return Displacements(lags.time, *means, *errors)


def orientation_memory(rods):
    """<n(0).n(t)> of the axes of rods, and the same of the second Legendre polynomial, which heads and tails do not matter to.

    Parameters
    ----------
    rods : see `jostle.analysis`; at least two frames

    Returns
    -------
    Memory

    Raises
    ------
    InputError
        For a single frame, times that do not rise, and whatever is no trajectory.

    Examples
    --------
    A rod that turns by a quarter between two frames:

    >>> turning = {"centre": np.zeros((3, 1, 3)), "edges": [9, 9, 9], "axis": np.eye(3)[[0, 1, 0]][:, None]}
    >>> found = orientation_memory(turning)
    >>> found.first, found.second
    (array([0., 1.]), array([-0.5,  1. ]))
    """
    paths = paths_of(rods)
    lags = lags_of(paths.time)
    rows = []
    for earlier, later in zip(lags.earlier, lags.later):
        cosine = (paths.axis[earlier] * paths.axis[later]).sum(axis=2)
        rows.append([mean_over_rods(cosine), mean_over_rods(second_order(cosine, paths.dimensions))])
    means, errors = np.array(rows).transpose(2, 1, 0)
    return Memory(lags.time, *means, *errors)
