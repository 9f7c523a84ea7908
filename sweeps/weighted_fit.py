"""Least squares with errors."""

import numpy as np

from replicas import probability_of


class WeightedFit:
    """Values (n) with standard errors (n), fitted by a sum of columns (m, n).

    value, error (m): of the coefficients; chi_squared; degrees: n - m; probability of a chi squared at least as large, nan without a
    degree of freedom.
    """

    def __init__(self, values, errors, columns):
        values, errors = np.asarray(values, dtype=float), np.asarray(errors, dtype=float)
        matrix = np.array(columns, dtype=float).T / errors[:, None]
        covariance = np.linalg.inv(matrix.T @ matrix)
        self.value = covariance @ matrix.T @ (values / errors)
        self.error = np.sqrt(np.diag(covariance))
        self.chi_squared = float(((values / errors - matrix @ self.value)**2).sum())
        self.degrees = len(values) - len(self.value)
        self.probability = probability_of(self.chi_squared, self.degrees) if self.degrees > 0 else float("nan")
