"""`jostle stress`: answers by hand and from an independent formula, CSV and HDF5, and every row that it refuses.

What strange files and places do to it: test_strange_tables.py, test_per_body_file.py.
"""

import itertools
import json

import h5py
import numpy as np
import pytest

from jostle_command import BAD_INPUT, DISK, DONE, RODS, changed, command, finish, write_scene

XYZ = "xyz"
EPSILON = np.zeros((3, 3, 3))
for i, j, k in itertools.permutations(range(3)):
    EPSILON[i, j, k] = np.linalg.det(np.eye(3)[[i, j, k]])
CONTACT = [f"contact_{a}" for a in XYZ]
FORCE = [f"force_{a}" for a in XYZ]
POINTS = [f"point_{b}_{a}" for b in (1, 2) for a in XYZ]

# Two spheres of diameter 1 touch at (0.5, 0, 0); the force on the second has friction. By hand (theory, departure 3):
# R (e F + F e) = 0.5 ((1, 0, 0)(2, 0.5, 0) + (2, 0.5, 0)(1, 0, 0)).
TWO_SPHERES = {
    "contacts": {"body_1": [1], "body_2": [2], "contact_x": [0.5], "contact_y": [0.0], "contact_z": [0.0],
                 "force_x": [2.0], "force_y": [0.5], "force_z": [0.0]},
    "bodies": {"id": [1, 2], "x": [0.0, 1.0], "y": [0.0, 0.0], "z": [0.0, 0.0], "shape": ["sphere", "sphere"],
               "diameter": [1.0, 1.0]},
}
STRESS_OF_TWO_SPHERES = [[2.0, 0.25, 0.0], [0.25, 0.0, 0.0], [0.0, 0.0, 0.0]]


def write_csv(path, columns, comments=""):
    rows = zip(*columns.values())
    lines = [",".join(columns)] + [",".join(str(cell) for cell in row) for row in rows]
    path.write_text(comments + "\n".join(lines) + "\n")


def write_hdf5(path, columns, **attributes):
    with h5py.File(path, "w") as file:
        for name, column in columns.items():
            file[name] = column
        file.attrs.update(attributes)


def write_both(folder, tables):
    for name in ("contacts", "bodies"):
        write_csv(folder / f"{name}.csv", tables[name])
        write_hdf5(folder / f"{name}.h5", tables[name])


def stress(folder, *options, kind="csv"):
    result = command(folder, "stress", f"contacts.{kind}", "--bodies", f"bodies.{kind}", "--json", *options)
    assert result.returncode == DONE, result.stderr
    return json.loads(result.stdout)


def per_body(folder, *options, kind="csv"):
    stress(folder, "--per-body", "per_body.csv", *options, kind=kind)
    return np.genfromtxt(folder / "per_body.csv", delimiter=",", skip_header=1, ndmin=2)[:, 1:]


def refusal(folder, *options, status=BAD_INPUT):
    result = command(folder, "stress", "contacts.csv", "--bodies", "bodies.csv", *options)
    assert result.returncode == status, result.stdout
    assert result.stdout == ""
    return result.stderr


def cubic_lattice(edge=3, force=0.7):
    """Spheres of diameter 1 that touch their six neighbours; the stress is force/diameter^2, the same along x, y, z."""
    places = [np.array(p) for p in itertools.product(range(edge), repeat=3)]
    id_of = {tuple(p): k + 100 for k, p in enumerate(places)}
    contacts = {name: [] for name in ["body_1", "body_2", *CONTACT, *FORCE]}
    for place in places:
        for direction in np.eye(3, dtype=int):
            contacts["body_1"].append(id_of[tuple(place)])
            contacts["body_2"].append(id_of[tuple((place + direction) % edge)])
            # the same place in some other image of the box
            point = place + 0.5 * direction - edge * (place[0] % 2) * direction
            for k in range(3):
                contacts[CONTACT[k]].append(float(point[k]))
                contacts[FORCE[k]].append(force * float(direction[k]))
    bodies = {"id": list(id_of.values()), **{a: [float(p[k]) for p in places] for k, a in enumerate(XYZ)},
              "shape": ["sphere"] * len(places), "diameter": [1.0] * len(places)}
    return {"contacts": contacts, "bodies": bodies}


def geometric(inertia, torque):
    """s^G_ij = eps_jkl N_il [G^-1 T]_k with N = tr(G)/2 I - G (theory, eq. 1.4)."""
    second_moment = np.trace(inertia) / 2 * np.eye(3) - inertia
    return np.einsum("jkl,il,k->ij", EPSILON, second_moment, np.linalg.solve(inertia, torque))


def random_assembly(generator, bodies=6, contacts=40):
    """Random inertias, points on each body and forces of any direction; the expected stress in each convention."""
    centre = generator.normal(size=(bodies, 3))
    spread = generator.normal(size=(bodies, 8, 3))
    inertia = np.array([np.trace(s.T @ s) * np.eye(3) - s.T @ s for s in spread])
    pair = np.array([generator.choice(bodies, 2, replace=False) for _ in range(contacts)])
    point = generator.normal(size=(contacts, 2, 3))
    force = generator.normal(size=(contacts, 3))
    table = {"body_1": pair[:, 0], "body_2": pair[:, 1]}
    for k in range(3):
        table |= {POINTS[k]: point[:, 0, k], POINTS[3 + k]: point[:, 1, k], FORCE[k]: force[:, k]}
    columns = {"id": np.arange(bodies), **{a: centre[:, k] for k, a in enumerate(XYZ)}}
    for a, b in itertools.combinations_with_replacement(range(3), 2):
        columns[f"inertia_{XYZ[a]}{XYZ[b]}"] = inertia[:, a, b]
    separation = centre[pair[:, 1]] - centre[pair[:, 0]]
    virial = np.einsum("li,lj->ij", separation, force)
    lines = np.einsum("li,lj->ij", separation + point[:, 1] - point[:, 0], force)
    full = virial.copy()
    for (i, j), (x_1, x_2), f in zip(pair, point, force):
        full += geometric(inertia[j], np.cross(x_2, f)) + geometric(inertia[i], np.cross(x_1, -f))
    axial = np.cross(separation + point[:, 1] - point[:, 0], force).sum(axis=0)
    expected = {"rigid_body": full, "centre_of_mass_virial": virial, "centre_line": lines}
    return {"contacts": table, "bodies": columns}, expected, axial


@pytest.mark.parametrize("kind", ["csv", "h5"])
def test_two_spheres_by_hand(tmp_path, kind):
    write_both(tmp_path, TWO_SPHERES)
    found = stress(tmp_path, kind=kind)
    np.testing.assert_allclose(found["stress"], STRESS_OF_TWO_SPHERES, rtol=0, atol=1e-15)
    assert (found["contacts"], found["bodies"], found["volume"], found["divided_by_volume"]) == (1, 2, None, False)
    found = stress(tmp_path, "--volume", 8, kind=kind)
    np.testing.assert_allclose(found["stress"], np.array(STRESS_OF_TWO_SPHERES) / 8, rtol=0, atol=1e-16)
    assert found["pressure"] == pytest.approx(2 / 24)
    np.testing.assert_allclose(np.add(found["virial"], found["geometric"]), found["stress"], rtol=1e-15)


@pytest.mark.parametrize("kind", ["csv", "h5"])
def test_a_cubic_lattice_across_periodic_faces(tmp_path, kind):
    write_both(tmp_path, cubic_lattice())
    found = stress(tmp_path, "--box", 3, 3, 3, kind=kind)
    np.testing.assert_allclose(found["stress"], 0.7 * np.eye(3), rtol=0, atol=1e-14)
    shares = per_body(tmp_path, "--box", 3, 3, 3, kind=kind)
    np.testing.assert_allclose(shares, np.tile(0.7 / 27 * np.eye(3).ravel(), (27, 1)), rtol=0, atol=1e-15)
    # In an open box, contacts across its faces are somewhere else.
    assert abs(stress(tmp_path, "--box", 3, 3, 3, "--periodic", "none", kind=kind)["pressure"] - 0.7) > 0.1


def test_a_box_so_thin_that_a_sphere_meets_itself(tmp_path):
    tables = {"bodies": {"id": [5], "x": [0.1], "y": [0.2], "z": [0.3], "shape": ["sphere"], "diameter": [1.0]},
              "contacts": {"body_1": [5] * 3, "body_2": [5] * 3}}
    for name, scale in [(POINTS[0:3], 0.5), (POINTS[3:6], -0.5), (FORCE, 0.7), ([f"image_{a}" for a in XYZ], 1)]:
        tables["contacts"] |= {column: scale * np.eye(3)[k] for k, column in enumerate(name)}
    write_both(tmp_path, tables)
    np.testing.assert_allclose(stress(tmp_path, "--box", 1, 1, 1)["stress"], 0.7 * np.eye(3), atol=1e-15)
    separated = {name.replace("image", "separation"): column for name, column in tables["contacts"].items()}
    write_both(tmp_path, {**tables, "contacts": separated})
    np.testing.assert_allclose(stress(tmp_path, "--volume", 1)["stress"], 0.7 * np.eye(3), atol=1e-15)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_random_bodies_against_the_formula(tmp_path, seed):
    tables, expected, axial = random_assembly(np.random.default_rng(seed))
    write_both(tmp_path, tables)
    for convention, total in expected.items():
        for kind in ("csv", "h5"):
            found = stress(tmp_path, "--volume", 3.7, "--convention", convention, kind=kind)
            np.testing.assert_allclose(found["stress"], total / 3.7, rtol=0, atol=1e-13 * np.abs(total).max())
            shares = per_body(tmp_path, "--volume", 3.7, "--convention", convention, kind=kind)
            np.testing.assert_allclose(shares.sum(axis=0), np.ravel(found["stress"]), rtol=0,
                                       atol=1e-13 * np.abs(shares).max())
    found = stress(tmp_path)
    np.testing.assert_allclose(found["antisymmetric_part"]["vector"], axial, rtol=0, atol=1e-12 * np.abs(axial).max())
    assert 0 < found["antisymmetric_part"]["relative"] < 2


def test_shapes_equal_their_second_moments(tmp_path):
    """The same contacts on shapes, and on the second moments that these have, turned by a quaternion."""
    tables, _, _ = random_assembly(np.random.default_rng(4), bodies=4)
    w, x, y, z = q = np.array([0.5, -0.1, 0.7, 0.2])
    w, x, y, z = q / np.linalg.norm(q)
    turn = np.array([[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]])
    n_par, n_perp = 10 * 8 + 20 * 4 + 15 * 2 + 4, (15 * 2 + 8) / 2  # L/D = 2, in units of pi R^5/15
    rod = turn @ np.diag([n_perp, n_perp, n_par]) @ turn.T
    moments = [np.eye(3), rod, turn @ np.diag([1.0, 4.0, 9.0]) @ turn.T, turn @ np.diag([0.25, 4.0, 1.0]) @ turn.T]
    centres = {name: tables["bodies"][name] for name in ["id", "x", "y", "z"]}
    given = {f"second_moment_{XYZ[a]}{XYZ[b]}": [m[a, b] for m in moments]
             for a, b in itertools.combinations_with_replacement(range(3), 2)}
    write_both(tmp_path, {**tables, "bodies": centres | given})
    expected = stress(tmp_path)["stress"]
    none = ["", "", "", ""]
    shapes = {"shape": ["sphere", "spherocylinder", "box", "ellipsoid"], "diameter": [3, 0.5, "", ""],
              "length": ["", 1.0, "", ""], **{f"quaternion_{a}": [""] + 3 * [3 * v] for a, v in zip("wxyz", q)},
              **{f"axis_{a}": none for a in XYZ},
              **{f"edge_{a}": ["", "", v, ""] for a, v in zip(XYZ, [1, 2, 3])},
              **{f"semi_axis_{a}": ["", "", "", v] for a, v in zip(XYZ, [0.5, 2, 1])}}
    write_csv(tmp_path / "bodies.csv", centres | shapes)
    np.testing.assert_allclose(stress(tmp_path)["stress"], expected, rtol=1e-13)
    for k, a in enumerate(XYZ):
        shapes[f"axis_{a}"] = ["", 2 * turn[k, 2], "", ""]
    write_csv(tmp_path / "bodies.csv", centres | shapes)
    np.testing.assert_allclose(stress(tmp_path)["stress"], expected, rtol=1e-13)
    in_hdf5 = {name: [np.nan if cell == "" else cell for cell in column] for name, column in shapes.items()}
    in_hdf5["shape"] = np.array(shapes["shape"], dtype="S20")  # of fixed length
    write_hdf5(tmp_path / "bodies.h5", centres | in_hdf5)
    np.testing.assert_allclose(stress(tmp_path, kind="h5")["stress"], expected, rtol=1e-13)


@pytest.mark.parametrize("cell", [None, ""])
def test_a_quaternion_that_is_not_whole_is_refused(tmp_path, cell):
    """Or the body would count as not turned."""
    tables, _, _ = random_assembly(np.random.default_rng(4), bodies=2)
    bodies = {name: tables["bodies"][name] for name in ["id", "x", "y", "z"]} | {"shape": ["box", "box"]}
    bodies |= {f"edge_{a}": [1, 1] for a in XYZ} | {f"quaternion_{a}": [0.5, 0.5] for a in "wxyz"}
    if cell is None:
        del bodies["quaternion_w"]
    else:
        bodies["quaternion_z"][1] = cell
    write_csv(tmp_path / "contacts.csv", tables["contacts"])
    write_csv(tmp_path / "bodies.csv", bodies)
    result = command(tmp_path, "stress", "contacts.csv", "--bodies", "bodies.csv")
    assert result.returncode == BAD_INPUT
    assert "some of quaternion_w, quaternion_x, quaternion_y, quaternion_z not given" in result.stderr


def test_units_are_passed_through(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    units = {"length": None, "force": None, "stress": None}
    assert stress(tmp_path)["units"] == units
    write_csv(tmp_path / "contacts.csv", TWO_SPHERES["contacts"], "# made by hand\n# length_unit: um\n#force_unit: pN\n")
    assert stress(tmp_path, "--volume", 1)["units"] == {"length": "um", "force": "pN", "stress": "pN um-2"}
    assert stress(tmp_path)["units"]["stress"] == "pN um"
    assert stress(tmp_path, "--volume", 1, "--force-unit", "nN")["units"]["stress"] == "nN um-2"
    text = command(tmp_path, "stress", "contacts.csv", "--bodies", "bodies.csv", "--volume", 1)
    assert text.returncode == DONE and "stress in pN um-2" in text.stdout
    write_hdf5(tmp_path / "contacts.h5", TWO_SPHERES["contacts"], length_unit="mm", force_unit="N")
    assert stress(tmp_path, "--volume", 1, kind="h5")["units"]["stress"] == "N mm-2"
    write_csv(tmp_path / "bodies.csv", TWO_SPHERES["bodies"], "# length_unit: mm\n")
    assert "the contacts are in um, the bodies in mm" in refusal(tmp_path)


def test_columns_in_any_order_quotes_and_others_beside(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    lines = (tmp_path / "bodies.csv").read_text().splitlines()
    turned = [",".join(f'"{cell}"' for cell in reversed((line + ",7").split(","))) for line in lines]
    turned[0] = turned[0].replace('"7"', '"colour"')
    (tmp_path / "bodies.csv").write_bytes(b"\xef\xbb\xbf" + "\r\n".join([turned[0], "", *turned[1:]]).encode())
    found = stress(tmp_path)
    assert found["stress"] == STRESS_OF_TWO_SPHERES
    assert found["columns_passed_over"] == {"contacts": [], "bodies": ["colour"]}


def test_every_malformed_row_is_told_by_its_line(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    (tmp_path / "contacts.csv").write_text(
        "# a comment\nbody_1,body_2,contact_x,contact_y,contact_z,force_x,force_y,force_z\n"
        "1,2,0.5,0,0,1,0,0\n1,9,0.5,0,0,1,0,0\n1,2,0.5,nan,0,abc,0,0\n1,2,0.5,0,0\n\n1,2,,0,0,1,0,0\n1.5,2,0,0,0,1,0,0\n"
        "1,1,0.5,0,0,1,0,0\n2,1,0.5,0,0,-1,0,inf\n")
    lines = refusal(tmp_path).splitlines()
    expected = ["contacts.csv:4: body_2 = 9: no body has that id", 'contacts.csv:5: contact_y = "nan"',
                'contacts.csv:5: force_x = "abc" is not a finite number', "contacts.csv:6: 5 cells, but the header names 8",
                "contacts.csv:8: contact_x is not given", "contacts.csv:9: body_1 = 1.5: is not a whole number",
                "contacts.csv:10: a body touches itself", 'contacts.csv:11: force_z = "inf"']
    assert len(lines) == len(expected)
    for line, start in zip(lines, expected):
        assert line.removeprefix("jostle: ").startswith(start)


def test_malformed_bodies(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    (tmp_path / "bodies.csv").write_text(
        "id,x,y,z,shape,diameter,length,axis_x,axis_y,axis_z,edge_x,edge_y,edge_z\n"
        "1,0,0,0,sphere,1,,,,,,,\n1,0,0,0,sphere,1,,,,,,,\n2,0,0,0,shpere,1,,,,,,,\n3,0,0,0,sphere,-1,,,,,,,\n"
        "4,0,0,0,spherocylinder,1,2,,,,,,\n5,0,0,0,spherocylinder,1,2,0,0,0,,,\n6,0,0,0,box,,,,,,1,0,1\n"
        "7,0,0,0,ellipsoid,,,,,,,,\n")
    lines = refusal(tmp_path).splitlines()
    expected = ["bodies.csv:3: the id 1 stands in line 2 already", 'bodies.csv:4: shape = "shpere"',
                "bodies.csv:5: diameter = -1", "bodies.csv:6: axis_x, axis_y, axis_z not given",
                "bodies.csv:7: the axis has no direction", "bodies.csv:8: edges = 1 0 1",
                "bodies.csv:9: semi_axis_x, semi_axis_y, semi_axis_z not given"]
    assert len(lines) == len(expected)
    for line, start in zip(lines, expected):
        assert line.removeprefix("jostle: ").startswith(start)
    assert 'Did you mean "sphere"?' in lines[1]


def test_inertias_that_no_body_has(tmp_path):
    tables, _, _ = random_assembly(np.random.default_rng(5))
    tables["bodies"]["inertia_xx"][2] = -1.0
    tables["bodies"]["inertia_zz"][4] = 1000.0
    write_both(tmp_path, tables)
    first, second = refusal(tmp_path).splitlines()
    assert "bodies.csv:4: inertia = " in first and "positive definite" in first
    assert "bodies.csv:6: inertia = " in second and "larger than the sum of the other two" in second


def test_only_the_first_twenty_are_told(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    (tmp_path / "contacts.csv").write_text(
        "body_1,body_2,contact_x,contact_y,contact_z,force_x,force_y,force_z\n" + 25 * "1,2,0,0,0,x,0,0\n")
    lines = refusal(tmp_path).splitlines()
    assert len(lines) == 21 and lines[-1] == "contacts.csv: 5 more problems"


def test_rows_of_hdf5_are_counted_from_one(tmp_path):
    tables = cubic_lattice()
    tables["contacts"]["force_x"][3] = np.nan
    tables["contacts"]["contact_y"][7] = np.inf
    tables["contacts"]["body_2"][9] = 5
    write_both(tmp_path, tables)
    result = command(tmp_path, "stress", "contacts.h5", "--bodies", "bodies.h5")
    assert result.returncode == BAD_INPUT
    assert result.stderr.splitlines() == ["jostle: contacts.h5: row 4: force_x is not given",
                                          "contacts.h5: row 8: contact_y is infinite",
                                          "contacts.h5: row 10: body_2 = 5: no body has that id"]


COLUMNS = [
    ({"force_y": "force_Y"}, 'the column "force_y" is missing', 'Is "force_Y" meant for "force_y"?'),
    ({"contact_x": "a", "contact_y": "b", "contact_z": "c"}, "nothing says where the forces act", "point_1_x"),
    ({"contact_x": "a"}, 'the column "contact_x" is missing', 'The file has "body_1"'),
    ({"contact_x": "body_1"}, 'the column "body_1" stands twice', ""),
]


@pytest.mark.parametrize("renamed, problem, suggestion", COLUMNS)
def test_missing_columns(tmp_path, renamed, problem, suggestion):
    write_both(tmp_path, TWO_SPHERES)
    header, rest = (tmp_path / "contacts.csv").read_text().split("\n", 1)
    names = [renamed.get(name, name) for name in header.split(",")]
    (tmp_path / "contacts.csv").write_text(",".join(names) + "\n" + rest)
    message = refusal(tmp_path)
    assert problem in message and suggestion in message


def test_files_that_are_no_tables(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    (tmp_path / "contacts.csv").write_text("# nothing\n")
    assert "there is no header line" in refusal(tmp_path)
    (tmp_path / "contacts.csv").write_bytes((tmp_path / "contacts.h5").read_bytes()[:100])
    assert "as HDF5" in refusal(tmp_path)
    (tmp_path / "contacts.csv").unlink()
    assert "contacts.csv" in refusal(tmp_path)
    with h5py.File(tmp_path / "contacts.h5", "a") as file:
        del file["force_x"]
        file["force_x"] = [1.0, 2.0]
    result = command(tmp_path, "stress", "contacts.h5", "--bodies", "bodies.h5")
    assert result.returncode == BAD_INPUT and "it has 2 rows, others have 1" in result.stderr


def test_options_that_are_refused(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    assert 'Did you mean "rigid_body"?' in refusal(tmp_path, "--convention", "rigidbody")
    assert "needs a point on the centre line of each body" in refusal(tmp_path, "--convention", "centre_line")
    for periodic in ("xw", ""):
        assert "names no directions" in refusal(tmp_path, "--box", 3, 3, 3, "--periodic", periodic)
    for edge in (-3, 0, 1e-120, 1e200, "inf", "nan"):
        assert "an edge that is no such length" in refusal(tmp_path, "--box", 3, edge, 3)
    assert "would overwrite a table" in refusal(tmp_path, "--per-body", "bodies.csv")
    for volume in (0, -1, "nan", "inf", 1e-91):
        assert "is no such volume (allowed: 1e-90 to 1e90)" in refusal(tmp_path, "--volume", volume)
    for options in (["--volume", "abc"], ["--volume", 2, "--box", 1, 1, 1], ["--periodic", "x"]):
        assert refusal(tmp_path, *options)
    # half an edge: which image is meant cannot be told
    assert "is half a box edge" in refusal(tmp_path, "--box", 1, 1, 1)


def test_the_disk(tmp_path):
    write_both(tmp_path, TWO_SPHERES)
    assert "nowhere" in refusal(tmp_path, "--per-body", "nowhere/per_body.csv", status=DISK)


def test_contacts_of_a_run_of_rods(tmp_path):
    """Without the time-step correction a run's contacts, on the axes of the frame before, give the stress of its series.

    Axes are in single precision there, so that is how exactly; all three conventions are compared.
    """
    scene = changed(RODS, contact={"brownian_correction": False}, time={"production": 1.0},
                    output={"series_every": 1, "trajectory_every": 1, "contacts": True, "stress_conventions": True})
    write_scene(tmp_path, scene)
    run = finish(tmp_path)
    series = np.genfromtxt(run / "series.csv", delimiter=",", names=True)
    table = np.genfromtxt(run / "contacts.csv", delimiter=",", names=True)
    step = int(table["step"][-1])
    rows, series = table[table["step"] == step], series[series["step"] == step][0]
    with h5py.File(run / "trajectory.h5") as file:
        rods = file["particles/rods"]
        assert rods["orientation/step"][step - 1] == step - 1
        axis = dict(zip(rods["id/value"][step - 1], rods["orientation/value"][step - 1].astype(float)))
        volume = np.prod(rods["box/edges"][:])
    normal = np.column_stack([rows[f"normal_{a}"] for a in XYZ])
    point_1, point_2 = (rows[f"arm_{k}"][:, None] * np.array([axis[i] for i in rows[f"id_{k}"]]) for k in "ij")
    separation = point_1 + (1 + rows["gap"])[:, None] * normal - point_2
    contacts = {"body_1": rows["id_i"], "body_2": rows["id_j"]}
    for name, vectors in [("point_1", point_1), ("point_2", point_2), ("separation", separation),
                          ("force", rows["force"][:, None] * normal)]:
        contacts |= {f"{name}_{a}": vectors[:, k] for k, a in enumerate(XYZ)}
    zero = [0.0] * len(axis)
    bodies = {"id": list(axis), "x": zero, "y": zero, "z": zero, "shape": ["spherocylinder"] * len(axis),
              "length": [2.0] * len(axis), "diameter": [1.0] * len(axis),
              **{f"axis_{a}": [n[k] for n in axis.values()] for k, a in enumerate(XYZ)}}
    write_both(tmp_path, {"contacts": contacts, "bodies": bodies})
    assert len(rows) > 5
    for convention, prefix in [("rigid_body", "stress"), ("centre_of_mass_virial", "centre_of_mass"),
                               ("centre_line", "centre_line")]:
        expected = np.array([[series[f"{prefix}_{a}{b}"] for b in XYZ] for a in XYZ])
        found = stress(tmp_path, "--volume", volume, "--convention", convention, kind="h5")["stress"]
        np.testing.assert_allclose(found, expected, rtol=0, atol=1e-6 * np.abs(expected).max())
