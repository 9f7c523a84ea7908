"""Pairs of centres that are near each other, through periodic faces."""

from dataclasses import dataclass

import numpy as np

from ._jostle import refuse

ROWS_AT_ONCE = 20_000
MOST_EDGES = 20  # that are searched for images


@dataclass
class Pairs:
    """i < j, rows of the rods; step (pairs, 3): from the centre of i to that of j, in the image at hand; distance (pairs).

    A pair comes as often as j has images within reach; no rod is paired with an image of its own.
    """
    i: np.ndarray
    j: np.ndarray
    step: np.ndarray
    distance: np.ndarray

    def where(self, wanted):
        return Pairs(self.i[wanted], self.j[wanted], self.step[wanted], self.distance[wanted])


def neighbours(frame, reach):
    """Pairs of a frame whose centres are no farther apart than `reach`, by a k-d tree of the centres and of their images near by."""
    from scipy.spatial import cKDTree
    edges, periodic = np.asarray(frame.edges, float), np.asarray(frame.periodic, bool)
    centre = np.asarray(frame.centre, float)
    around = np.where(periodic, edges, np.inf)
    centre = np.where(periodic, centre - edges * np.floor(centre / around), centre)
    if not (reach <= MOST_EDGES * np.where(periodic, edges, np.inf)).all():
        refuse("rods", f"a reach of {reach:g}", "goes through the box too often", f"at most {MOST_EDGES} of its edges")
    points, rod = centre, np.arange(len(centre))
    for along in [k for k in (1, 0, 2) if periodic[k]]:  # across y first: copies there are displaced along x
        images = int(np.ceil(reach / edges[along]))
        moved, of_rod = [points], [rod]
        for k in [k for k in range(-images, images + 1) if k != 0]:
            place = points[:, along] + k * edges[along]
            near = (place >= -reach) & (place <= edges[along] + reach)
            copies = points[near].copy()
            copies[:, along] = place[near]
            if along == 1 and frame.offset != 0.0:
                copies[:, 0] = np.mod(copies[:, 0] + k * frame.offset, edges[0])
            moved.append(copies)
            of_rod.append(rod[near])
        points, rod = np.concatenate(moved), np.concatenate(of_rod)
    tree = cKDTree(points)
    found = [_of_rows(tree, rod, centre, begin, reach) for begin in range(0, len(centre), ROWS_AT_ONCE)]
    i, j, image = (np.concatenate(column) for column in zip(*found)) if found else np.empty((3, 0), int)
    step = points[image] - centre[i]
    return Pairs(i, j, step, np.linalg.norm(step, axis=1))


def _of_rows(tree, rod, centre, begin, reach):
    from scipy.spatial import cKDTree
    some = cKDTree(centre[begin:begin + ROWS_AT_ONCE])
    pairs = some.sparse_distance_matrix(tree, reach, output_type="ndarray")
    i, image = pairs["i"].astype(int) + begin, pairs["j"].astype(int)
    once = i < rod[image]
    return i[once], rod[image[once]], image[once]
