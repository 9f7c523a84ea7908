import numpy as np
import pytest

import jostle

RANDOM = np.random.default_rng(21)


def random_body(count=()):
    """A body with the second moment of random points."""
    points = RANDOM.normal(size=count + (8, 3)) * RANDOM.uniform(0.2, 2.0, size=count + (1, 3))
    points -= points.mean(axis=-2, keepdims=True)
    return jostle.Body(np.full(count, 8.0), RANDOM.normal(size=count + (3,)),
                       np.einsum("...pi,...pj->...ij", points, points))


def geometric_stress(second_moment, point, force):
    """s^G_ij = eps_jkl N_il [G^-1 (x_C x F)]_k, written out."""
    epsilon = np.zeros((3, 3, 3))
    for j, k, m in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        epsilon[j, k, m], epsilon[j, m, k] = 1, -1
    inertia = np.trace(second_moment) * np.eye(3) - second_moment
    omega = np.linalg.solve(inertia, np.cross(point, force))
    return np.einsum("jkl,il,k->ij", epsilon, second_moment, omega)


def test_formula_for_random_bodies():
    one, two = random_body((50,)), random_body((50,))
    x_1, x_2, force = RANDOM.normal(size=(3, 50, 3))
    stress = jostle.pair_stress(one, two, x_1, x_2, force)
    for k in range(50):
        assert np.allclose(stress.centre_of_mass_virial[k], np.outer(two.centre[k] - one.centre[k], force[k]))
        assert np.allclose(stress.geometric_1[k], geometric_stress(one.second_moment[k], x_1[k], -force[k]), atol=1e-12)
        assert np.allclose(stress.geometric_2[k], geometric_stress(two.second_moment[k], x_2[k], force[k]), atol=1e-12)
    between = two.centre + x_2 - one.centre - x_1
    antisymmetric = np.stack([stress.total[:, a, b] - stress.total[:, b, a] for a, b in ((1, 2), (2, 0), (0, 1))], 1)
    assert np.allclose(antisymmetric, np.cross(between, force), atol=1e-11)
    assert np.allclose(np.trace(stress.total, axis1=1, axis2=2), np.sum((two.centre - one.centre) * force, axis=1))


def test_one_pair_is_the_row_of_many():
    one, two = random_body((5,)), random_body((5,))
    x_1, x_2, force = RANDOM.normal(size=(3, 5, 3))
    many = jostle.pair_stress(one, two, x_1, x_2, force).total
    for k in range(5):
        bodies = [jostle.Body(body.mass[k], body.centre[k], body.second_moment[k]) for body in (one, two)]
        alone = jostle.pair_stress(*bodies, x_1[k], x_2[k], force[k]).total
        assert alone.shape == (3, 3) and np.array_equal(alone, many[k])
    sphere = jostle.body_moments("sphere", diameter=1.0)
    against_many = jostle.pair_stress(sphere, sphere.at(np.ones((4, 2, 3))), np.zeros(3), np.zeros(3), np.ones(3))
    assert against_many.total.shape == (4, 2, 3, 3)


@pytest.mark.parametrize("second_moment, message", [
    (np.diag([1.0, 1.0, -0.5]), r"second_moment \(row 0\) = .*: has a negative eigenvalue"),
    (np.diag([1.0, 0.0, 0.0]), "gives an inertia that is singular"),
    (np.zeros((3, 3)), "gives an inertia that is singular"),
    ([[1.0, 0.5, 0], [0, 1.0, 0], [0, 0, 1.0]], "must be symmetric"),
])
def test_bad_second_moments(second_moment, message):
    body = jostle.Body(1.0, np.zeros(3), second_moment)
    with pytest.raises(jostle.InputError, match=message):
        jostle.pair_stress(body, body, np.zeros(3), np.ones(3), np.ones(3))


def test_bad_pairs_tell_their_row():
    moments = np.tile(np.eye(3), (4, 1, 1))
    moments[2, 0, 0] = -3.0
    good, bad = jostle.Body(1, np.zeros(3), np.eye(3)), jostle.Body(np.ones(4), np.zeros((4, 3)), moments)
    with pytest.raises(jostle.InputError, match=r"second_moment \(row 2\)"):
        jostle.pair_stress(good, bad, np.zeros(3), np.ones(3), np.ones(3))
    with pytest.raises(jostle.InputError, match="body_2 = a tuple: is no body"):
        jostle.pair_stress(good, (1, 2), np.zeros(3), np.ones(3), np.ones(3))
    with pytest.raises(jostle.InputError, match="force = nan: is not a finite number"):
        jostle.pair_stress(good, good, np.zeros(3), np.ones(3), [0, np.nan, 0])
    for wrong in ({"centre": np.zeros(2)}, {"second_moment": np.eye(2)}, {"second_moment": np.zeros(3)}):
        with pytest.raises(jostle.InputError, match="has the wrong shape"):
            jostle.Body(**{"mass": 1.0, "centre": np.zeros(3), "second_moment": np.eye(3), **wrong})


def random_contacts(count, rods):
    """Anywhere on rods of random length."""
    normal = RANDOM.normal(size=(count, 3))
    i, j = RANDOM.integers(0, len(rods["length"]), (2, count))
    arm_i, arm_j = RANDOM.uniform(-0.5, 0.5, (2, count)) * rods["length"][[i, j]]
    return {"i": i, "j": j, "normal": normal / np.linalg.norm(normal, axis=1, keepdims=True), "arm_i": arm_i,
            "arm_j": arm_j, "force": RANDOM.random(count), "gap": 0.1 * RANDOM.random(count)}


def random_rods(count):
    axis = RANDOM.normal(size=(count, 3))
    return {"axis": axis / np.linalg.norm(axis, axis=1, keepdims=True), "length": 5 * RANDOM.random(count),
            "diameter": 0.5 + RANDOM.random(count), "id": RANDOM.permutation(10 * count)[:count]}


@pytest.mark.parametrize("at", ["touching", "start"])
def test_rods_are_bodies(at):
    """The sum over contacts and rods is that of pair_stress over contacts, for rods of any sizes."""
    rods = random_rods(30)
    contacts = random_contacts(200, rods)
    volume = 7.0
    total = np.zeros((3, 3))
    bodies = [jostle.body_moments("spherocylinder", length=length, diameter=diameter, axis=axis) for length, diameter,
              axis in zip(rods["length"], rods["diameter"], rods["axis"])]
    for l in range(200):
        i, j = contacts["i"][l], contacts["j"][l]
        arm_i, arm_j = contacts["arm_i"][l] * rods["axis"][i], contacts["arm_j"][l] * rods["axis"][j]
        distance = 0.5 * (rods["diameter"][i] + rods["diameter"][j]) + (contacts["gap"][l] if at == "start" else 0)
        separation = arm_i + distance * contacts["normal"][l] - arm_j
        total += jostle.pair_stress(bodies[i].at([0, 0, 0]), bodies[j].at(separation), arm_i, arm_j,
                                    contacts["force"][l] * contacts["normal"][l]).total
    found = jostle.collision_stress(rods, contacts, volume, at=at)
    assert np.abs(found - total / volume).max() < 1e-12
    by_id = {**contacts, "id_i": rods["id"][contacts["i"]], "id_j": rods["id"][contacts["j"]]}
    del by_id["i"], by_id["j"]
    assert np.array_equal(jostle.collision_stress(rods, by_id, volume, at=at), found)


@pytest.mark.parametrize("change_rods, change_contacts, volume, message", [
    ({}, {}, 0.0, "volume = 0.0: is not positive"),
    ({}, {}, np.nan, "volume = nan: is not a finite number"),
    ({"axis": np.ones((30, 3))}, {}, 1, r"axis \(row 0\) = .*is no unit vector"),
    ({"length": -1.0}, {}, 1, r"length \(row 0\) = -1.0: is outside the allowed range .allowed: at least 0"),
    ({"diameter": 0}, {}, 1, r"diameter \(row 0\) = 0.0"),
    ({"length": np.ones(4)}, {}, 1, r"length = an array of shape \(4\): has the wrong shape .allowed: \(30\)"),
    ({"axis": None}, {}, 1, "axis: is missing"),
    ({}, {"i": np.full(200, 30)}, 1, r"contacts \(row 0\) = 30: is no row of the bodies .allowed: 0 to 29"),
    ({}, {"j": np.full(200, -1)}, 1, r"contacts \(row 0\) = -1"),
    ({}, {"i": np.zeros(200)}, 1, "i = an array of float64: does not hold numbers that jostle takes .allowed: whole"),
    ({}, {"force": np.ones(199)}, 1, "wrong shape"),
    ({}, {"normal": np.ones((200, 2))}, 1, "normal = an array of shape"),
    ({}, {"normal": None}, 1, "normal: is missing"),
    ({}, {"normal": np.tile([0, 0, 2.0], (200, 1))}, 1, r"normal \(row 0\) = .*is no unit vector"),
    ({}, {"arm_j": np.full(200, 9.0)}, 1, r"arm_j \(row \d+\) = 9.0: is beyond the end of the rod"),
    ({}, {"force": np.full(200, np.inf)}, 1, "force = inf"),
    ({}, {"id_i": np.full(200, 10**6), "id_j": np.zeros(200, int)}, 1, "id_i = 1000000: is the id of no rod"),
])
def test_bad_lists_of_contacts(change_rods, change_contacts, volume, message):
    def changed(table, change):
        return {name: value for name, value in {**table, **change}.items() if value is not None}
    rods = random_rods(30)
    with pytest.raises(jostle.InputError, match=message):
        jostle.collision_stress(changed(rods, change_rods), changed(random_contacts(200, rods), change_contacts), volume)


def test_no_contacts():
    rods = random_rods(3)
    assert np.array_equal(jostle.collision_stress(rods, random_contacts(0, rods), 1.0), np.zeros((3, 3)))


ROTATION = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
CUBE = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)])
FACES = np.array([[0, 1, 3], [0, 3, 2], [4, 6, 7], [4, 7, 5], [0, 4, 5], [0, 5, 1],
                  [2, 3, 7], [2, 7, 6], [0, 2, 6], [0, 6, 4], [1, 5, 7], [1, 7, 3]])


def same_body(one, other):
    return all(np.allclose(getattr(one, name), getattr(other, name), atol=1e-12)
               for name in ("mass", "centre", "second_moment"))


def test_shapes_against_closed_forms():
    box = jostle.body_moments("box", edges=[1, 2, 3])
    assert same_body(box, jostle.Body(6, np.zeros(3), 0.5 * np.diag([1, 4, 9])))
    assert same_body(box.rotated(ROTATION), jostle.body_moments("box", edges=[1, 2, 3], orientation=ROTATION))
    ball = jostle.body_moments("sphere", diameter=2.0)
    assert same_body(ball, jostle.body_moments("ellipsoid", semi_axes=[1, 1, 1]))
    assert same_body(ball, jostle.body_moments("spherocylinder", length=0, diameter=2, axis=[3, 4, 0]))
    assert np.isclose(ball.mass, 4 * np.pi / 3) and np.allclose(ball.second_moment, ball.mass / 5 * np.eye(3))
    cube = jostle.body_moments("box", edges=[1, 1, 1]).at([0.5, 0.5, 0.5])
    assert same_body(cube, jostle.body_moments("mesh", vertices=CUBE, triangles=FACES))
    assert same_body(cube, jostle.body_moments("convex_hull", points=np.vstack((CUBE, [[0.5, 0.5, 0.9]]))))
    pair = jostle.combined([ball, ball.at([2, 0, 0])])
    assert same_body(pair, jostle.body_moments("clump", centres=[[0, 0, 0], [2, 0, 0]], diameters=[2, 2]))
    corners = jostle.body_moments("points", points=CUBE, weights=np.full(8, 0.25))
    assert same_body(corners, jostle.Body(2, [0.5] * 3, 0.5 * np.eye(3)))
    heavy = jostle.combined([ball, ball.with_density(3).at([2, 0, 0])])  # its centre of mass is not its middle
    assert np.allclose(heavy.centre, [1.5, 0, 0])
    assert same_body(jostle.Body.from_inertia(box.mass, box.centre, box.inertia), box)


def test_list_of_contacts():
    """The sum of pair stresses, and shares that add up to it."""
    bodies, count = random_body((20,)), 60
    first, second = RANDOM.integers(0, 20, (2, count))
    x_1, x_2, force = RANDOM.normal(size=(3, count, 3))
    found = jostle.contact_stress(bodies, first, second, x_1, x_2, force)
    one, two = (jostle.Body(bodies.mass[rows], bodies.centre[rows], bodies.second_moment[rows])
                for rows in (first, second))
    pairs = jostle.pair_stress(one, two, x_1, x_2, force)
    scale = np.abs(pairs.total).sum()
    assert np.abs(found.total - pairs.total.sum(axis=0)).max() < 1e-13 * scale
    assert np.abs(found.per_body.sum(axis=0) - found.total).max() < 1e-13 * scale
    singles = [jostle.Body(bodies.mass[k], bodies.centre[k], bodies.second_moment[k]) for k in range(20)]
    again = jostle.contact_stress(singles, first, second, x_1, x_2, force,
                                  separation=bodies.centre[second] - bodies.centre[first])
    assert np.array_equal(again.per_body, found.per_body)
    bare = jostle.contact_stress(bodies, first, second, x_1, x_2, force, convention="centre_of_mass_virial")
    assert np.array_equal(bare.virial, found.virial) and not bare.geometric.any()


@pytest.mark.parametrize("change, message", [
    ({"body_1": [0, 20]}, "body_1, body_2 = 20: is no row of the bodies .allowed: 0 to 19"),
    ({"body_2": [-1, 0]}, "body_1, body_2 = -1"),
    ({"body_1": [0, 20], "separation": np.ones((2, 3))}, r"contacts \(row 1\) = 20"),
    ({"body_1": [0.0, 1.0]}, "body_1 = an array of float64"),
    ({"body_2": [0]}, "body_2 = an array of shape"),
    ({"force": np.ones(3)}, r"force = an array of shape \(3\): has the wrong shape .allowed: \(2, 3\)"),
    ({"point_1": np.full((2, 3), np.nan)}, "point_1 = nan: is not a finite number"),
    ({"convention": "virial"}, 'convention = "virial": is unknown'),
    ({"bodies": jostle.Body(1, np.zeros(3), np.eye(3))}, "are not a list of bodies"),
])
def test_bad_lists_of_bodies(change, message):
    arguments = {"bodies": random_body((20,)), "body_1": [0, 1], "body_2": [2, 3], "point_1": np.ones((2, 3)),
                 "point_2": np.ones((2, 3)), "force": np.ones((2, 3))}
    with pytest.raises(jostle.InputError, match=message):
        jostle.contact_stress(**{**arguments, **change})


@pytest.mark.parametrize("shape, sizes, message", [
    ("cone", {}, 'shape = .cone.: is unknown .allowed: "sphere", "spherocylinder"'),
    ("sphere", {}, "diameter: is missing"),
    ("sphere", {"diameter": 1, "length": 1}, 'length = 1: is no size of a "sphere"'),
    ("sphere", {"diameter": -1}, "diameter = -1"),
    ("sphere", {"diameter": np.nan}, "diameter = nan"),
    ("sphere", {"diameter": 1e-320}, "diameter = .*no sphere has such a diameter .allowed: 1e-30 to 1e30"),
    ("spherocylinder", {"length": 1e-31, "diameter": 1, "axis": [0, 0, 1]}, "length = 1e-31.*allowed: 0, or 1e-30 to 1e30"),
    ("spherocylinder", {"length": 1, "diameter": 1e31, "axis": [0, 0, 1]}, "diameter = 1e.31"),
    ("box", {"edges": [1, 1, 1e-200]}, "edges = 1 1 1e-200: no body has such a size"),
    ("spherocylinder", {"length": 1, "diameter": 1, "axis": [0, 0, 0]}, "axis = .*has no direction"),
    ("spherocylinder", {"length": 1, "diameter": 1, "axis": [0, 1]}, "axis = an array of shape"),
    ("box", {"edges": [1, 0, 1]}, "edge"),
    ("box", {"edges": [1, 1, 1], "orientation": 2 * np.eye(3)}, "rotation|orientation"),
    ("box", {"edges": [1, 1, 1], "orientation": np.diag([1, 1, -1])}, "rotation|orientation"),
    ("ellipsoid", {"semi_axes": [1, 1]}, "semi_axes = an array of shape"),
    ("mesh", {"vertices": CUBE, "triangles": FACES[1:]}, "open"),
    ("mesh", {"vertices": CUBE, "triangles": FACES[:, ::-1]}, "inside out"),
    ("mesh", {"vertices": CUBE, "triangles": FACES + 1}, r"triangles \(row 2\) = 8: is no row of the vertices"),
    ("mesh", {"vertices": CUBE, "triangles": FACES.astype(float)}, "triangles = an array of float64"),
    ("convex_hull", {"points": CUBE[:4]}, "plane"),
    ("points", {"points": CUBE, "weights": np.ones(7)}, "weights"),
    ("points", {"points": CUBE, "weights": -np.ones(8)}, "weight"),
    ("clump", {"centres": CUBE, "diameters": np.zeros(8)}, "diameter"),
])
def test_bad_bodies(shape, sizes, message):
    with pytest.raises(jostle.InputError, match=message):
        jostle.body_moments(shape, **sizes)


@pytest.mark.parametrize("inertia", [np.diag([1.0, 1.0, -1.0]), np.diag([1.0, 1.0, 3.0]), [[1, 1, 0], [0, 1, 0], [0, 0, 1]],
                                     np.zeros((3, 3))])
def test_bad_inertia(inertia):
    with pytest.raises(jostle.InputError, match="inertia"):
        jostle.Body.from_inertia(1.0, np.zeros(3), inertia)


def test_many_bodies_where_one_is_needed():
    with pytest.raises(jostle.InputError, match="are many, and this takes one"):
        random_body((4,)).rotated(ROTATION)
    with pytest.raises(jostle.InputError, match="has no body in it"):
        jostle.combined([])
    with pytest.raises(jostle.InputError, match="bodies = a int: is no body"):
        jostle.combined([1])


def test_orientation_stress():
    """-(3 kT/V) sum of B (n n - I/3), every rod with its own B; of equal rods -2 n kT B Q."""
    axis = RANDOM.normal(size=(7, 3))
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    length, diameter = RANDOM.uniform(0, 8, 7), RANDOM.uniform(0.5, 2, 7)
    b = length / diameter
    B = 5 * b * (2 * b + 1) * (2 * b + 3) / (20 * b**3 + 40 * b**2 + 45 * b + 16)
    rods = {"axis": axis, "length": length, "diameter": diameter}
    expected = -3 * 0.7 / 11 * np.einsum("i,iab->ab", B, axis[:, :, None] * axis[:, None, :] - np.eye(3) / 3)
    found = jostle.orientation_stress(rods, 0.7, 11.0)
    assert np.allclose(found, expected, rtol=0, atol=1e-15)
    assert abs(np.trace(found)) < 1e-15 and np.array_equal(found, found.T)
    assert np.array_equal(jostle.orientation_stress(rods, 0.0, 11.0), np.zeros((3, 3)))
    assert np.array_equal(jostle.orientation_stress(dict(rods, length=0.0), 0.7, 11.0), np.zeros((3, 3)))


@pytest.mark.parametrize("changes, told", [({"kT": -1.0}, "kT"), ({"kT": np.nan}, "kT"), ({"volume": 0.0}, "volume"),
                                           ({"rods": {"axis": [[0, 0, 2]], "length": 1.0, "diameter": 1.0}}, "axis"),
                                           ({"rods": {"axis": [[0, 0, 1]], "length": -1.0, "diameter": 1.0}}, "length")])
def test_orientation_stress_refuses(changes, told):
    arguments = {"rods": {"axis": [[0, 0, 1]], "length": 1.0, "diameter": 1.0}, "kT": 1.0, "volume": 1.0} | changes
    with pytest.raises(jostle.InputError, match=told):
        jostle.orientation_stress(**arguments)
