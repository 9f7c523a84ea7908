"""Arguments as the arrays that the extension takes, or InputError.

Whole numbers and floating-point numbers of up to 64 bits are converted to float64; all of the former up to 2**53, and
all of the latter, without loss. Truth values, complex numbers, texts and objects are refused, and so are NaN and
infinity.
"""

import numpy as np

from ._jostle import refuse


def shape_text(shape):
    return "(" + ", ".join("n" if extent is None else str(extent) for extent in shape) + ")"


def array(name, value, kinds="iuf", dtype=float):
    """The value as an array of numbers, not yet looked at for its shape."""
    try:
        given = np.asarray(value)
    except ValueError:  # lists of lists of different lengths
        refuse(name, "", "is not a rectangular array of numbers")
    if given.size == 0 and given.dtype.kind == "f":
        return np.ascontiguousarray(given, dtype)
    if given.dtype.kind not in kinds or given.dtype.itemsize > 8:
        wanted = "whole numbers" if kinds == "iu" else "whole or floating-point numbers of up to 64 bits"
        refuse(name, f"an array of {given.dtype}", "does not hold numbers that jostle takes", wanted)
    converted = np.ascontiguousarray(given, dtype).reshape(given.shape)  # of shape (), too
    finite = np.isfinite(converted)
    if not finite.all():
        place = tuple(int(k) for k in np.argwhere(~finite)[0])
        refuse(name, str(converted[place]), "is not a finite number" + (f" (element {list(place)})" if place else ""))
    return converted


def with_shape(name, value, shape, *, repeat=False, **options):
    """The value as an array of this shape; None in it admits any extent, and `repeat` what broadcasts to it."""
    given = array(name, value, **options)
    if given.ndim == len(shape) and all(b is None or a == b for a, b in zip(given.shape, shape)):
        return given
    try:
        if repeat:
            return np.ascontiguousarray(np.broadcast_to(given, shape))
    except ValueError:
        pass
    refuse(name, f"an array of shape {shape_text(given.shape)}", "has the wrong shape", shape_text(shape))


def number(name, value):
    return float(with_shape(name, value, ()))


def whole_number(name, value, lowest):
    """The value as an int that the extension takes."""
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, (int, np.integer)) or not lowest <= value < 2**63:
        refuse(name, repr(value), "is no such number", f"a whole number of at least {lowest}, below 2**63")
    return int(value)


def rows(**values):
    """Broadcasts arrays with given last dimensions against each other: name = (value, last dimensions).

    Returns the common leading shape and the arrays as (n, *last dimensions), contiguous.
    """
    arrays, leads = {}, {}
    for name, (value, last) in values.items():
        given = array(name, value)
        if given.shape[given.ndim - len(last):] != last or given.ndim < len(last):
            wanted = ", ".join(str(extent) for extent in last)
            refuse(name, f"an array of shape {shape_text(given.shape)}", "has the wrong shape", f"(..., {wanted})")
        arrays[name], leads[name] = given, given.shape[:given.ndim - len(last)]
    try:
        lead = np.broadcast_shapes(*leads.values())
    except ValueError:
        shapes = ", ".join(f"{name} {shape_text(given.shape)}" for name, given in arrays.items())
        refuse(", ".join(arrays), shapes, "have shapes that do not fit together", "leading dimensions that broadcast")
    count = int(np.prod(lead))
    return lead, [np.ascontiguousarray(np.broadcast_to(arrays[name], lead + last)).reshape((count,) + last)
                  for name, (_, last) in values.items()]
