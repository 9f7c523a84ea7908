"""What stands around the rods of a run: walls, as lines that are drawn, and rods that nothing moves."""

from dataclasses import dataclass

import numpy as np

ROUND = 48            # pieces of a circle
RINGS_OF_A_TUBE = 5


@dataclass(frozen=True)
class Walls:
    """Of a scene's table [walls]."""
    faces: tuple = (False, False, False)  # planes across x, y, z
    container: str = "none"               # "sphere" or "tube"
    axis: int = 0                         # of the tube

    def end(self):
        """(3) whether walls end the box along a direction."""
        across = np.arange(3) != self.axis if self.container == "tube" else np.full(3, self.container == "sphere")
        return np.array(self.faces) | across

    def lines(self, edges):
        """(K, 2, 3) ends of lines that show walls in a box with these edges: outlines of planes, rings of containers."""
        made = [_outline(edges, k, place) for k in range(3) if self.faces[k] for place in (0.0, edges[k])]
        if self.container == "sphere":
            made += [_ring(0.5 * edges, 0.5 * edges[0], axis) for axis in range(3)]
        elif self.container == "tube":
            radius = 0.5 * edges[(self.axis + 1) % 3]
            for place in np.unique(np.linspace(0.0, edges[self.axis], RINGS_OF_A_TUBE)):
                middle = 0.5 * edges
                middle[self.axis] = place
                made.append(_ring(middle, radius, self.axis))
        lines = np.concatenate(made) if made else np.empty((0, 2, 3))
        return lines[(lines[:, 0] != lines[:, 1]).any(axis=1)]  # of a flat box some are points


def walls_of(scene):
    """scene: {table: {key: value}}, with every default."""
    told = scene.get("walls", {})
    if scene.get("box", {}).get("dimensions", 3) == 2:
        return Walls((*told.get("faces", (False, False))[:2], False), told.get("container", "none"), 2)
    return Walls(tuple(told.get("faces", (False,) * 3)), told.get("container", "none"), "xyz".index(told.get("axis", "x")))


def _outline(edges, across, place):
    """The four sides of a face of the box."""
    corners = []
    for shares in ((0, 0), (0, 1), (1, 1), (1, 0)):
        corner = np.insert(np.array(shares, float), across, 0.0) * edges
        corner[across] = place
        corners.append(corner)
    return np.stack((corners, np.roll(corners, -1, axis=0)), axis=1)


def _ring(middle, radius, axis):
    angle = np.linspace(0.0, 2.0 * np.pi, ROUND, endpoint=False)
    around = np.insert(np.stack((np.cos(angle), np.sin(angle)), axis=1), axis, 0.0, axis=1)
    points = middle + radius * around
    return np.stack((points, np.roll(points, -1, axis=0)), axis=1)
