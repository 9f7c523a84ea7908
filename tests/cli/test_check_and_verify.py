"""`jostle check` says what a scene means; `jostle verify` says whether a run is sound. Neither changes anything."""

import math
import re
import tomllib

import pytest

from jostle_command import (DONE, RODS, changed, command, require_one_line, run, snapshot, write_scene)

# The cells of the paper: L 2.5 um, D 1 um, water at room temperature.
CELLS = """
[units]
system = "micro"
[box]
edges = [100, 100, "100 um"]
[rods]
count = 100
length = "2500 nm"
diameter = "1 um"
[fluid]
viscosity = "1e-3 Pa s"
kT = "0.00411 pN um"
[mobility]
model = "slender_body"
[motion]
self_propulsion = "2 um/s"
[time]
step = "0.1 ms"
equilibration = 0
production = "1 s"
[output]
trajectory_every = 100
"""


def check(folder, scene):
    """The resolved scene, read as TOML, and the derived numbers by name."""
    write_scene(folder, scene)
    before = snapshot(folder)
    result = command(folder, "check", "scene.toml")
    assert result.returncode == DONE, result.stderr
    assert result.stderr == "" and snapshot(folder) == before
    resolved, derived = result.stdout.split("\n# what follows from it\n")
    return tomllib.loads(resolved), {line[:28].strip(): line[29:] for line in derived.splitlines()}


def number(text):
    return float(re.match(r"[-+0-9.e]+", text)[0])


def test_cells_of_the_paper(tmp_path):
    scene, derived = check(tmp_path, CELLS)
    assert scene["rods"]["length"] == 2.5 and scene["box"]["edges"] == [100.0, 100.0, 100.0]
    assert scene["fluid"] == {"viscosity": 0.001, "kT": 0.00411} and scene["time"]["step"] == 1e-4
    rotation, rotation_time = derived["D_R, 1/D_R"].split(", ")
    assert rotation_time.endswith(" s") and rotation.endswith(" 1/s")
    assert number(rotation_time) == pytest.approx(1.887, abs=0.0005)
    assert number(rotation) == pytest.approx(1.0 / number(rotation_time), rel=1e-4)
    assert number(derived["U_0/(L D_R)"]) == pytest.approx(1.510, abs=0.0005)
    assert number(derived["dt D_R"]) == pytest.approx(5.3e-5, rel=0.01)
    # The slender-body drag by hand.
    b, length, viscosity, kT = -(1.0 + 2.0 * math.log(1.0 / 5.0)), 2.5, 1e-3, 0.00411
    along = 2.0 * b * kT / (8.0 * math.pi * length * viscosity)
    across = (b + 2.0) * kT / (8.0 * math.pi * length * viscosity)
    both = derived["D_parallel, D_perpendicular"].split(", ")
    assert number(both[0]) == pytest.approx(along, rel=1e-5)
    assert number(both[1]) == pytest.approx(across, rel=1e-5)
    assert number(derived["D_t of the fastest rod"]) == pytest.approx((along + 2.0 * across) / 3.0, rel=1e-5)
    assert number(derived["rms step / D"]) == pytest.approx(math.sqrt(2e-4 * (along + 2.0 * across) / 3.0), rel=1e-3)
    volume = 100 * math.pi * (2.5 / 4.0 + 1.0 / 6.0)
    assert number(derived["phi"]) == pytest.approx(volume / 1e6, rel=1e-5)
    assert derived["N"] == "100" and number(derived["L/D"]) == 2.5
    assert derived["box"] == "100 x 100 x 100 um" and derived["time step"] == "0.0001 s"
    assert derived["steps"] == "10000"
    assert "Pa" in derived["units"]


def test_costs_grow_with_the_run(tmp_path):
    names = ("memory, about", "disk, about", "time on one thread, about")
    _, small = check(tmp_path, CELLS)
    _, large = check(tmp_path, CELLS.replace("count = 100", "count = 10000").replace("100, 100", "300, 300"))
    for name in names:
        assert 0.0 < number(small[name]) < number(large[name]), name
    assert small[names[0]].endswith(" MB") and small[names[1]].endswith(" MB") and small[names[2]].endswith(" s")


def test_growing_cells(tmp_path):
    cells = changed(RODS, rods={"count": 50, "length": 1.0}, growth={"rate": 0.5, "division_length": 3.0},
                    time={"production": 8.0}, box={"volume_fraction": 0.02})
    _, derived = check(tmp_path, cells)
    assert number(derived["doubling time"]) == 4.0  # (3 + 1)/2 at rate 0.5
    assert derived["N in the end, about"] == "200" and derived["phi in the end, about"] == "0.08"
    _, longer = check(tmp_path, changed(cells, time={"production": 24.0}))
    assert longer["phi in the end, about"].endswith(": cells have no room to grow so many")
    _, colony = check(tmp_path, changed(cells, box={"volume_fraction": None, "edges": [99.0, 99.0, 99.0], "periodic": [False, False, False]}))
    assert "phi in the end, about" not in colony and colony["time on one thread, about"].startswith("not known")
    _, dying = check(tmp_path, changed(cells, growth={"death_rate": math.log(2.0) / 4.0}))
    assert dying["N in the end, about"] == "50"


def test_cells_that_grow_beyond_all_bounds(tmp_path):
    cells = changed(RODS, rods={"count": 50, "length": 1.0}, growth={"rate": 0.5, "division_length": 3.0},
                    time={"production": 1e6}, box={"volume_fraction": 0.02})
    _, derived = check(tmp_path, cells)
    assert derived["N in the end, about"] == "more than any run can hold: end it earlier"
    assert "inf" not in " ".join(derived.values()) and "memory, about" not in derived


def test_the_fastest_swimmer(tmp_path):
    _, derived = check(tmp_path, changed(RODS, motion={"self_propulsion": 1.0, "self_propulsion_deviation": 1.0}))
    assert 0.04 < number(derived["propelled per step / D"]) < 0.1  # of 50 rods, some 2.2 deviations above the mean


def test_a_step_from_an_accuracy(tmp_path):
    """The error of a step is of second order: a quarter of it takes half the step."""
    steps = []
    for accuracy in (0.008, 0.002):
        _, derived = check(tmp_path, changed(RODS, time={"step": None, "accuracy": accuracy}))
        assert derived["error of Z by the step"] == f"about {100 * accuracy:g} %, by the largest that was measured of isotropic fluids"
        steps.append(number(derived["rms step / D"]))
    assert steps[0] == pytest.approx(2 * steps[1], rel=1e-3) and 0.025 < steps[1] < 0.035


def test_defaults_are_spelled_out(tmp_path):
    """The resolved scene holds every key, means the same, and is what a run keeps."""
    scene, derived = check(tmp_path, changed(RODS, time={"step": None}))
    assert scene["time"]["step"] == "auto" and "rms_step" not in scene["time"]
    assert number(derived["rms step / D"]) == pytest.approx(0.04, rel=1e-3)
    assert set(scene) == {"title", "seed", "units", "box", "rods", "fluid", "mobility", "motion", "growth", "contact",
                          "solver",
                          "time", "output", "walls", "forces", "flow"}
    assert scene["solver"] == {"method": "auto", "warm_start": "auto", "step_rule": "bb1", "residual": "length",
                               "tolerance": 1e-5, "max_iterations": 10000}
    assert scene["contact"] == {"model": "hard", "brownian_correction": True, "range": "auto", "overlap_limit": 0.2}
    assert run(tmp_path).returncode == DONE
    resolved = (tmp_path / "run/resolved.toml").read_text()
    assert tomllib.loads(resolved) == scene
    assert check(tmp_path, resolved) == (scene, derived)


def test_check_reads_the_rods_file(tmp_path):
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz,length\n1,1,1,1,0,0,2\n5,5,5,0,0,1,4\n")
    _, derived = check(tmp_path, changed(RODS, box={"volume_fraction": None, "edges": [10.0, 10.0, 10.0]},
                                         rods={"count": None, "start": "file", "file": "rods.csv"}))
    assert derived["N"] == "2"
    volume = math.pi * (2.0 / 4.0 + 1.0 / 6.0) + math.pi * (4.0 / 4.0 + 1.0 / 6.0)
    assert number(derived["phi"]) == pytest.approx(volume / 1000.0, rel=1e-5)


def test_a_lattice_that_has_no_room_is_found_by_check(tmp_path):
    write_scene(tmp_path, changed(RODS, rods={"count": 12, "start": "lattice"}, box={"volume_fraction": None, "edges": [7.0, 2.5, 2.5]}))
    checked = command(tmp_path, "check", "scene.toml")
    require_one_line(checked, 'rods.start = "lattice": 12 rods do not fit into the box in rows')
    assert run(tmp_path).stderr == checked.stderr
    assert not (tmp_path / "run").exists()


def test_without_brownian_motion(tmp_path):
    _, derived = check(tmp_path, changed(RODS, motion={"brownian": False, "self_propulsion": 0.5}))
    assert "D_R, 1/D_R" not in derived and "rms step / D" not in derived
    assert number(derived["propelled per step / D"]) == pytest.approx(0.01)


def test_verify_of_a_sound_run(finished_copy):
    before = snapshot(finished_copy)
    lock = (finished_copy / "run/lock").read_bytes()
    result = command(finished_copy, "verify", "run")
    assert result.returncode == DONE and result.stderr == ""
    assert result.stdout == ("checkpoint.previous: sound, step 96\ncheckpoint: sound, step 100\n"
                             "series.csv: sound, 20 rows\ntrajectory.journal: sound, 9 frames\n"
                             "trajectory.h5: sound\n"
                             "scene.toml: sound\nresolved.toml: sound\nseries.json: sound\ncontacts.json: sound\n"
                             "run.json: sound\nsummary.json: sound\n")
    assert snapshot(finished_copy) == before and (finished_copy / "run/lock").read_bytes() == lock


def test_verify_of_no_run(tmp_path):
    require_one_line(command(tmp_path, "verify", "nothing"), "nothing: this is not the folder of a run")
    assert not (tmp_path / "nothing").exists()
