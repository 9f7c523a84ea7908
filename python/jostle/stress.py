"""The collision stress of rigid bodies of any shape, from contacts and forces of any program."""

from dataclasses import dataclass

import numpy as np

from . import _jostle
from ._arrays import array, number, rows, with_shape
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
                refuse(name, f"an array of shape {given.shape}", "has the wrong shape", f"(..., {str(last)[1:-1]})")
            object.__setattr__(self, name, given)

    def at(self, centre):
        """The same body with its centre of mass elsewhere."""
        return Body(self.mass, centre, self.second_moment)

    @property
    def inertia(self):
        """(..., 3, 3) array, G = tr(N) I - N."""
        trace = np.trace(self.second_moment, axis1=-2, axis2=-1)
        return trace[..., None, None] * np.eye(3) - self.second_moment


def body_moments(shape, **sizes):
    """Mass and second moment of a body of density 1, as a `Body` with its centre of mass at the origin.

    Parameters
    ----------
    shape : str, and its sizes (length):
        "sphere": diameter
        "spherocylinder": length (of the cylinder part, >= 0), diameter, axis (3; need not be a unit vector)

    Returns
    -------
    Body

    Raises
    ------
    InputError
        For an unknown shape, a size that is missing, unknown or out of its range.

    Notes
    -----
    Theory, eq. (1.5), jostle/stress/spherocylinder_moments.hpp.

    Examples
    --------
    >>> body_moments("sphere", diameter=2.0).second_moment[0, 0]
    0.8377580409572781
    >>> rod = body_moments("spherocylinder", length=5.0, diameter=1.0, axis=[0, 0, 1])
    >>> rod.second_moment.diagonal().round(4)
    array([ 0.2716,  0.2716, 11.9708])
    """
    if shape not in _SHAPES:
        refuse("shape", repr(shape), "is unknown", ", ".join(f'"{name}"' for name in _SHAPES))
    make, names = _SHAPES[shape]
    for name in sizes:
        if name not in names:
            refuse(name, str(sizes[name]), f'is no size of a "{shape}"', ", ".join(names))
    for name in names:
        if name not in sizes:
            refuse(name, "", f'is missing: the shape "{shape}" needs it', ", ".join(names))
    return make(**sizes)


def _sphere(diameter):
    return _spherocylinder(0.0, diameter, (0, 0, 1))


def _spherocylinder(length, diameter, axis):
    direction = with_shape("axis", axis, (3,))
    size = np.linalg.norm(direction)
    if not size > 0:
        refuse("axis", str(direction), "has no direction", "a vector that is not zero")
    mass, second_moment = _jostle.spherocylinder_moments(number("length", length), number("diameter", diameter),
                                                         direction / size)
    return Body(mass, np.zeros(3), second_moment)


_SHAPES = {"sphere": (_sphere, ("diameter",)), "spherocylinder": (_spherocylinder, ("length", "diameter", "axis"))}


@dataclass(frozen=True)
class PairStress:
    """Stress times volume of contacts, (..., 3, 3) arrays, force length; element (position, force).

    centre_of_mass_virial : (r_2 - r_1) F
    geometric_1, geometric_2 : s^G of body 1 under -F, of body 2 under F; traceless
    """
    centre_of_mass_virial: np.ndarray
    geometric_1: np.ndarray
    geometric_2: np.ndarray

    @property
    def total(self):
        """(..., 3, 3) array, the sum of the three: theory, eq. (1.1)."""
        return self.centre_of_mass_virial + self.geometric_1 + self.geometric_2


def pair_stress(body_1, body_2, point_1, point_2, force):
    """Stress times volume of a contact between two rigid bodies, or of many; positive in compression.

    Parameters
    ----------
    body_1, body_2 : Body
    point_1, point_2 : (..., 3) arrays, length
        Where the force acts, relative to the bodies' centres of mass; anywhere, not only on the surface.
    force : (..., 3) array
        On body 2, of any direction: contact, friction, spring, motor. Body 1 feels -force.
        Leading dimensions of all arguments are broadcast.

    Returns
    -------
    PairStress
        Symmetric where the force is along the line between the two points; else eps:sigma = d x F with that line d.

    Raises
    ------
    InputError
        Where a second moment is not symmetric, not positive semi-definite, or of a line without width; for wrong
        shapes and numbers that are not finite.

    Notes
    -----
    Theory, eq. (1.1), jostle/stress/rigid_body_stress.hpp; Yan, Zhang and Shelley, J. Chem. Phys. 150, 064109 (2019),
    with the sign of the force on body 1 corrected.

    Examples
    --------
    Two spheres that touch, with a force that has friction in it: the stress is symmetric all the same.

    >>> sphere = body_moments("sphere", diameter=1.0)
    >>> stress = pair_stress(sphere, sphere.at([1, 0, 0]), [0.5, 0, 0], [-0.5, 0, 0], force=[2.0, 1.0, 0.0])
    >>> stress.total
    array([[2. , 0.5, 0. ],
           [0.5, 0. , 0. ],
           [0. , 0. , 0. ]])
    """
    for name, body in (("body_1", body_1), ("body_2", body_2)):
        if not isinstance(body, Body):
            refuse(name, f"a {type(body).__name__}", "is no body", "a Body, as body_moments gives it")
    vector, matrix = (3,), (3, 3)
    lead, arrays = rows(centre_1=(body_1.centre, vector), second_moment_1=(body_1.second_moment, matrix),
                        centre_2=(body_2.centre, vector), second_moment_2=(body_2.second_moment, matrix),
                        point_1=(point_1, vector), point_2=(point_2, vector), force=(force, vector))
    return PairStress(*(part.reshape(lead + matrix) for part in _jostle.pair_stress(*arrays)))


def collision_stress(rods, contacts, volume, *, at="touching"):
    """Collision stress of rods from a list of their contacts, with work proportional to their number.

    Parameters
    ----------
    rods : `Simulation.rods`, a frame of a trajectory, or a dict
        With axis (N, 3) of unit vectors, length and diameter (N) or one number; and id (N), if contacts name ids.
    contacts : structured array or dict, one entry a contact
        id_i, id_j (or i, j: rows of the rods); normal (C, 3), unit vector from i to j; arm_i, arm_j (C), length:
        positions along the axes, from the centres; force (C), on j along the normal; and gap (C), length, if `at` is
        "start". `Simulation.contacts` is such an array.
    volume : float, length**3
    at : "touching" or "start"
        The distance of the surfaces at which the moment of a force is taken: 0, or the gap.

    Returns
    -------
    (3, 3) array, force length**-2
        (position, force), positive in compression; the kinetic part n kT is not in it.

    Raises
    ------
    InputError
        For wrong shapes, ids and rows that no rod has, axes that are no unit vectors, sizes out of range.

    Notes
    -----
    Theory, eq. (1.7), jostle/stress/collision_stress.hpp.

    Examples
    --------
    Two parallel rods side by side, pressed together by a force of 3:

    >>> rods = {"axis": [[0, 0, 1], [0, 0, 1]], "length": 5.0, "diameter": 1.0}
    >>> contact = {"i": [0], "j": [1], "normal": [[1, 0, 0]], "arm_i": [0.0], "arm_j": [0.0], "force": [3.0]}
    >>> collision_stress(rods, contact, volume=30.0)[0, 0]
    0.1
    """
    if at not in ("touching", "start"):
        refuse("at", repr(at), "is unknown", '"touching", "start"')
    axis = with_shape("axis", _column(rods, "axis"), (None, 3))
    sizes = [with_shape(name, _column(rods, name), axis.shape[:1], repeat=True) for name in ("length", "diameter")]
    _require_rods(axis, *sizes)
    force = with_shape("force", _column(contacts, "force"), (None,))
    count = force.shape
    i, j = _partners(rods, contacts, count)
    columns = [with_shape("normal", _column(contacts, "normal"), count + (3,))]
    columns += [with_shape(name, _column(contacts, name), count) for name in ("arm_i", "arm_j")]
    gap = with_shape("gap", _column(contacts, "gap"), count) if at == "start" else np.zeros(count)
    space = number("volume", volume)
    if not space > 0:
        refuse("volume", str(volume), "is not positive", "greater than 0")
    return _jostle.sum_over_contacts(axis, *sizes, i, j, *columns, gap, force, at == "touching") / space


def _column(table, name):
    try:
        return table[name] if not hasattr(table, name) else getattr(table, name)
    except (KeyError, ValueError, IndexError, TypeError):
        refuse(name, "", "is missing")


def _has(table, name):
    names = getattr(getattr(table, "dtype", None), "names", None) or table
    return name in names


def _partners(rods, contacts, count):
    if not _has(contacts, "id_i"):
        return [with_shape(name, _column(contacts, name), count, kinds="iu", dtype=np.int64) for name in ("i", "j")]
    ids = with_shape("id", _column(rods, "id"), (None,), kinds="iu", dtype=np.uint64)
    order = np.argsort(ids)
    found = []
    for name in ("id_i", "id_j"):
        wanted = with_shape(name, _column(contacts, name), count, kinds="iu", dtype=np.uint64)
        unknown = wanted[~np.isin(wanted, ids)]
        if len(unknown):
            refuse(name, str(unknown[0]), "is the id of no rod")
        found.append(order[np.searchsorted(ids, wanted, sorter=order)].astype(np.int64))
    return found


def _require_rods(axis, length, diameter):
    size = np.linalg.norm(axis, axis=1)
    if (abs(size - 1) > 1e-6).any():
        k = int(np.argmax(abs(size - 1)))
        refuse(f"axis (row {k})", str(axis[k]), "is no unit vector", "a vector of length 1")
    for name, values, sound in (("length", length, length >= 0), ("diameter", diameter, diameter > 0)):
        if not sound.all():
            k = int(np.argmin(sound))
            refuse(f"{name} (row {k})", str(values[k]), "is outside the allowed range",
                   "at least 0" if name == "length" else "greater than 0")
