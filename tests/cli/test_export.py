"""`jostle export`: what GSD, VTK and extended XYZ hold, read back by other means than they were written."""

import base64
import os
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import ase.io
import gsd.hoomd
import h5py
import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import trajectory_by_hand
from jostle_command import (BAD_INPUT, DISK, DONE, JOSTLE, RODS, changed, command, finish, flip_bit,
                            require_one_line, snapshot, write_scene)
from test_full_disk import file_size_limit

ELEMENTS = ("id", "position", "image", "orientation", "length", "diameter")
OUTPUTS = {"gsd": "trajectory.gsd", "vtk": "vtk", "xyz": "trajectory.xyz"}


def export(run, form, *options):
    result = command(run.parent, "export", run.name, "--to", form, *options)
    assert result.returncode == DONE and result.stderr == "", result.stderr
    assert not list(run.glob(".*"))
    return run / OUTPUTS[form]


def frames_of(run):
    """Frames as dicts of arrays, straight from the H5MD file; rows without a rod left out."""
    with h5py.File(run / "trajectory.h5") as file:
        rods = file["particles/rods"]
        for k, time in enumerate(rods["position/time"]):
            there = rods["id/value"][k].astype(np.int64) != -1
            frame = {name: rods[f"{name}/value"][k][there] for name in ELEMENTS}
            periodic = np.array([boundary == b"periodic" for boundary in rods["box"].attrs["boundary"]])
            yield {**frame, "time": time, "step": rods["position/step"][k], "edges": rods["box/edges"][()],
                   "periodic": periodic}


def turned_z(quaternions):
    """Where unit quaternions (w, x, y, z) turn +z: the third column of their rotation matrices."""
    w, x, y, z = np.asarray(quaternions, float).T
    return np.stack((2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)), axis=1)


def require_gsd(path, expected):
    with gsd.hoomd.open(name=str(path), mode="rb") as file:
        found = list(file)
        assert file.file.schema == "hoomd" and file.file.schema_version == (1, 4)
    assert len(found) == len(expected)
    for made, frame in zip(found, expected):
        rods = made.particles
        assert made.configuration.step == frame["step"] and rods.N == len(frame["id"])
        assert made.log["time"] == [frame["time"]]
        box = made.configuration.box
        assert np.all(box[3:] == 0) and box[:3][frame["periodic"]] == pytest.approx(frame["edges"][frame["periodic"]])
        ends = 0.5 * (frame["length"] + frame["diameter"])[:, None]
        beyond = np.abs(rods.position) + ends - box[:3] / 2
        assert np.all(beyond[:, ~frame["periodic"]] < 1e-4)  # along open directions the box holds all rods
        assert np.array_equal(rods.diameter, frame["diameter"])
        unwrapped = rods.position + rods.image * frame["edges"]
        expected_unwrapped = frame["position"] + frame["image"] * frame["edges"]
        assert np.allclose(unwrapped + frame["edges"] / 2, expected_unwrapped, atol=1e-5)
        assert np.allclose(turned_z(rods.orientation), frame["orientation"], atol=1e-6)
        assert np.allclose(np.linalg.norm(rods.orientation, axis=1), 1.0, atol=1e-6)
        assert np.array_equal(made.log["particles/length"], frame["length"])
        assert np.array_equal(made.log["particles/id"], frame["id"])
    return found


def drawn(made):
    """Length and diameter of every rod as its type is drawn."""
    def of_shape(shape):
        if shape["type"] == "Sphere":
            return 0.0, shape["diameter"]
        assert shape["type"] == "ConvexPolyhedron"
        low, high = shape["vertices"]
        assert low[:2] == high[:2] == [0, 0] and low[2] == -high[2] < 0
        return high[2] - low[2], 2 * shape["rounding_radius"]

    return np.array([of_shape(made.particles.type_shapes[kind]) for kind in made.particles.typeid]).T


def array_of(element):
    content = base64.b64decode(element.text)
    assert int.from_bytes(content[:8], "little") == len(content) - 8
    kind = {"Float32": "<f4", "Int64": "<i8"}[element.get("type")]
    return np.frombuffer(content[8:], kind).reshape(-1, int(element.get("NumberOfComponents", 1)))


def require_vtk(folder, expected):
    entries = ElementTree.parse(folder / "trajectory.pvd").getroot().findall("Collection/DataSet")
    assert [float(entry.get("timestep")) for entry in entries] == [frame["time"] for frame in expected]
    assert {path.name for path in folder.iterdir()} == {"trajectory.pvd", "view.py", *(e.get("file") for e in entries)}
    for entry, frame in zip(entries, expected):
        root = ElementTree.parse(folder / entry.get("file")).getroot()
        assert root.get("header_type") == "UInt64"
        piece = root.find("PolyData/Piece")
        count = len(frame["id"])
        assert int(piece.get("NumberOfLines")) == count and int(piece.get("NumberOfPoints")) == 2 * count
        arrays = {element.get("Name"): array_of(element) for element in piece.iter("DataArray")}
        tails, heads = arrays["points"][arrays["connectivity"].reshape(count, 2)].transpose(1, 0, 2)
        assert np.array_equal(arrays["offsets"].ravel(), 2 * np.arange(1, count + 1))
        assert np.allclose((tails + heads) / 2, frame["position"], atol=1e-5)
        assert np.allclose(heads - tails, frame["length"][:, None] * frame["orientation"], atol=1e-5)
        assert np.allclose(arrays["axis"], frame["orientation"], atol=1e-6)
        assert np.array_equal(arrays["id"].ravel(), frame["id"])
        assert np.array_equal(arrays["length"].ravel(), frame["length"])
        assert np.array_equal(arrays["diameter"].ravel(), frame["diameter"])
        assert np.array_equal(arrays["radius"].reshape(count, 2), np.stack(2 * [frame["diameter"] / 2], axis=1))
        require_read_by_vtk(folder / entry.get("file"), frame)
    compile((folder / "view.py").read_text(), "view.py", "exec")


def require_read_by_vtk(path, frame):
    """What VTK itself, which ParaView reads files by, makes of it."""
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    assert reader.GetErrorCode() == 0
    data = reader.GetOutput()
    assert data.GetNumberOfLines() == data.GetNumberOfCells() == len(frame["id"])
    ends = vtk_to_numpy(data.GetPoints().GetData()).reshape(-1, 2, 3)
    assert np.allclose(ends.mean(axis=1), frame["position"], atol=1e-5)
    assert np.allclose(ends[:, 1] - ends[:, 0], frame["length"][:, None] * frame["orientation"], atol=1e-5)
    assert np.array_equal(vtk_to_numpy(data.GetCellData().GetArray("id")), frame["id"])
    assert np.array_equal(vtk_to_numpy(data.GetPointData().GetArray("radius"))[::2], frame["diameter"] / 2)


def require_xyz(path, expected, periodic="T T T"):
    lines = path.read_text().splitlines()
    for frame in expected:
        count = int(lines[0])
        assert count == len(frame["id"])
        x, y, z = frame["edges"]
        assert f'pbc="{periodic}"' in lines[1] and f"Step={frame['step']} " in lines[1]
        assert "Properties=species:S:1:pos:R:3:orientation:R:4:aspherical_shape:R:3:id:I:1 " in lines[1]
        lattice = [float(word) for word in lines[1].split('Lattice="')[1].split('"')[0].split()]
        assert lattice == pytest.approx([x, 0, 0, 0, y, 0, 0, 0, z])
        assert float(lines[1].split("Time=")[1].split()[0]) == pytest.approx(frame["time"])
        numbers = np.array([[float(word) for word in line.split()[1:]] for line in lines[2:2 + count]])
        assert np.allclose(numbers[:, :3], frame["position"], atol=1e-5)
        assert np.allclose(turned_z(numbers[:, [6, 3, 4, 5]]), frame["orientation"], atol=1e-6)
        assert np.allclose(numbers[:, 7:9], frame["diameter"][:, None] / 2)
        assert np.allclose(numbers[:, 9], frame["length"], rtol=1e-6)
        assert np.array_equal(numbers[:, 10], frame["id"])
        lines = lines[2 + count:]
    assert lines == []
    read = ase.io.read(path, index=":", format="extxyz")
    assert len(read) == len(expected)
    for atoms, frame in zip(read, expected):
        assert np.allclose(atoms.positions, frame["position"], atol=1e-5)
        assert np.allclose(atoms.cell.lengths(), frame["edges"])
        assert " ".join("T" if direction else "F" for direction in atoms.pbc) == periodic
        assert np.array_equal(atoms.arrays["id"], frame["id"])
        assert np.allclose(atoms.arrays["aspherical_shape"][:, 2], frame["length"], rtol=1e-6)


REQUIRE = {"gsd": require_gsd, "vtk": require_vtk, "xyz": require_xyz}


@pytest.mark.parametrize("form", OUTPUTS)
def test_a_run(finished_copy, form):
    """Every rod of every frame; a second export takes the place of the first; the run stays as it was."""
    run = finished_copy / "run"
    before, expected = snapshot(run), list(frames_of(run))
    assert len(expected) == 9
    for _ in range(2):
        REQUIRE[form](export(run, form), expected)
    after = snapshot(run)
    assert {name: after[name] for name in before} == before
    assert command(finished_copy, "verify", "run").returncode == DONE


def test_rods_of_one_kind_are_one_type(finished_copy):
    path = export(finished_copy / "run", "gsd")
    first = gsd.hoomd.open(name=str(path), mode="rb")[0]
    assert len(first.particles.types) == 1
    length, diameter = drawn(first)
    assert np.all(length == 2.0) and np.all(diameter == 1.0)
    half = first.configuration.box[:3] / 2
    assert np.all(first.particles.position >= -half) and np.all(first.particles.position < half)


def test_spheres(spheres):
    first = gsd.hoomd.open(name=str(export(finish(spheres), "gsd")), mode="rb")[0]
    assert first.particles.type_shapes == [{"type": "Sphere", "diameter": 1.0}]


@pytest.mark.parametrize("form", OUTPUTS)
def test_rods_that_come_and_go(tmp_path, form):
    """Three rods, five, four, three others: rows with the fill value are no rods; order is that of the ids."""
    frames = [trajectory_by_hand.rods(count, seed) for seed, count in enumerate((3, 5, 4, 3))]
    frames[2]["id"] = np.array([0, 1, 3, 7], np.uint64)
    frames[3]["id"] = np.array([1, 3, 7], np.uint64)
    run = trajectory_by_hand.write(tmp_path / "run", frames)
    expected = list(frames_of(run))
    assert [len(frame["id"]) for frame in expected] == [3, 5, 4, 3]
    found = REQUIRE[form](export(run, form), expected, *(["T T F"] if form == "xyz" else []))
    for made, frame in zip(found or [], expected):  # few lengths are drawn exactly
        length, diameter = drawn(made)
        assert np.allclose(length, frame["length"]) and np.all(diameter == 1.0)


def test_many_lengths_are_drawn_in_64_classes(tmp_path):
    """Lengths 2.5 to 6, as of growing cells: drawn to within half a class, 0.027; exact in the log."""
    frames = [trajectory_by_hand.rods(500, seed, (2.5, 6.0)) for seed in (1, 2)]
    run = trajectory_by_hand.write(tmp_path / "run", frames)
    expected = list(frames_of(run))
    for made, frame in zip(require_gsd(export(run, "gsd"), expected), expected):
        assert len(made.particles.types) == len(set(made.particles.types)) == 64
        length, _ = drawn(made)
        assert np.abs(length - frame["length"]).max() < 3.5 / 64 / 2 + 1e-5


def test_a_place_of_its_own(finished_copy):
    run, other = finished_copy / "run", finished_copy / "pictures"
    other.mkdir()
    before = snapshot(run)
    export(run, "gsd", "--out", "pictures")
    export(run, "xyz", "--out", "pictures/rods.xyz")
    export(run, "vtk", "--out", "pictures/frames")
    assert sorted(path.name for path in other.iterdir()) == ["frames", "rods.xyz", "trajectory.gsd"]
    assert snapshot(run) == before


def test_what_is_refused(finished_copy, tmp_path):
    """Exit 2 and one line; nothing on the disk has changed."""
    (finished_copy / "notes").mkdir()
    (finished_copy / "notes/mine.txt").write_text("keep")
    scene = changed(RODS, output={"trajectory_every": 0, "contacts": False})
    write_scene(tmp_path / "none", changed(scene, time={"production": 0.2}))
    finish(tmp_path / "none")
    trajectory = (tmp_path / "none/run/trajectory.h5")
    before = snapshot(tmp_path)

    def refused(*arguments, folder=finished_copy):
        return command(folder, "export", *arguments)

    require_one_line(refused("absent", "--to", "gsd"), "absent", "there is no such folder")
    require_one_line(refused("notes", "--to", "gsd"), "not the folder of a run")
    require_one_line(refused("scene.toml", "--to", "gsd"), "not the folder of a run")
    require_one_line(refused("run", "--to", "pdb"), "pdb", "allowed: gsd, vtk, xyz")
    require_one_line(refused("run", "--to", "vtk", folder=tmp_path / "none"), str(trajectory.name), "trajectory_every")
    require_one_line(refused("run", "--to", "gsd", "--out", "run/series.csv"), "is not replaced")
    require_one_line(refused("run", "--to", "xyz", "--out", "run/trajectory.h5"), "is not replaced")
    require_one_line(refused("run", "--to", "vtk", "--out", "run"), "is not replaced")
    require_one_line(refused("run", "--to", "vtk", "--out", "notes"), "is not replaced")
    require_one_line(refused("run", "--to", "vtk", "--out", "scene.toml"), "is not replaced")
    require_one_line(refused("run", "--to", "xyz", "--out", "nowhere/rods.xyz"), "nowhere", "there is no such folder")
    assert snapshot(tmp_path) == before


def test_a_trajectory_not_made_yet(torn_copy):
    (torn_copy / "run/trajectory.h5").unlink(missing_ok=True)
    require_one_line(command(torn_copy, "export", "run", "--to", "gsd"), "made when the run stops")


def test_damage_is_refused(finished_copy):
    path = finished_copy / "run/trajectory.h5"
    flip_bit(path, 8 * 4)  # within the file's signature
    require_one_line(command(finished_copy, "export", "run", "--to", "xyz"), "cannot be read", "jostle verify")
    assert not list((finished_copy / "run").glob("*.xyz"))


@pytest.mark.parametrize("module, package", [("gsd", "python3-gsd"), ("h5py", "python3-h5py")])
def test_a_missing_module_is_named(finished_copy, module, package):
    """Hidden here by a module of that name that is not to be had."""
    hidden = finished_copy / "hidden"
    hidden.mkdir()
    (hidden / f"{module}.py").write_text("raise ImportError('hidden')\n")
    result = subprocess.run([JOSTLE, "export", "run", "--to", "gsd"], cwd=finished_copy, capture_output=True, text=True,
                            env={**os.environ, "PYTHONPATH": str(hidden)}, check=False, timeout=60)
    require_one_line(result, module, f"apt-get install {package}")


@pytest.mark.parametrize("form", OUTPUTS)
def test_a_full_disk(finished_copy, form):
    """Exit 4, and nothing is left of what was begun."""
    run = finished_copy / "run"
    before = snapshot(run)
    result = command(finished_copy, "export", "run", "--to", form, preexec_fn=file_size_limit(2000))
    assert result.returncode == DISK and result.stderr.count("\n") == 1, result.stderr
    assert f"run/{OUTPUTS[form]}: cannot write: File too large. Nothing was changed; make room, or" in result.stderr
    assert snapshot(run) == before


@pytest.mark.parametrize("form", OUTPUTS)
def test_a_folder_whose_name_is_not_utf_8(finished_copy, form):
    """Names of files are bytes."""
    folder = finished_copy / os.fsdecode(b"caf\xe9\x1b[31m")
    (finished_copy / "run").rename(folder)
    for _ in range(2):  # the second takes the place of the first
        result = subprocess.run([JOSTLE, "export", os.fsencode(folder), "--to", form], capture_output=True, timeout=60)
        assert result.returncode == DONE, result.stderr
        assert result.stdout.startswith(os.fsencode(folder / OUTPUTS[form])) and result.stderr == b""
    assert (folder / OUTPUTS[form]).exists()
    (folder / "trajectory.h5").unlink()
    result = subprocess.run([JOSTLE, "export", os.fsencode(folder), "--to", form], capture_output=True, timeout=60)
    assert result.returncode == BAD_INPUT and b"caf\\xe9\\x1b[31m/trajectory.h5: " in result.stderr


def test_a_place_that_cannot_be_written(finished_copy):
    """Advice to make room would be out of place."""
    for out, reason in (("/proc/x.gsd", "No such file or directory"), ("/dev/full/x.gsd", "there is no such folder")):
        result = command(finished_copy, "export", "run", "--to", "gsd", "--out", out)
        assert result.returncode in (DISK, BAD_INPUT) and reason in result.stderr and "make room" not in result.stderr


def test_an_installed_command_takes_what_is_installed_with_it(finished_copy):
    installed = finished_copy / "prefix/share/jostle/presentation"
    installed.mkdir(parents=True)
    (finished_copy / "prefix/bin").mkdir()
    program = shutil.copy(shutil.which(JOSTLE), finished_copy / "prefix/bin/jostle")
    (installed / "export.py").write_text("import sys\nprint(sys.argv[1:])\nraise SystemExit(4)\n")
    result = subprocess.run([program, "export", "run", "--to", "gsd"], cwd=finished_copy, capture_output=True,
                            text=True, check=False, timeout=60)
    assert result.returncode == DISK  # the status is that of the program
    assert result.stdout == "['--to=gsd', '--out=', '--', 'run']\n"
