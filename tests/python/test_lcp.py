import numpy as np
import pytest
import scipy.sparse

import jostle

METHODS = ("adaptive_bb", "bbpgd", "apgd", "minimum_map_newton")


def random_problem(size, rank, seed):
    """A = D^T D of a given rank, and a b with which gamma = gamma_0, velocity = v_0 is a solution."""
    random = np.random.default_rng(seed)
    factor = random.normal(size=(rank, size))
    matrix = factor.T @ factor
    matrix = 0.5 * (matrix + matrix.T)
    active = random.random(size) < 0.4
    gamma = np.where(active, random.random(size), 0)
    velocity = np.where(active, 0, random.random(size))
    return matrix, velocity - matrix @ gamma, velocity


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("rank", [30, 60])
def test_dense_sparse_and_function_agree(method, rank):
    matrix, b, velocity = random_problem(40, rank, seed=rank)
    options = {"method": method, "tolerance": 1e-9, "max_iterations": 100000}
    dense = jostle.solve_lcp(matrix, b, **options)
    assert dense.converged and dense.residual <= 1e-9 and dense.gamma.min() >= 0
    assert np.abs(np.minimum(dense.velocity, np.diag(matrix) * dense.gamma)).max() <= 1e-9
    assert np.abs(dense.velocity - velocity).max() < 1e-6  # unique, unlike gamma
    assert np.allclose(matrix @ dense.gamma + b, dense.velocity, atol=1e-11)
    sparse = jostle.solve_lcp(scipy.sparse.coo_matrix(matrix), b, **options)
    assert np.array_equal(sparse.gamma, dense.gamma)
    # The same sums in the same order, so the same bits; BLAS would not promise them.
    def apply(x):
        return np.array([np.add.accumulate(row * x)[-1] for row in matrix])
    of_function = jostle.solve_lcp(apply, b, **options)
    assert of_function.converged and np.array_equal(of_function.gamma, dense.gamma)
    assert np.array_equal(jostle.solve_lcp(apply, b, diagonal=np.diag(matrix), **options).gamma, dense.gamma)


def test_kinds_of_sparse_matrices():
    matrix = scipy.sparse.random(30, 30, 0.1, random_state=1)
    matrix = (matrix @ matrix.T + scipy.sparse.identity(30)).tocsr()
    b = np.linspace(-1, 1, 30)
    expected = jostle.solve_lcp(matrix, b).gamma
    for form in ("csr", "csc", "coo", "lil", "dok", "bsr"):
        assert np.array_equal(jostle.solve_lcp(matrix.asformat(form), b).gamma, expected)
    doubled = scipy.sparse.coo_matrix((np.tile(matrix.tocoo().data / 2, 2), np.tile(matrix.nonzero(), 2)), (30, 30))
    assert np.allclose(jostle.solve_lcp(doubled, b).gamma, expected)


def test_not_converging_is_a_result():
    matrix, b, _ = random_problem(40, 60, seed=3)
    few = jostle.solve_lcp(matrix, b, max_iterations=2, tolerance=1e-12)
    assert (few.status, few.converged) == ("iteration_limit", False)
    closed = jostle.solve_lcp(np.zeros((1, 1)), [-1.0], method="bbpgd")  # no force opens it
    assert closed.status == "infeasible"
    assert jostle.solve_lcp(np.zeros((0, 0)), []).converged
    assert jostle.solve_lcp(matrix, b, max_iterations=5, residual="paper").iterations == 5


def test_start_is_used():
    matrix, b, _ = random_problem(40, 60, seed=4)
    solution = jostle.solve_lcp(matrix, b, tolerance=1e-10, max_iterations=10**5)
    again = jostle.solve_lcp(matrix, b, tolerance=1e-9, start=solution.gamma)
    assert again.iterations == 1 and np.array_equal(again.gamma, solution.gamma)


GOOD = np.array([[2.0, 1.0], [1.0, 2.0]])


@pytest.mark.parametrize("matrix, b, options, message", [
    (np.zeros((2, 3)), [1, 1], {}, r"A = an array of shape \(2, 3\): has the wrong shape \(allowed: \(2, 2\)\)"),
    (np.zeros(2), [1, 1], {}, r"A = an array of shape \(2\): has the wrong shape"),
    (GOOD, [[1, 1]], {}, r"b = an array of shape \(1, 2\): has the wrong shape \(allowed: \(n\)\)"),
    (GOOD, [1, np.nan], {}, r"b = nan: is not a finite number \(element \[1\]\)"),
    (GOOD * [np.inf, 1], [1, 1], {}, "A = inf: is not a finite number"),
    ([[2, 1], [0, 2]], [1, 1], {}, "A: is not symmetric: elements differ by 1"),
    ([[2, 0], [0, -1]], [1, 1], {}, r"A\[1, 1\] = -1.0: is negative .allowed: a positive semi-definite matrix"),
    ([[1, 3], [3, 1]], [1, 1], {}, r"A\[0, 1\] = 3.0: is too large beside"),
    ([[0, 1e-9], [1e-9, 1]], [1, 1], {}, r"A\[0, 1\] = 1e-09: is too large beside"),
    (GOOD, [1, 1], {"method": "gauss"}, 'method = "gauss": is unknown .allowed: "adaptive_bb", "apgd"'),
    (GOOD, [1, 1], {"method": "projected_sor"}, "works on the velocities of rods, and a matrix has none"),
    (GOOD, [1, 1], {"tolerance": 0}, "tolerance = 0: is not positive"),
    (GOOD, [1, 1], {"max_iterations": 0}, "max_iterations = 0: is no such number"),
    (GOOD, [1, 1], {"max_iterations": 1.5}, "max_iterations = 1.5: is no such number"),
    (GOOD, [1, 1], {"max_iterations": 2**64}, "max_iterations = 18446744073709551616: is no such number"),
    (GOOD, [1, 1], {"residual": "square"}, "residual = 'square': is unknown"),
    (GOOD, [1, 1], {"start": [1, -1]}, "start = -1.0: is negative"),
    (GOOD, [1, 1], {"start": [1]}, "start = an array of shape"),
    (GOOD, [1, 1], {"diagonal": [2, 2]}, "diagonal: is given beside a matrix"),
])
def test_bad_input(matrix, b, options, message):
    with pytest.raises(jostle.InputError, match=message):
        jostle.solve_lcp(matrix, b, **options)


def test_bad_sparse_matrices():
    for matrix, message in (([[2, 1], [0, 2]], "not symmetric"), ([[1, 3], [3, 1]], "too large beside"),
                            ([[2, 0], [0, -1]], "is negative"), ([[2, np.nan], [np.nan, 2]], "not a finite number")):
        with pytest.raises(jostle.InputError, match=message):
            jostle.solve_lcp(scipy.sparse.csr_matrix(np.array(matrix, float)), [1.0, 1.0])
    with pytest.raises(jostle.InputError, match="has the wrong shape"):
        jostle.solve_lcp(scipy.sparse.identity(3), [1.0, 1.0])


@pytest.mark.parametrize("kind", ["csr", "csc", "coo", "bsr"])
def test_damaged_sparse_matrices(kind):
    """SciPy itself would read, and write, beyond its arrays."""
    for index in (10**6, -1):
        matrix = scipy.sparse.identity(600, format=kind)
        (matrix.row if kind == "coo" else matrix.indices)[3] = index
        with pytest.raises(jostle.InputError, match="A: is a damaged sparse matrix"):
            jostle.solve_lcp(matrix, np.ones(600))
    if kind == "csr":
        matrix.indptr[5] = 10**6
        with pytest.raises(jostle.InputError, match="A: is a damaged sparse matrix"):
            jostle.solve_lcp(matrix, np.ones(600))


def test_bad_functions():
    with pytest.raises(jostle.InputError, match="is not symmetric"):
        jostle.solve_lcp(lambda x: np.array([[2, 1], [0, 2]]) @ x, [1.0, 1.0])
    with pytest.raises(jostle.InputError, match=r"A\(x\) = an array of shape \(3\): has the wrong shape"):
        jostle.solve_lcp(lambda x: np.zeros(3), [1.0, 1.0])
    with pytest.raises(jostle.InputError, match=r"A\(x\) = nan"):
        jostle.solve_lcp(lambda x: x * np.nan, [1.0, 1.0])
    calls = []

    def fails_late(x):
        calls.append(1)
        if len(calls) > 3:
            raise KeyError("of my own")
        return np.diag(np.arange(1.0, 6.0)) @ x

    with pytest.raises(KeyError, match="of my own"):
        jostle.solve_lcp(fails_late, -np.ones(5), diagonal=np.arange(1.0, 6.0), tolerance=1e-14)
