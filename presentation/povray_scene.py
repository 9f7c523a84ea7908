"""The rods of a frame as a scene for POV-Ray: true spherocylinders, light, box and camera."""

import numpy as np

ASPECTS = (4.0 / 3.0, 3.2)        # width over height of the picture, narrowest and widest
FIELD_OF_VIEW = np.radians(24.0)  # small: rods far away look as long as those near by
HEAD = (0.84, 0.37, 0.0)          # vermillion: told from viridis by everybody
FIXED = (0.45, 0.45, 0.45)
EDGE = (0.35, 0.35, 0.35)
WALL = (0.16, 0.2, 0.26)

SETTINGS = """\
// Rods as spherocylinders. Draw again at any size: povray view.pov +W3200 +H{tall} +A0.1
#version 3.7;
global_settings {{ assumed_gamma 1.0 max_trace_level 3 }}
background {{ rgb 1.0 }}
#declare Matte = finish {{ ambient 0.2 diffuse 0.8 specular 0.2 roughness 0.03 }}
#macro Rod(Tail, Head, R, Colour)
  union {{
    cylinder {{ Tail, Head, R }} sphere {{ Tail, R }} sphere {{ Head, R }}
    pigment {{ color srgb Colour }} finish {{ Matte }}
  }}
#end
#macro Ball(Centre, R, Colour) sphere {{ Centre, R pigment {{ color srgb Colour }} finish {{ Matte }} }} #end
#macro Edge(A, B, R, Colour)
  cylinder {{ A, B, R pigment {{ color srgb Colour }} finish {{ ambient 0.6 diffuse 0.3 }} no_shadow }}
#end
"""


def scene(frame, camera, colours, heads, fixed=None):
    """The text of the scene. colours: (N, 3), sRGB in 0..1; heads: whether the end that swims ahead is marked; fixed: a frame of
    rods that nothing moves."""
    parts = [SETTINGS.format(tall=round(3200 / camera.aspect)), camera.text(), lights(frame, camera), box_edges(frame), walls(frame)]
    for ends, diameter, colour in zip(frame.ends(), frame.diameter, colours):
        parts.append(rod(ends, 0.5 * diameter, colour))
    if fixed is not None:
        parts += [rod(ends, 0.5 * diameter, FIXED) for ends, diameter in zip(fixed.ends(), fixed.diameter)]
    if heads:
        parts += [head(*of_rod) for of_rod in zip(frame.ends()[:, 1], frame.axis, frame.length, 0.5 * frame.diameter)]
    return "".join(parts)


def rod(ends, radius, colour):
    tail, front = ends
    if np.array_equal(tail, front):
        return f"Ball({vector(tail)}, {radius:.6g}, {vector(colour)})\n"
    return f"Rod({vector(tail)}, {vector(front)}, {radius:.6g}, {vector(colour)})\n"


def head(end, axis, length, radius):
    """A cap over the front: of a rod all of its cap, of a sphere a smaller one."""
    forward = 0.0 if length > 0.0 else 0.3 * radius
    return f"Ball({vector(end + forward * axis)}, {(1.03 * radius - forward):.6g}, {vector(HEAD)})\n"


def lights(frame, camera):
    """A large lamp up and left behind the viewer, with soft shadows, and a weak one that lightens them."""
    size = camera.distance
    lamp = camera.location + size * (0.7 * camera.up - 0.6 * camera.right)
    side, other = 0.25 * size * camera.right, 0.25 * size * camera.up
    return (f"light_source {{ {vector(lamp)} rgb 1.0 area_light {vector(side)}, {vector(other)}, 4, 4 adaptive 0 }}\n"
            f"light_source {{ {vector(camera.location + size * camera.right)} rgb 0.4 shadowless }}\n")


def extent(frame):
    """(lowest, highest corner) of what is shown: the box where it is periodic or ends at walls, the rods where it is open."""
    ends = np.concatenate((frame.ends().reshape(-1, 3), frame.centre))
    if len(ends) == 0:
        return np.zeros(3), frame.edges
    return np.where(frame.held, 0.0, ends.min(axis=0)), np.where(frame.held, frame.edges, ends.max(axis=0))


def box_edges(frame):
    if not outlined(frame):
        return ""
    low, high = extent(frame)
    corners = [low + np.array(corner) * (high - low) for corner in np.ndindex(2, 2, 2)]
    thickness = thickness_of_edges(low, high)
    text = ""
    for a, first in enumerate(corners):
        for second in corners[a + 1:]:
            if np.count_nonzero(first != second) == 1:
                text += f"Edge({vector(first)}, {vector(second)}, {thickness:.6g}, {vector(EDGE)})\n"
    return text


def outlined(frame):
    """Whether the box is drawn: not around rods in the open, nor around a container."""
    return bool(frame.held.any()) and frame.walls.container == "none"


def thickness_of_edges(low, high):
    return 0.0018 * np.linalg.norm(high - low)


def walls(frame):
    """Outlines of planes, rings of containers."""
    thickness = 1.6 * thickness_of_edges(*extent(frame))
    return "".join(f"Edge({vector(a)}, {vector(b)}, {thickness:.6g}, {vector(WALL)})\n" for a, b in frame.walls.lines(frame.edges))


class Camera:
    """Looks straight onto a flat box. Else it looks from above along the shortest edge's side onto the whole box: the longest edge lies across the picture. With
    `view` "x", "y" or "z" it looks along that axis. `aspect`: of the picture, else as suits the box."""

    def __init__(self, frame, view="", aspect=None):
        view = view or ("z" if frame.dimensions == 2 else "")
        low, high = extent(frame)
        edges = high - low
        shortest, middle, longest = np.argsort(edges, kind="stable")[[0, 1, 2]]
        if edges[longest] < 1.01 * edges[shortest]:
            longest, middle, shortest = 0, 1, 2  # a cube stands with z up
        across, away, up = np.eye(3)[[longest, middle, shortest]]
        if np.dot(np.cross(across, away), up) < 0.0:
            away = -away  # a right-handed set: the picture is no mirror image
        towards = _unit(0.42 * across - 1.0 * away + 0.42 * up)  # from the box to the viewer
        if view:
            towards, up = {"x": np.eye(3)[[0, 2]], "y": (-np.eye(3)[1], np.eye(3)[2]), "z": np.eye(3)[[2, 1]]}[view]
        self.direction, self.pole = -towards, up
        self.right = _unit(np.cross(self.direction, up))
        self.up = np.cross(self.right, self.direction)
        self._fit(frame, aspect)

    def _fit(self, frame, aspect):
        """As near as shows everything, in a picture as wide as suits the box."""
        low, high = extent(frame)
        corners = low + np.array(list(np.ndindex(2, 2, 2))) * (high - low)
        middle = 0.5 * (low + high)
        reach = 0.5 * frame.diameter.max(initial=0.0)
        shown = [frame.ends().reshape(-1, 3)] + ([corners] if frame.held.any() or len(frame) == 0 else [])
        points = np.concatenate(shown) - middle
        half_width = np.tan(0.5 * FIELD_OF_VIEW)
        x, y, depth = points @ self.right, points @ self.up, points @ self.direction
        # Shifted so that what is seen is in the middle, then far enough for either side.
        shift = [0.5 * (values.min() + values.max()) for values in (x, y)]
        x, y = x - shift[0], y - shift[1]
        self.aspect = aspect or float(np.clip((np.abs(x).max() + reach) / (np.abs(y).max() + reach), *ASPECTS))
        needed = np.maximum((np.abs(x) + reach) / half_width, (np.abs(y) + reach) / (half_width / self.aspect)) - depth
        self.distance = 1.03 * needed.max()
        self.location = middle + shift[0] * self.right + shift[1] * self.up - self.distance * self.direction

    def text(self):
        width = 2.0 * np.tan(0.5 * FIELD_OF_VIEW)
        return (f"camera {{ perspective location {vector(self.location)} direction {vector(self.direction)} "
                f"right {vector(width * self.right)} up {vector(width / self.aspect * self.up)} }}\n")


def vector(values):
    return "<" + ",".join(f"{value:.6g}" for value in values) + ">"


def _unit(values):
    return values / np.linalg.norm(values)
