"""Stress tensors from the series of a run, in the conventions that `output.stress_conventions` writes."""

import math

import numpy

import reference_values

CONVENTIONS = {"rigid body": "stress", "centre of mass": "centre_of_mass", "centre line": "centre_line"}  # column prefix
BLOCKS = 20


def blocked(values):
    """Mean and standard error from a few long blocks."""
    means = numpy.array([block.mean() for block in numpy.array_split(values, BLOCKS)])
    return means.mean(), means.std(ddof=1) / math.sqrt(BLOCKS)


class Tensor:
    """One convention of the stress of a run, over n kT, by rows of the series."""

    def __init__(self, run, series, convention):
        names = [f"{CONVENTIONS[convention]}_{a}{b}" for a in "xyz" for b in "xyz"]
        self.rows = _rows(run, series, names)

    def pressure(self):
        return blocked(numpy.trace(self.rows, axis1=1, axis2=2) / 3)

    def normal_difference(self, director):
        along = numpy.einsum("kab,a,b->k", self.rows, director, director)
        return blocked(along - (numpy.trace(self.rows, axis1=1, axis2=2) - along) / 2)

    def __sub__(self, other):
        difference = object.__new__(Tensor)
        difference.rows = self.rows - other.rows
        return difference

    def asymmetry(self):
        """Largest antisymmetric element of a row, and of the mean, both relative to the trace."""
        odd = self.rows - self.rows.transpose(0, 2, 1)
        trace = numpy.trace(self.rows.mean(axis=0))
        return numpy.abs(odd).max() / trace, numpy.abs(odd.mean(axis=0)).max() / trace


def whole_stress(run, series):
    """Kinetic, orientation and collision part together (theory, eq. 1.19)."""
    whole = Tensor(run, series, "rigid body")
    symmetric = [f"stress_orientation_{min(a, b)}{max(a, b)}" for a in "xyz" for b in "xyz"]
    whole.rows = whole.rows + _rows(run, series, symmetric) + numpy.eye(3)
    return whole


def _rows(run, series, names):
    """(rows, 3, 3) of nine columns, over n kT."""
    return numpy.array([series[name] for name in names]).T.reshape(-1, 3, 3) / run.summary["stress_kinetic"]["mean"]


def predicted_normal_difference(run, series, director):
    """3 B <n.Q.n>, in equilibrium the normal difference of the stress over n kT (theory, eq. 1.8), and its standard error."""
    order_along = sum(series[f"order_{a}{b}"] * director["xyz".index(a)] * director["xyz".index(b)] * (1 if a == b else 2)
                      for a, b in ("xx", "xy", "xz", "yy", "yz", "zz"))
    B = reference_values.moment_anisotropy(run.scene["rods"]["length"])
    return tuple(3 * B * value for value in blocked(order_along))
