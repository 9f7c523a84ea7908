import numpy as np
import pytest

import jostle


def brute_force(p0, p1, q0, q1, steps=20):
    """The distance by a grid that is made finer and finer about its least place (the square is convex in s, t)."""
    low, high = np.zeros(2), np.ones(2)
    for _ in range(steps):
        s = np.linspace(low[0], high[0], 21)[:, None, None]
        t = np.linspace(low[1], high[1], 21)[None, :, None]
        distance = np.linalg.norm(p0 + s * (p1 - p0) - q0 - t * (q1 - q0), axis=2)
        a, b = np.unravel_index(distance.argmin(), distance.shape)
        centre, width = np.array([s[a, 0, 0], t[0, b, 0]]), (high - low) / 10
        low, high = np.maximum(0, centre - width), np.minimum(1, centre + width)
    return distance.min()


def test_random_segments_against_a_search():
    random = np.random.default_rng(11)
    ends = random.normal(size=(4, 200, 3))
    distance, s, t = jostle.segment_distance(*ends)
    expected = [brute_force(*(end[k] for end in ends)) for k in range(200)]
    assert np.abs(distance - expected).max() < 1e-7  # the search ends at 1e-14 in s, t but sees a flat minimum
    p0, p1, q0, q1 = ends
    between = p0 + s[:, None] * (p1 - p0) - q0 - t[:, None] * (q1 - q0)
    assert np.abs(np.linalg.norm(between, axis=1) - distance).max() < 1e-14 * 10
    assert s.min() >= 0 and s.max() <= 1 and t.min() >= 0 and t.max() <= 1


#   p0 ------------- p1        side by side: the middle of the overlap
#          q0 ------------- q1
def test_parallel_segments():
    distance, s, t = jostle.segment_distance([0, 0, 0], [4, 0, 0], [2, 1, 0], [6, 1, 0])
    assert (distance, s, t) == pytest.approx((1, 0.75, 0.25), abs=1e-14)


def test_points():
    distance, s, t = jostle.segment_distance([1, 2, 3], [1, 2, 3], [1, 2, 8], [1, 2, 8])
    assert (distance, s, t) == (5, 0.5, 0.5)
    distance, s, t = jostle.segment_distance([1, 0, 3], [1, 0, 3], [0, 0, 0], [4, 0, 0])
    assert (distance, s, t) == (3, 0.5, 0.25)


def test_broadcasting_and_shapes():
    distance, s, t = jostle.segment_distance(np.zeros(3), [1, 0, 0], np.ones((4, 1, 3)), np.full((5, 3), 2.0))
    assert distance.shape == s.shape == t.shape == (4, 5)
    assert jostle.segment_distance(np.zeros(3), [1, 0, 0], [0, 1, 0], [1, 1, 0])[0].shape == ()
    assert jostle.segment_distance(*np.zeros((4, 0, 3)))[0].shape == (0,)
    for wrong in (np.zeros(2), np.zeros((3, 2)), 1.0):
        with pytest.raises(jostle.InputError, match=r"q1 = an array of shape .*has the wrong shape.*\(\.\.\., 3\)"):
            jostle.segment_distance(np.zeros(3), np.ones(3), np.zeros(3), wrong)
    with pytest.raises(jostle.InputError, match="do not fit together"):
        jostle.segment_distance(np.zeros((2, 3)), np.ones((3, 3)), np.zeros(3), np.ones(3))


def test_kinds_of_numbers():
    random = np.random.default_rng(12)
    whole = random.integers(-9, 9, size=(4, 7, 3))
    expected = jostle.segment_distance(*whole.astype(float))
    for kind in (np.int8, np.uint64, np.float32, np.float16, ">f8"):
        given = np.abs(whole) if kind is np.uint64 else whole
        wanted = jostle.segment_distance(*given.astype(float)) if kind is np.uint64 else expected
        for found, one in zip(jostle.segment_distance(*given.astype(kind)), wanted):
            assert np.array_equal(found, one)
    backwards = np.asfortranarray(whole.astype(float))[:, ::-1]  # strides, and no copy in C order
    assert np.array_equal(jostle.segment_distance(*backwards)[0], expected[0][::-1])
    for kind in (complex, bool, object, str, np.longdouble):
        with pytest.raises(jostle.InputError, match="p0 = an array of .* does not hold numbers that jostle takes"):
            jostle.segment_distance(whole[0].astype(kind), *whole[1:])
    with pytest.raises(jostle.InputError, match="p0: is not a rectangular array"):
        jostle.segment_distance([[1, 2, 3], [1, 2]], *whole[1:])


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_numbers_that_are_not_finite(bad):
    ends = np.zeros((4, 5, 3))
    ends[1] = 1.0
    ends[2, 3, 1] = bad
    with pytest.raises(jostle.InputError, match=rf"q0 = {bad}: is not a finite number \(element \[3, 1\]\)"):
        jostle.segment_distance(*ends)


def test_any_number_of_threads():
    ends = np.random.default_rng(13).normal(size=(4, 5000, 3))
    before = jostle.thread_count()
    try:
        results = []
        for count in (1, 2, 3):
            jostle.set_thread_count(count)
            results.append(np.concatenate(jostle.segment_distance(*ends)))
        assert np.array_equal(results[0], results[1]) and np.array_equal(results[0], results[2])
    finally:
        jostle.set_thread_count(before)
