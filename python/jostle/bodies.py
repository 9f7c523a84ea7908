"""Rigid bodies of any shape and density."""

from dataclasses import dataclass

import numpy as np

from . import _jostle
from ._arrays import array, number, shape_text, with_shape
from ._jostle import refuse


@dataclass(frozen=True)
class Body:
    """A rigid body, or many of them in arrays with leading dimensions.

    mass : (...) array
    centre : (..., 3) array, length; centre of mass
    second_moment : (..., 3, 3) array, N = int rho x x dV about the centre of mass, mass length**2

    The stress does not depend on the scale of the density: any factor in mass and second moment is allowed.

    >>> ball = Body(mass=1.0, centre=[0, 0, 0], second_moment=0.5 * np.eye(3))
    >>> ball.inertia[0, 0]
    1.0
    """
    mass: np.ndarray
    centre: np.ndarray
    second_moment: np.ndarray

    def __post_init__(self):
        for name, last in (("mass", ()), ("centre", (3,)), ("second_moment", (3, 3))):
            given = array(name, getattr(self, name))
            if given.shape[max(given.ndim - len(last), 0):] != last:
                wanted = ", ".join(["...", *map(str, last)])
                refuse(name, f"an array of shape {shape_text(given.shape)}", "has the wrong shape", f"({wanted})")
            object.__setattr__(self, name, given)

    @classmethod
    def from_inertia(cls, mass, centre, inertia):
        """A body that is known by its moment of inertia G (3, 3) about its centre of mass.

        InputError unless G is symmetric, positive definite, and no principal moment exceeds the sum of the others.

        >>> Body.from_inertia(1.0, [0, 0, 0], np.diag([1.0, 1.0, 2.0])).second_moment.diagonal()
        array([1., 1., 0.])
        """
        return cls(mass, centre, _jostle.second_moment_of_inertia(with_shape("inertia", inertia, (3, 3))))

    @property
    def inertia(self):
        """(..., 3, 3) array, G = tr(N) I - N."""
        trace = np.trace(self.second_moment, axis1=-2, axis2=-1)
        return trace[..., None, None] * np.eye(3) - self.second_moment

    def at(self, centre):
        """The same body with its centre of mass elsewhere."""
        return Body(self.mass, centre, self.second_moment)

    def rotated(self, rotation):
        """The body turned about the origin by a rotation (3, 3)."""
        return Body(*_jostle.rotated(*self._single(), with_shape("rotation", rotation, (3, 3))))

    def with_density(self, density):
        """The same body with its density times `density`, >= 0."""
        return Body(*_jostle.with_density(*self._single(), number("density", density)))

    def _single(self):
        if self.mass.ndim or self.centre.ndim > 1 or self.second_moment.ndim > 2:
            refuse("body", f"bodies of shape {shape_text(self.mass.shape)}", "are many, and this takes one")
        return float(self.mass), self.centre, self.second_moment


def combined(bodies):
    """One rigid body made of several, by the parallel-axis theorem. Where they overlap, their densities add.

    A dumb-bell of two spheres that touch:

    >>> sphere = body_moments("sphere", diameter=1.0)
    >>> pair = combined([sphere, sphere.at([1, 0, 0])])
    >>> pair.centre, (pair.second_moment / pair.mass)[0, 0].round(12)
    (array([0.5, 0. , 0. ]), 0.3)
    """
    bodies = list(bodies)
    for body in bodies:
        if not isinstance(body, Body):
            refuse("bodies", f"a {type(body).__name__}", "is no body", "a Body, as body_moments gives it")
    parts = [body._single() for body in bodies]
    if not parts:
        refuse("bodies", "[]", "has no body in it", "at least one")
    return Body(*_jostle.combined(*(np.array([part[k] for part in parts]) for k in range(3))))


def body_moments(shape, **sizes):
    """Mass, centre of mass and second moment of a body of density 1.

    Parameters
    ----------
    shape : str, with its sizes (length):
        "sphere": diameter
        "spherocylinder": length (of the cylinder part, >= 0), diameter, axis (3; any length but 0)
        "box": edges (3), orientation (3, 3; its columns are the directions of the edges; by default the axes')
        "ellipsoid": semi_axes (3), orientation
        "mesh": vertices (n, 3), triangles (m, 3), corners anticlockwise seen from outside; a closed surface
        "convex_hull": points (n, 3)
        "points": points (n, 3), weights (n): a sample of any density; weights are masses
        "clump": centres (n, 3), diameters (n): spheres that move as one

    Returns
    -------
    Body
        Centred, oriented bodies stand about the origin; meshes, hulls, points and clumps where their points are.

    Raises
    ------
    InputError
        For an unknown shape, a size that is missing, unknown or out of its range, a mesh that is open or inside out.

    Notes
    -----
    Theory, eqs. (1.3), (1.5), (1.11) to (1.13), jostle/stress/shape_moments.hpp, mesh_moments.hpp, body_moments.hpp.

    Examples
    --------
    >>> body_moments("sphere", diameter=2.0).second_moment[0, 0].round(6)
    0.837758
    >>> rod = body_moments("spherocylinder", length=5.0, diameter=1.0, axis=[0, 0, 1])
    >>> rod.second_moment.diagonal().round(4)
    array([ 0.2716,  0.2716, 11.9708])
    >>> corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
    >>> faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]
    >>> body_moments("mesh", vertices=corners, triangles=faces).centre
    array([0.25, 0.25, 0.25])
    """
    if shape not in _SHAPES:
        refuse("shape", repr(shape), "is unknown", ", ".join(f'"{name}"' for name in _SHAPES))
    moments, needed, optional = _SHAPES[shape]
    for name in sizes:
        if name not in needed + optional:
            refuse(name, str(sizes[name]), f'is no size of a "{shape}"', ", ".join(needed + optional))
    for name in needed:
        if name not in sizes:
            refuse(name, "", f'is missing: the shape "{shape}" needs it', ", ".join(needed))
    return Body(*moments(**sizes))


def _spherocylinder(length, diameter, axis):
    direction = with_shape("axis", axis, (3,))
    size = np.linalg.norm(direction)
    if not size > 0:
        refuse("axis", str(direction), "has no direction", "a vector that is not zero")
    return _jostle.spherocylinder_moments(direction / size, number("length", length), number("diameter", diameter))


def _box(edges, orientation=np.eye(3)):
    return _jostle.box_moments(with_shape("edges", edges, (3,)), with_shape("orientation", orientation, (3, 3)))


def _ellipsoid(semi_axes, orientation=np.eye(3)):
    return _jostle.ellipsoid_moments(with_shape("semi_axes", semi_axes, (3,)),
                                     with_shape("orientation", orientation, (3, 3)))


def _mesh(vertices, triangles):
    return _jostle.mesh_moments(with_shape("vertices", vertices, (None, 3)),
                                with_shape("triangles", triangles, (None, 3), kinds="iu", dtype=np.int64))


def _convex_hull(points):
    return _jostle.convex_hull_moments(with_shape("points", points, (None, 3)))


def _points(points, weights):
    return _jostle.point_moments(with_shape("points", points, (None, 3)), with_shape("weights", weights, (None,)))


def _clump(centres, diameters):
    return _jostle.clump_moments(with_shape("centres", centres, (None, 3)), with_shape("diameters", diameters, (None,)))


# Name: function, sizes that must be given, sizes that may be.
_SHAPES = {
    "sphere": (lambda diameter: _jostle.sphere_moments(number("diameter", diameter)), ("diameter",), ()),
    "spherocylinder": (_spherocylinder, ("length", "diameter", "axis"), ()),
    "box": (_box, ("edges",), ("orientation",)),
    "ellipsoid": (_ellipsoid, ("semi_axes",), ("orientation",)),
    "mesh": (_mesh, ("vertices", "triangles"), ()),
    "convex_hull": (_convex_hull, ("points",), ()),
    "points": (_points, ("points", "weights"), ()),
    "clump": (_clump, ("centres", "diameters"), ()),
}
