"""The collision stress of rigid bodies of any shape, from contacts and forces of any program."""

from dataclasses import dataclass

import numpy as np

from . import _jostle
from ._arrays import number, rows, with_shape
from ._jostle import refuse
from .bodies import Body


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

    >>> from jostle import body_moments
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


@dataclass(frozen=True)
class ContactStress:
    """Stress times volume of many contacts, (3, 3) arrays, force length; element (position, force).

    virial : sum over contacts of (r_2 - r_1) F; for "centre_line" from point to point
    geometric : sum over bodies of s^G of the net torque; 0 in the other conventions
    per_body : (bodies, 3, 3) array, which adds up to the total: half of every virial that the body takes part in, and
        its own s^G
    """
    virial: np.ndarray
    geometric: np.ndarray
    per_body: np.ndarray

    @property
    def total(self):
        """(3, 3) array; divide by the volume for the stress, positive in compression."""
        return self.virial + self.geometric


def contact_stress(bodies, body_1, body_2, point_1, point_2, force, *, separation=None, convention="rigid_body"):
    """Stress times volume of a list of contacts between bodies of any shape, in all and of every body.

    Parameters
    ----------
    bodies : Body with (B, ...) arrays, or a list of B single ones
    body_1, body_2 : (C) arrays of whole numbers
        Which bodies touch, 0 to B - 1.
    point_1, point_2 : (C, 3) arrays, length
        Where the force acts, relative to the centres of mass.
    force : (C, 3) array, on body_2
    separation : (C, 3) array, length, optional
        From the centre of body_1 to that of body_2, nearest images taken. By default the difference of their centres.
    convention : "rigid_body", "centre_line" (the points must lie on the centre lines) or "centre_of_mass_virial"

    Returns
    -------
    ContactStress

    Raises
    ------
    InputError
        As pair_stress, and for numbers of bodies that are not there.

    Notes
    -----
    Theory, eq. (1.14), jostle/stress/contact_stress.hpp; the sum of `pair_stress`, with work proportional to C + B.

    Examples
    --------
    >>> from jostle import body_moments
    >>> sphere = body_moments("sphere", diameter=1.0)
    >>> bodies = [sphere, sphere.at([1, 0, 0]), sphere.at([2, 0, 0])]
    >>> stress = contact_stress(bodies, [0, 1], [1, 2], [[0.5, 0, 0]] * 2, [[-0.5, 0, 0]] * 2, [[2.0, 0, 0]] * 2)
    >>> stress.total[0, 0], stress.per_body[:, 0, 0]
    (4.0, array([1., 2., 1.]))
    """
    centre, second_moment = _many(bodies)
    first, second = (with_shape(name, value, (None,), kinds="iu", dtype=np.int64)
                     for name, value in (("body_1", body_1), ("body_2", body_2)))
    shape = first.shape + (3,)
    if separation is None:
        _require_bodies(np.concatenate((first, second)), len(centre))
        with_shape("body_2", second, first.shape, kinds="iu", dtype=np.int64)
        separation = centre[second] - centre[first]
    vectors = [with_shape(name, value, shape) for name, value in
               (("separation", separation), ("point_1", point_1), ("point_2", point_2), ("force", force))]
    return ContactStress(*_jostle.contact_stress(second_moment, first, second, *vectors, str(convention)))


def _require_bodies(rows_of, count):
    wrong = rows_of[(rows_of < 0) | (rows_of >= count)]
    if len(wrong):
        refuse("body_1, body_2", str(wrong[0]), "is no row of the bodies", f"0 to {count - 1}")


def _many(bodies):
    """Centres (B, 3) and second moments (B, 3, 3)."""
    if not isinstance(bodies, Body):
        singles = [body._single() for body in bodies]
        return tuple(np.array([body[k] for body in singles], float).reshape((-1, 3, 3)[:k + 1]) for k in (1, 2))
    count = bodies.centre.shape[:1] if bodies.centre.ndim == 2 else bodies.second_moment.shape[:-2]
    if len(count) != 1:
        refuse("bodies", f"centres of shape {bodies.centre.shape}", "are not a list of bodies", "(B, 3)")
    return (with_shape("centre", bodies.centre, count + (3,), repeat=True),
            with_shape("second_moment", bodies.second_moment, count + (3, 3), repeat=True))


def collision_stress(rods, contacts, volume, *, at="touching"):
    """Collision stress of rods from a list of their contacts, with work proportional to their number.

    Parameters
    ----------
    rods : `Simulation.rods`, a frame of a trajectory, or a dict
        With axis (N, 3) of unit vectors, length and diameter (N) or one number; and id (N), if contacts name ids.
    contacts : structured array or dict, one entry a contact
        id_i, id_j (or i, j: rows of the rods); normal (C, 3), unit vector from i to j; arm_i, arm_j (C), length:
        positions along the axes, from the centres, within the rods; force (C), on j along the normal; and gap (C), length, if `at` is
        "start". `Simulation.contacts` is such an array.
    volume : float, length**3
    at : "touching" or "start"
        The distance of the surfaces at which the moment of a force is taken: 0, or the gap.

    Returns
    -------
    (3, 3) array, force length**-2
        (position, force), positive in compression; what Brownian motion carries (n kT, and `orientation_stress`) is not
        in it.

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
    shapes = _shapes(rods)
    force = with_shape("force", _column(contacts, "force"), (None,))
    count = force.shape
    i, j = _partners(rods, contacts, count)
    columns = [with_shape("normal", _column(contacts, "normal"), count + (3,))]
    _require_unit_vectors("normal", columns[0])
    for name, partner in (("arm_i", i), ("arm_j", j)):
        columns.append(with_shape(name, _column(contacts, name), count))
        _require_within(name, columns[-1], partner, *shapes[1:])
    gap = with_shape("gap", _column(contacts, "gap"), count) if at == "start" else np.zeros(count)
    space = _positive("volume", volume)
    return _jostle.sum_over_contacts(*shapes, i, j, *columns, gap, force, at == "touching") / space


def orientation_stress(rods, kT, volume, dimensions=3):
    """Orientation stress of rods, -(3 kT/V) sum of B (n n - I/3): what their Brownian rotation carries.

    Parameters
    ----------
    rods : `Simulation.rods`, a frame of a trajectory, or a dict
        With axis (N, 3) of unit vectors, length and diameter (N) or one number.
    kT : float, energy, >= 0
    volume : float, length**3
    dimensions : 3, or 2 of rods in the plane z = 0
        Then the volume is an area, length**2, and the stress -(2 kT/A) sum of B (n n - I/2), force length**-1.

    Returns
    -------
    (3, 3) array, force length**-2
        Positive in compression, symmetric, traceless; 0 for spheres, and without temperature.

    Raises
    ------
    InputError
        For wrong shapes, axes that are no unit vectors, numbers out of range.

    Notes
    -----
    Theory, eq. (1.19), jostle/stress/orientation_stress.hpp. The stress of Brownian rods is n kT I + this +
    `collision_stress`: in equilibrium it is isotropic, for nematics, too.

    Examples
    --------
    A thousand rods, all along z, carry less stress along z than across:

    >>> rods = {"axis": np.tile([0.0, 0.0, 1.0], (1000, 1)), "length": 5.0, "diameter": 1.0}
    >>> orientation_stress(rods, kT=1.0, volume=10000.0).diagonal().round(4)
    array([ 0.0956,  0.0956, -0.1911])
    """
    temperature = number("kT", kT)
    if not temperature >= 0:
        refuse("kT", str(kT), "is negative", "at least 0")
    if dimensions not in (2, 3):
        refuse("dimensions", str(dimensions), "is neither of the two", "2 or 3")
    return _jostle.sum_over_rods(*_shapes(rods), temperature, dimensions) / _positive("volume", volume)


def _positive(name, value):
    found = number(name, value)
    if not found > 0:
        refuse(name, str(value), "is not positive", "greater than 0")
    return found


def _shapes(rods):
    """Unit vectors (N, 3), lengths and diameters (N)."""
    axis = with_shape("axis", _column(rods, "axis"), (None, 3))
    sizes = [with_shape(name, _column(rods, name), axis.shape[:1], repeat=True) for name in ("length", "diameter")]
    _require_rods(axis, *sizes)
    return axis, *sizes


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
    _require_unit_vectors("axis", axis)
    for name, values, sound in (("length", length, length >= 0), ("diameter", diameter, diameter > 0)):
        if not sound.all():
            k = int(np.argmin(sound))
            refuse(f"{name} (row {k})", str(values[k]), "is outside the allowed range",
                   "at least 0" if name == "length" else "greater than 0")


def _require_unit_vectors(name, vectors):
    difference = abs(np.linalg.norm(vectors, axis=1) - 1)
    if (difference > 1e-6).any():
        k = int(np.argmax(difference))
        refuse(f"{name} (row {k})", str(vectors[k]), "is no unit vector", "a vector of length 1")


def _require_within(name, arm, rod, length, diameter):
    """Rows out of range are for the extension to tell. Cells may have grown by a little since their rods were looked at."""
    known = (rod >= 0) & (rod < len(length))
    half = 0.5 * (length + diameter)[rod[known]]
    beyond = abs(arm[known]) - half
    if (beyond > 0).any():
        k = int(np.argmax(beyond))
        refuse(f"{name} (row {int(np.flatnonzero(known)[k])})", str(arm[known][k]), "is beyond the end of the rod",
               f"at most {half[k]:g} in size")
