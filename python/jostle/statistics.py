"""Averages of series that are correlated in time."""

from dataclasses import dataclass
from typing import Optional

from . import _jostle
from ._arrays import with_shape


@dataclass(frozen=True)
class Average:
    """The mean of a series, and how well it is known: the entries of summary.json.

    mean : in the unit of the series, as all but the next two
    n_eff : effective number of samples: as many independent rows would know the mean as well
    correlation_time_rows : integrated correlation time, in rows
    standard_error : of the mean: twice it covers 95 %; None where it cannot be given
    no_standard_error_because : one sentence then, else ""
    standard_deviation : of the rows: a fluctuation, not an error
    """
    mean: float
    standard_error: Optional[float]
    n_eff: float
    standard_deviation: float
    correlation_time_rows: float
    no_standard_error_because: str

    def __str__(self):
        if self.standard_error is None:
            return f"{self.mean:.5g} (no error bar: {self.no_standard_error_because})"
        return f"{self.mean:.5g} +- {self.standard_error:.2g} (n_eff {self.n_eff:.0f})"


def average(series):
    """Mean and standard error of a correlated time series: the error bars of `jostle run` for a series of your own.

    Parameters
    ----------
    series : (rows) array
        Evenly spaced in time, and stationary: leave out equilibration.

    Returns
    -------
    Average

    Raises
    ------
    InputError
        For other shapes, NaN and infinity.

    Notes
    -----
    With g = 1 + 2 sum_k (1 - k/n) C(k), C the normalised autocorrelation, the variance of the mean is g/n times that of
    the rows (docs/theory/4-statistics.md). The sum ends at three correlation times. There is no error bar below 25
    effective samples, nor for a constant series. A mode that is slower than the series is long cannot be seen.

    Examples
    --------
    >>> rows = np.random.default_rng(1).normal(5.0, 2.0, 6400)     # independent: error 2/sqrt(6400) = 0.025
    >>> found = average(rows)
    >>> bool(abs(found.mean - 5.0) < 3 * found.standard_error), round(float(found.standard_error), 2)
    (True, 0.03)
    >>> print(average([1.0, 2.0, 4.0]))
    2.3333 (no error bar: The series has only 3 rows; at least 25 independent ones are needed.)
    """
    return Average(**_jostle.average(with_shape("series", series, (None,))))
