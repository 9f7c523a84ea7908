"""How rods stand to each other: pair correlations, structure factor, clusters."""

from dataclasses import dataclass

import numpy as np

from . import _jostle
from ._arrays import number, whole_number
from ._jostle import refuse
from .frames import frames_of, second_order
from .neighbours import neighbours

MOST_WAVE_VECTORS = 200_000


@dataclass(frozen=True)
class PairCorrelation:
    """Of the centres of rods, each an array over distances.

    distance : middle of the bin, length
    g : density of others at this distance over the mean density; NaN where the box is open in some direction
    g2 : <3 (n_i.n_j)^2 - 1>/2 of the pairs at this distance, in two dimensions <2 (n_i.n_j)^2 - 1>; NaN where there is none
    g_error, g2_error : standard errors of the means over frames, as `jostle.average` gives them; NaN where it gives none
    pairs : pairs found, all frames together
    """
    distance: np.ndarray
    g: np.ndarray
    g2: np.ndarray
    g_error: np.ndarray
    g2_error: np.ndarray
    pairs: np.ndarray


@dataclass(frozen=True)
class StructureFactor:
    """Of the centres of rods, each an array over shells of wave vectors that fit into the box.

    wave_number : mean of the shell, 1/length
    S : <|sum exp(-i q.r)|^2>/N
    error : standard error of the mean over frames, as `jostle.average` gives it; NaN where it gives none
    vectors : wave vectors in the shell, q and -q counted once
    """
    wave_number: np.ndarray
    S: np.ndarray
    error: np.ndarray
    vectors: np.ndarray


@dataclass(frozen=True)
class Clusters:
    """Rods that hang together, frame by frame.

    label : list of (N) arrays: number of the cluster of each rod, in the order of ids
    size : list of arrays: rods in each cluster, by its number; the largest first
    number, largest : (frames) arrays: clusters, and rods in the largest
    mean_size : (frames) array: of the cluster that a rod is in, sum of size^2 over N
    """
    label: list
    size: list
    number: np.ndarray
    largest: np.ndarray
    mean_size: np.ndarray


def pair_correlation(rods, largest=None, bins=100):
    """g(r) and the correlation g2(r) of directions, of the centres of rods.

    Parameters
    ----------
    rods : see `jostle.analysis`
    largest : float, length
        Distance that is looked at; by default three times the length of the longest rod with its caps. At most half of the shortest
        periodic edge.
    bins : int, at least 1

    Returns
    -------
    PairCorrelation

    Raises
    ------
    InputError
        For `largest` and `bins` out of range, fewer than two rods, and whatever is no trajectory.

    Examples
    --------
    Of two parallel rods in a large box, each finds the other:

    >>> pair = {"centre": [[0, 0, 0], [1.05, 0, 0]], "edges": [50, 50, 50]}
    >>> found = pair_correlation(pair, largest=2.0, bins=20)
    >>> found.distance[found.pairs > 0], found.g2[found.pairs > 0]
    (array([1.05]), array([1.]))
    """
    frames = frames_of(rods)
    bins = whole_number("bins", bins, 1)
    largest = _distance(frames, largest)
    edge = np.linspace(0.0, largest, bins + 1)
    dimensions = frames[0].dimensions
    shell = np.pi * np.diff(edge**2) if dimensions == 2 else 4.0 * np.pi / 3.0 * np.diff(edge**3)
    pairs, g, g2 = [], [], []
    for frame in frames:
        count = len(frame)
        if count < 2:
            refuse("rods", f"{count} rod", "has no other", "at least two rods")
        ends = neighbours(frame, largest)
        axis = np.asarray(frame.axis, float)
        cosine = (axis[ends.i] * axis[ends.j]).sum(axis=1)
        place = np.minimum((ends.distance / largest * bins).astype(int), bins - 1)
        found = np.bincount(place, minlength=bins)
        with np.errstate(invalid="ignore"):
            g2.append(np.bincount(place, second_order(cosine, dimensions), minlength=bins) / found)
        expected = (count - 1) / 2 * count / frame.volume * shell
        g.append(found / expected if frame.closed else np.full(bins, np.nan))
        pairs.append(found)
    return PairCorrelation(0.5 * (edge[1:] + edge[:-1]), np.mean(g, axis=0), weighted_mean(g2, pairs), errors_of(g), errors_of(g2),
                           np.sum(pairs, axis=0))


def structure_factor(rods, largest=None):
    """S(q) of the centres of rods, over the wave vectors that fit into the box.

    Parameters
    ----------
    rods : see `jostle.analysis`; the box periodic in all directions
    largest : float, 1/length
        Wave number that is looked at; by default 4 pi/D, or less: so that there are no more than 200,000 wave vectors.

    Returns
    -------
    StructureFactor
        Shells are as wide as the smallest wave number of the box.

    Raises
    ------
    InputError
        For an open box, `largest` out of range, and whatever is no trajectory.

    Examples
    --------
    Rods in a row with distance 1 make a peak at 2 pi:

    >>> row = {"centre": [[x, 0.5, 0.5] for x in range(8)], "edges": [8, 0.9, 0.9]}
    >>> found = structure_factor(row, largest=6.4)
    >>> found.wave_number.round(2), found.S.round(6)
    (array([0.79, 1.57, 2.36, 3.14, 3.93, 4.71, 5.5 , 6.28]), array([0., 0., 0., 0., 0., 0., 0., 8.]))
    """
    frames = frames_of(rods)
    edges = np.asarray(frames[0].edges, float)
    width = 2.0 * np.pi / edges.max()
    flat = frames[0].dimensions == 2
    most = (MOST_WAVE_VECTORS * (8.0 * np.pi if flat else 12.0 * np.pi**2) / frames[0].volume)**(1.0 / frames[0].dimensions)
    if largest is None:
        largest = max(width, min(4.0 * np.pi / float(np.mean(frames[0].diameter)), most))
    largest = number("largest", largest)
    if not width <= largest <= 4.0 * most + 4.0 * width:
        refuse("largest", f"{largest:g}", "is outside the allowed range", f"{width:.4g} (the smallest wave number of the box) to "
               f"{4.0 * most + 4.0 * width:.4g}")
    shells = int(largest / width * (1.0 + 1e-9) + 0.5)
    rows, counts, numbers = [], [], []
    for frame in frames:
        if not frame.closed:
            refuse("rods", "", "are in a box that is open: no wave vectors belong to it", "a box that is periodic in all directions")
        if frame.offset != 0.0:
            refuse("rods", "", "are in a box that a flow has sheared: its wave vectors lie obliquely", "a box that is rectangular")
        size, power = _powers(frame, largest)
        shell = np.minimum((size / width + 0.5).astype(int), shells) - 1
        with np.errstate(invalid="ignore"):
            counts.append(np.bincount(shell, minlength=shells))
            numbers.append(np.bincount(shell, size, minlength=shells) / counts[-1])
            rows.append(np.bincount(shell, power, minlength=shells) / counts[-1])
    there = counts[0] > 0
    return StructureFactor(weighted_mean(numbers, counts)[there], weighted_mean(rows, counts)[there], errors_of(rows)[there], counts[0][there])


def clusters(rods, gap):
    """Clusters of rods whose surfaces are no farther apart than `gap`, through periodic faces, too.

    Parameters
    ----------
    rods : see `jostle.analysis`
    gap : float, length, >= 0

    Returns
    -------
    Clusters

    Raises
    ------
    InputError
        For a negative gap, and whatever is no trajectory.

    Examples
    --------
    Three spheres in a row, two of which are near:

    >>> found = clusters({"centre": [[0, 0, 0], [1.05, 0, 0], [3, 0, 0]], "edges": [9, 9, 9]}, gap=0.1)
    >>> found.size[0], found.label[0], found.largest
    (array([2, 1]), array([0, 0, 1]), array([2]))
    """
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    gap = number("gap", gap)
    if gap < 0:
        refuse("gap", f"{gap:g}", "is negative", "at least 0")
    label, size = [], []
    for frame in frames_of(rods):
        count = len(frame)
        i, j = _touching(frame, gap)
        found, of_rod = connected_components(coo_matrix((np.ones(len(i), bool), (i, j)), (count, count)), directed=False)
        sizes = np.bincount(of_rod, minlength=found)
        order = np.argsort(-sizes, kind="stable")
        label.append(np.argsort(order)[of_rod])
        size.append(sizes[order])
    return Clusters(label, size, *(np.array(row) for row in (
        [len(sizes) for sizes in size], [sizes.max(initial=0) for sizes in size],
        [(sizes**2).sum() / max(sizes.sum(), 1) for sizes in size])))


def _distance(frames, largest):
    longest = max(float((frame.length + frame.diameter).max(initial=0.0)) for frame in frames)
    half = 0.5 * min((edge for frame in frames for edge, along in zip(frame.edges, frame.periodic) if along), default=np.inf)
    if largest is None:
        return min(3.0 * longest, half)
    largest = number("largest", largest)
    if not 0 < largest <= half * (1 + 1e-9):
        refuse("largest", f"{largest:g}", "is outside the allowed range", f"above 0 and at most half of the shortest edge, {half:g}")
    return largest


def _powers(frame, largest):
    """Sizes of the wave vectors up to the largest, q or -q, and |sum exp(-i q.r)|^2/N of each."""
    along = np.argsort(-np.asarray(frame.edges, float))  # the longest edge, which has most wave vectors, row by row
    edges = np.asarray(frame.edges, float)[along]
    most = np.floor(largest * (1.0 + 1e-9) * edges / (2.0 * np.pi)).astype(int)
    edges[edges == 0.0] = 1.0  # of a flat box: no wave vector has a part along z
    turns = np.asarray(frame.centre, float)[:, along] / edges
    y, z = (np.arange(-m, m + 1) * 2.0 * np.pi / edge for m, edge in zip(most[1:], edges[1:]))
    across = [np.exp(-2j * np.pi * np.outer(np.arange(-most[a], most[a] + 1), turns[:, a])) for a in (1, 2)]
    sizes, powers = [], []
    for row in range(most[0] + 1):
        size = np.sqrt((row * 2.0 * np.pi / edges[0])**2 + y[:, None]**2 + z**2)
        power = abs((across[0] * np.exp(-2j * np.pi * row * turns[:, 0])) @ across[1].T)**2 / len(frame)
        wanted = size <= largest * (1.0 + 1e-9)
        if row == 0:  # of q and -q one
            wanted &= (y[:, None] > 0) | ((y[:, None] == 0) & (z > 0))
        sizes.append(size[wanted])
        powers.append(power[wanted])
    return np.concatenate(sizes), np.concatenate(powers)


def _touching(frame, gap):
    """Rows (pairs) of rods whose surfaces are no farther apart than the gap; a pair may come by several images."""
    length, diameter = np.asarray(frame.length, float), np.asarray(frame.diameter, float)
    if len(length) == 0:
        return np.empty((2, 0), int)
    near = neighbours(frame, float((length + diameter).max()) + gap)
    half = 0.5 * length[:, None] * np.asarray(frame.axis, float)
    reach = 0.5 * (length + diameter)
    near = near.where(near.distance <= reach[near.i] + reach[near.j] + gap)
    first, second = half[near.i], half[near.j]
    apart = _jostle.segment_distance(-first, first, near.step - second, near.step + second)[0]
    touch = apart <= 0.5 * (diameter[near.i] + diameter[near.j]) + gap
    return near.i[touch], near.j[touch]


def weighted_mean(rows, weights):
    """Mean over frames of rows (frames, columns), weighted; NaN where no frame has one."""
    there = np.isfinite(rows)
    weight = np.where(there, weights, 0.0)
    with np.errstate(invalid="ignore"):
        return (weight * np.where(there, rows, 0.0)).sum(axis=0) / weight.sum(axis=0)


def errors_of(rows):
    """Standard errors of the means over frames, one a column; NaN where they are too few."""
    errors = []
    for column in np.transpose(rows):
        found = _jostle.average(np.ascontiguousarray(column)) if np.isfinite(column).all() else {"standard_error": None}
        errors.append(np.nan if found["standard_error"] is None else found["standard_error"])
    return np.array(errors)
