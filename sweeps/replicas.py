"""Means over runs that differ in their seed, and whether these agree within their errors."""

import math
from dataclasses import dataclass

import numpy as np
from scipy import special  # not stats, which takes a second to load

COVERED = 1.959964     # standard errors of a normal number that hold 95 of 100
LEAST_PROBABILITY = 0.01  # of a chi squared as large as found, below which runs are said to disagree


def probability_of(chi_squared, degrees):
    """Of a chi squared at least as large, by chance."""
    return float(special.chdtrc(degrees, chi_squared))


@dataclass
class Mean:
    """Of one quantity over runs; a number that cannot be told is nan."""

    value: float
    within: float        # standard error from those of the runs
    scatter: float       # from the scatter of their means, such that twice it covers 95 of 100
    chi_squared: float
    degrees: int
    probability: float   # of a chi squared at least as large, by chance

    @property
    def agree(self):
        """Whether the runs agree within their errors; None if that cannot be told."""
        return None if math.isnan(self.probability) else self.probability >= LEAST_PROBABILITY

    @property
    def error(self):
        """From the runs' own errors, unless they have none or do not agree: then from the scatter."""
        return self.scatter if math.isnan(self.within) or self.agree is False else self.within


def mean_of(values, errors):
    """Mean over runs of equal length. `errors`: nan where a run has none; then the scatter alone tells.

    Scatter: the standard deviation over the square root of the number of runs, times Student's t over that of a normal number, as few runs
    tell little. Chi squared: sum of (value - weighted mean)^2/error^2, of one degree of freedom fewer than runs.
    """
    values, errors = np.asarray(values, dtype=float), np.asarray(errors, dtype=float)
    count = len(values)
    scatter = math.nan
    if count > 1:
        scatter = values.std(ddof=1) / math.sqrt(count) * special.stdtrit(count - 1, 0.975) / COVERED
    if not np.all(errors > 0.0):
        return Mean(values.mean(), math.nan, scatter, math.nan, 0, math.nan)
    within = math.sqrt((errors**2).sum()) / count
    if count < 2:
        return Mean(values.mean(), within, math.nan, math.nan, 0, math.nan)
    weights = 1.0 / errors**2
    chi_squared = float((weights * (values - (weights * values).sum() / weights.sum())**2).sum())
    return Mean(values.mean(), within, scatter, chi_squared, count - 1, probability_of(chi_squared, count - 1))
