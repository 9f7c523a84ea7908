"""Linear complementarity problems, as contacts pose them."""

from dataclasses import dataclass

import numpy as np

from . import _jostle
from ._arrays import array, number, whole_number, with_shape
from ._jostle import refuse


@dataclass(frozen=True)
class LcpResult:
    """What `solve_lcp` found.

    gamma : (n) array, >= 0; the best candidate where it did not converge
    velocity : (n) array, A gamma + b
    residual : float
    iterations : int, applications of A
    status : "converged", "iteration_limit", "infeasible" (no gamma opens all contacts) or "not_finite"
    """
    gamma: np.ndarray
    velocity: np.ndarray
    residual: float
    iterations: int
    status: str

    @property
    def converged(self):
        return self.status == "converged"


def solve_lcp(A, b, method="adaptive_bb", tolerance=1e-5, max_iterations=10000, *, residual="length", time_step=1.0,
              start=None, diagonal=None):
    """Finds gamma with 0 <= A gamma + b, gamma >= 0, and one of the two 0 in every place.

    Equivalently the least 1/2 gamma.A gamma + b.gamma over gamma >= 0. gamma need not be unique, A gamma is.

    Parameters
    ----------
    A : (n, n) array, SciPy sparse matrix, or function
        Symmetric, positive semi-definite. Of a function x -> A x only what it does to vectors is known: the diagonal is
        found from it by n calls unless `diagonal` is given.
    b : (n) array
    method : "adaptive_bb", "bbpgd" (the method of Yan, Zhang and Shelley 2019), "apgd" or "minimum_map_newton"
    tolerance : float, > 0
        Largest residual, in the measure that `residual` names.
    max_iterations : int, >= 1
        Applications of A.
    residual : "length" or "paper"
        max |min(A_ll gamma_l, (A gamma + b)_l)| time_step, or the 2-norm of min(gamma, A gamma + b).
    time_step : float, > 0
        Turns velocities into lengths, for the residual "length".
    start : (n) array, >= 0, optional
        First candidate; zero by default.
    diagonal : (n) array, optional
        Of A, where A is a function.

    Returns
    -------
    LcpResult
        Not converging is a result, not an error: look at `converged`.

    Raises
    ------
    InputError
        Where shapes do not fit, numbers are not finite, A is not symmetric (to 1e-12 of its largest element) or cannot
        be positive semi-definite: a negative diagonal element, or A_kl**2 > A_kk A_ll. What a function raises passes
        through.

    Notes
    -----
    Theory, eq. (2.5), jostle/lcp. The same bits for any number of threads; for a function, if it gives the same.

    Examples
    --------
    >>> result = solve_lcp([[2.0, 1.0], [1.0, 2.0]], [-1.0, 1.0])
    >>> result.converged, result.gamma
    (True, array([0.5, 0. ]))

    >>> solve_lcp(lambda x: 2.0 * x, [-1.0, 1.0, -4.0]).gamma
    array([0.5, 0. , 2. ])
    """
    constant = with_shape("b", b, (None,))
    question = _question(constant, method, tolerance, max_iterations, residual, time_step, start)
    if callable(A) and not hasattr(A, "shape"):
        function = _checked_function(A, len(constant))
        found = _jostle.solve_function(function, _diagonal_of_function(function, diagonal, len(constant)), question)
    elif diagonal is not None:
        refuse("diagonal", "", "is given beside a matrix, which has its own", "None")
    elif hasattr(A, "tocsr"):
        found = _jostle.solve_sparse(*_checked_rows(A, len(constant)), question)
    else:
        matrix = with_shape("A", A, (len(constant), len(constant)))
        _require_semidefinite(*np.nonzero(matrix), matrix[np.nonzero(matrix)], matrix.diagonal())
        _require_symmetric(abs(matrix - matrix.T).max(initial=0.0), abs(matrix).max(initial=0.0))
        found = _jostle.solve_dense(matrix, np.ascontiguousarray(matrix.diagonal()), question)
    return LcpResult(*found)


def _question(constant, method, tolerance, max_iterations, residual, time_step, start):
    for name, value in (("tolerance", tolerance), ("time_step", time_step)):
        if not number(name, value) > 0:
            refuse(name, str(value), "is not positive", "greater than 0")
    max_iterations = whole_number("max_iterations", max_iterations, 1)
    if residual not in ("length", "paper"):
        refuse("residual", repr(residual), "is unknown", '"length", "paper"')
    first = np.zeros(0) if start is None else with_shape("start", start, constant.shape)
    if (first < 0).any():
        refuse("start", str(first.min()), "is negative", "at least 0")
    return _jostle.LcpQuestion(str(method), constant, first, float(tolerance), max_iterations, residual,
                               float(time_step))


def _checked_rows(A, size):
    """Rows of a sparse matrix: begin, columns, elements, diagonal."""
    if A.shape != (size, size):
        refuse("A", f"a matrix of shape {A.shape}", "has the wrong shape", f"({size}, {size}), as b is long")
    _require_sound_indices(A)
    matrix = A.tocsr(copy=True)
    matrix.sum_duplicates()
    elements = array("A", matrix.data)
    matrix = matrix.astype(float)
    columns = matrix.tocoo()
    _require_semidefinite(columns.row, columns.col, columns.data, matrix.diagonal())
    difference = abs(matrix - matrix.T)
    _require_symmetric(difference.max() if difference.nnz else 0.0, abs(elements).max(initial=0.0))
    return matrix.indptr.astype(np.int64), matrix.indices.astype(np.int64), elements, matrix.diagonal()


def _require_sound_indices(A):
    """SciPy believes what stands in a matrix, and would read beyond its arrays."""
    if hasattr(A, "row"):  # COO, which has no check of its own
        sound = len(A.row) == len(A.col) == len(A.data) and all(
            ((k >= 0) & (k < size)).all() for k, size in zip((A.row, A.col), A.shape))
        problem = "an index is beyond the shape, or one is missing"
    else:
        sound, problem = True, ""
    if hasattr(A, "check_format"):  # CSR, CSC, BSR
        try:
            A.copy().check_format(full_check=True)
        except ValueError as error:
            sound, problem = False, str(error)
    if not sound:
        refuse("A", "", f"is a damaged sparse matrix: {problem}")


def _checked_function(A, size):
    def apply(x):
        return with_shape("A(x)", A(x), (size,))

    # x.A y = y.A x for a symmetric A; seen on one pair of vectors, as a function does not show its elements.
    if size > 0:
        random = np.random.default_rng(0)
        x, y = random.standard_normal((2, size))
        image_x, image_y = apply(x.copy()), apply(y.copy())
        scale = np.linalg.norm(x) * np.linalg.norm(image_y) + np.linalg.norm(y) * np.linalg.norm(image_x)
        _require_symmetric(abs(x @ image_y - y @ image_x), scale)
    return apply


def _diagonal_of_function(function, diagonal, size):
    if diagonal is None:
        diagonal = np.array([function(unit)[k] for k, unit in enumerate(np.eye(size))])
    diagonal = with_shape("diagonal", diagonal, (size,))
    _require_semidefinite([], [], [], diagonal)
    return diagonal


def _require_symmetric(difference, scale):
    if difference > 1e-12 * scale:
        refuse("A", "", f"is not symmetric: elements differ by {difference:.3g}", "a symmetric matrix",
               "Use (A + A.T)/2 if this is rounding")


def _require_semidefinite(row, column, element, diagonal):
    if (diagonal < 0).any():
        k = int(np.argmin(diagonal))
        refuse(f"A[{k}, {k}]", str(diagonal[k]), "is negative", "a positive semi-definite matrix")
    bound = diagonal[row] * diagonal[column] if len(row) else np.zeros(0)
    excess = np.square(element) > bound * (1 + 1e-12)
    if np.any(excess):
        k, m = int(row[np.argmax(excess)]), int(column[np.argmax(excess)])
        refuse(f"A[{k}, {m}]", str(element[np.argmax(excess)]),
               f"is too large beside A[{k}, {k}] = {diagonal[k]} and A[{m}, {m}] = {diagonal[m]}",
               "a positive semi-definite matrix")
