"""Distances of segments, which are the centre lines of rods."""

from . import _jostle
from ._arrays import rows


def segment_distance(p0, p1, q0, q1):
    """The distance of segments, and where they come nearest to each other.

    Parameters
    ----------
    p0, p1 : (..., 3) arrays, length
        Ends of the first segments. A segment may be a point.
    q0, q1 : (..., 3) arrays, length
        Ends of the second segments. Leading dimensions are broadcast: one segment against many is one call.

    Returns
    -------
    distance : (...) array, length
    s, t : (...) arrays
        Fractions between 0 and 1: the nearest points are p0 + s (p1 - p0) and q0 + t (q1 - q0). Of a point they are
        1/2; where the nearest points are not unique (parallel, side by side) they are the middle of the overlap.

    Raises
    ------
    InputError
        For wrong shapes, types that are no numbers (whole numbers and float32 are converted), NaN and infinity.

    Notes
    -----
    Right to about 1e-14 times the size of the coordinates, for any angle. Source: nearest_fractions in
    jostle/contact/nearest_fractions.hpp; Ericson, Real-Time Collision Detection (2005), section 5.1.9.

    Examples
    --------
    Two crossing segments, one above the other:

    >>> distance, s, t = segment_distance([0, 0, 0], [4, 0, 0], [1, -1, 2], [1, 3, 2])
    >>> float(distance), float(s), float(t)
    (2.0, 0.25, 0.25)

    One segment against a row of points:

    >>> points = [[-1, 0, 0], [2, 1, 0], [9, 0, 0]]
    >>> segment_distance([0, 0, 0], [4, 0, 0], points, points)[0]
    array([1., 1., 5.])
    """
    lead, arrays = rows(p0=(p0, (3,)), p1=(p1, (3,)), q0=(q0, (3,)), q1=(q1, (3,)))
    return tuple(found.reshape(lead) for found in _jostle.segment_distance(*arrays))
