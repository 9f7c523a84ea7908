"""Input that jostle refuses: exit 2, one line that says where and why, and nothing on the disk has changed."""

import pytest

from jostle_command import (BAD_INPUT, DONE, RODS, Verbatim, changed, command, place_of, require_one_line,
                            require_refused, scene_text, snapshot, write_scene)

NUMBER = "a number in D"
# table, key, value, what the message says
VALUES = [
    ("rods", "lenght", 5.0, "is an unknown key", 'Did you mean "length"?'),
    ("time", "steps", 0.01, "is an unknown key", 'Did you mean "step"?'),
    ("box", "viscosity", 1.0, "is an unknown key", 'The key "viscosity" belongs to [fluid]'),
    ("fluids", "viscosity", 1.0, "is an unknown table", 'Did you mean "fluid"?'),
    ("rods", "length", "five", "is a text, the wrong type", NUMBER),
    ("rods", "length", "5.0", "is a text, the wrong type", "Remove the quotes: 5.0"),
    ("rods", "length", True, "is true or false, the wrong type", NUMBER),
    ("rods", "length", [5.0], "is an array, the wrong type", NUMBER),
    ("rods", "length", "2 um", "carries a unit, and the scene is in reduced units", 'set units.system = "micro"'),
    ("rods", "count", 50.5, "is not a whole number", "at least 1"),
    ("rods", "count", -50, "is negative", "at least 1"),
    ("rods", "count", 0, "is outside the allowed range", "at least 1"),
    ("output", "contacts", 1, "is a whole number, the wrong type", "true or false"),
    ("output", "contacts", "true", "is a text, the wrong type", "Remove the quotes: true"),
    ("rods", "start", "randon", "is not one of the words", 'Did you mean "random"?'),
    ("mobility", "model", "slender", "is not one of the words", '"slender_body"'),
    ("rods", "length", -2.0, "is negative", "at least 0"),
    ("rods", "diameter", 0.0, "is zero", "greater than 0"),
    ("fluid", "viscosity", -1.0, "is negative", "greater than 0"),
    ("fluid", "kT", -1.0, "is negative", "at least 0"),
    ("time", "step", -0.01, "is negative", "greater than 0"),
    ("time", "equilibration", -1.0, "is negative", "at least 0"),
    ("rods", "length", Verbatim("nan"), "is not a finite number", "at least 0"),
    ("fluid", "kT", Verbatim("inf"), "is not a finite number", "at least 0"),
    ("time", "production", Verbatim("-inf"), "is not a finite number", "greater than 0"),
    ("box", "volume_fraction", Verbatim("nan"), "is not a finite number", "less than 1"),
    ("box", "volume_fraction", 0.0, "is zero", "greater than 0"),
    ("box", "volume_fraction", 1.5, "is outside the allowed range", "less than 1"),
    ("box", "volume_fraction", 0.95, "cannot be packed", "a volume fraction of at most 0.8"),
    ("box", "volume_fraction", 0.7, "is too dense for a random start", 'start = "aligned" or "lattice"'),
    ("box", "periodic", [True, True], "has 2 elements", "three elements: x, y, z"),
    ("box", "shape", [1.0, -1.0, 1.0], "is negative", "at least"),
    ("solver", "tolerance", 0.5, "is outside the allowed range", "less than 0.1"),
    ("solver", "max_iterations", 0, "is outside the allowed range", "at least 1"),
    ("time", "production", 0.001, "is shorter than one step", "at least time.step = 0.02"),
    ("time", "rms_step", 0.03, "is given beside time.step", "one of the two"),
    ("rods", "axis", [1, 0, 0], "is not used with rods.start", 'Set start = "aligned"'),
    ("contact", "model", "soft", "is not one of the words", '"wca"'),
    ("motion", "self_propulsion", -1.0, "is negative", "at least 0"),
    ("motion", "tumble_rate", 1.0, "is not used with motion.self_propulsion = 0", "Set self_propulsion"),
    ("motion", "self_propulsion_deviation", 0.5, "is not used with motion.self_propulsion = 0", "Set self_propulsion"),
    ("motion", "reversal_rate", 0.0, "is not used with motion.self_propulsion = 0", "or remove it"),
    ("flow", "shear_rate", Verbatim("nan"), "is not a finite number", "a finite number"),
    ("flow", "strain_amplitude", -0.1, "is negative", "at least 0"),
    ("flow", "start_strain", 1e7, "is outside the allowed range", "at most 1000000"),
    ("forces", "on_rods", [0, 0, -1], "drags the rods without end", "[0, 0, 0], or drift = true"),
    ("forces", "on_rods", Verbatim("[0, nan, 0]"), "is not a finite number", "a finite number"),
    ("forces", "on_rods", [0, -1], "has 2 elements", "three elements: x, y, z"),
    ("pressure", "external", -1.0, "is negative", "greater than 0"),
    ("pressure", "external", 0.0, "is zero", "greater than 0"),
    ("pressure", "relaxation_time", 1.0, "is not used without pressure.external", "Set external"),
    ("pressure", "coupling", "orthogonal", "is not used without pressure.external", "the volume stays"),
    ("forces", "drift", True, "is not used without a force on the rods", "Set on_rods"),
    ("forces", "alignment_energy", Verbatim("inf"), "is not a finite number", "a finite number"),
    ("forces", "alignment_axis", [1, 0, 0], "is not used with forces.alignment_energy = 0", "Set alignment_energy"),
    ("output", "active_stress_lag", 3.0, "is not used with motion.self_propulsion = 0", "nothing swims"),
    ("contact", "range", 1e12, "reaches beyond what a rod can touch: the longest measures 3 from end to end", "at most 3"),
    ("contact", "energy", 1.0, 'is not used with contact.model = "hard"', 'Set model = "wca"'),
    ("growth", "rate", -1.0, "is negative", "at least 0"),
    ("growth", "death_rate", 0.1, "is not used without growth.rate", "Add rate"),
]
# changes of a table [growth] with rate 0.1 and division length 5, what the message says
GROWTH = [
    ({"division_length": None}, "growth.division_length", "is missing", "Add division_length = 5"),
    ({"division_length": 1.0}, "is not above what two daughters need", "greater than 1"),
    ({"division_length": 2.0}, "is not above rods.length = 2", "greater than 2"),
    ({"rate": 6.0}, "in a step of 0.02, the fastest cells lengthen by 0.12 D", "at most 5"),
    ({"rate": 4.0, "rate_deviation": 0.1}, "in a step of 0.02, the fastest cells lengthen by 0.112 D", "at most 3.571"),
    ({"rate_deviation": -0.1}, "is negative", "at least 0"),
    ({"division_deviation": 0.9}, "is outside the allowed range", "at most 0.5"),
    ({"division": "size"}, "is not one of the words", 'Did you mean "sizer"?'),
    ({"stall_force": 0.0}, "is zero", "greater than 0"),
    ({"stall_force": 1.0, "stall_memory": 0.0}, "growth.stall_memory = 0.0: is zero", "greater than 0"),
    ({"stall_memory": 1.0}, "is not used without growth.stall_force", "Set stall_force"),
    ({"death_rate": -1.0}, "is negative", "at least 0"),
    ({"division_every": 0}, "is outside the allowed range", "at least 1"),
    ({"division_every": 400}, "lets cells divide late", "birth to division, is 0.2667", "at most 375"),
]


def value_id(entry):
    return f"{entry[0]}.{entry[1]}={entry[2]}"


def refuse(folder, scene, *parts):
    """`run` and `check` both refuse the scene, in a new folder and over a finished run, and change nothing."""
    write_scene(folder, scene)
    before = snapshot(folder)
    require_one_line(command(folder, "check", "scene.toml"), *parts)
    require_one_line(command(folder, "run", "scene.toml", "--out", "new/run"), *parts)
    for options in ([], ["--fresh"]):
        require_one_line(command(folder, "run", "scene.toml", "--out", "run", *options), *parts)
    assert snapshot(folder) == before


@pytest.mark.parametrize("entry", VALUES, ids=value_id)
def test_value(finished_copy, entry):
    table, key, value, *parts = entry
    text = scene_text(changed(RODS, **{table: {key: value}}))
    line, at = place_of(text, table, key).split(":")
    if "is an unknown key" in parts:
        at = "1"  # the key's own place
    if "is an unknown table" in parts:
        line, at = int(line) - 1, "2"
    told = [] if "is an unknown table" in parts else [f"{table}.{key} = "]
    refuse(finished_copy, text, f"jostle: scene.toml:{line}:{at}: ", *told, *parts)


@pytest.mark.parametrize("entry", GROWTH, ids=lambda entry: str(entry[0]))
def test_growth(finished_copy, entry):
    changes, *parts = entry
    refuse(finished_copy, changed(RODS, growth={"rate": 0.1, "division_length": 5.0, **changes}), *parts)


# Of rods that swim and tumble.
SWIMMERS = [
    ("self_propulsion", 26.0, "takes a rod through others: in a step of 0.02", "at most 25, or a step of at most 0.0192", "slower swimmers"),
    ("self_propulsion", -26.0, "is negative", "at least 0"),
    ("self_propulsion_deviation", -0.5, "is negative", "at least 0"),
    ("self_propulsion_deviation", Verbatim("nan"), "is not a finite number", "at least 0"),
    ("tumble_rate", -1.0, "is negative", "at least 0"),
    ("tumble_rate", Verbatim("inf"), "is not a finite number", "at least 0"),
    ("tumble_rate", 0.0, None),
    ("tumble_rate", 60.0, "makes more than one tumble in a time step", "at most 50"),
    ("tumble_time", 0.0, "is zero", "greater than 0"),
    ("tumble_time", 21.0, "leaves rods no time to swim between tumbles", "at most 20"),
    ("tumble_time", 0.1, "is too short: the ends of a rod would pass through others", "at least 0.25"),
    ("reversal_rate", -1.0, "is negative", "at least 0"),
    ("reversal_rate", Verbatim("-inf"), "is not a finite number", "at least 0"),
]


@pytest.mark.parametrize("entry", SWIMMERS, ids=lambda entry: f"{entry[0]}={entry[1]}")
def test_swimmers(finished_copy, entry):
    key, value, *parts = entry
    motion = {"self_propulsion": 1.0, "self_propulsion_deviation": 0.1, "tumble_rate": 0.5, "tumble_time": 0.4,
              "reversal_rate": 0.5}
    if value == 60.0:
        motion["tumble_time"] = None
    scene = changed(changed(RODS, motion=motion), motion={key: value})
    if parts[0] is None:  # then it is the time that means nothing
        key, value, parts = "tumble_time", 0.4, ["is not used with motion.tumble_rate = 0", "Set tumble_rate"]
    at = place_of(scene_text(scene), "motion", key)
    refuse(finished_copy, scene, f"jostle: scene.toml:{at}: motion.{key} = ", *parts)


def test_swimmers_too_fast_for_a_step_from_the_diffusion(tmp_path):
    scene = changed(RODS, motion={"self_propulsion": 1.0, "tumble_rate": 0.5, "tumble_time": 0.01}, time={"step": None, "rms_step": 0.03})
    write_scene(tmp_path, scene)
    at = place_of(scene_text(scene), "motion", "tumble_time")
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), f"jostle: scene.toml:{at}: motion.tumble_time = 0.01: is too short",
                         "(allowed: at least ", "Use a shorter time.step or slower tumbles")
    scene = changed(scene, motion={"self_propulsion": 3000.0, "tumble_time": None})
    write_scene(tmp_path, scene)
    at = place_of(scene_text(scene), "motion", "self_propulsion")
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), f"jostle: scene.toml:{at}: motion.self_propulsion = 3000.0: takes a rod",
                         "(allowed: at most ", "Use a shorter time.step or slower swimmers")
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["scene.toml"]


@pytest.mark.parametrize("production, part", [(1e-20, "is shorter than one step"), (1e29, "takes more than 1e+15 steps")])
def test_times_beside_a_step_from_the_diffusion(tmp_path, production, part):
    write_scene(tmp_path, changed(RODS, time={"step": None, "rms_step": 0.03, "production": production}))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), f"scene.toml:9:14: time.production = {production}: ", part)
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["scene.toml"]


@pytest.mark.parametrize("division", ["sizer", "adder", "timer"])
def test_slender_daughters_of_cells_that_divide_early(tmp_path, division):
    growth = {"rate": 0.1, "division_length": 5.0, "division": division}
    scene = changed(RODS, rods={"length": 3.0}, mobility={"model": "slender_body"})
    write_scene(tmp_path, changed(scene, growth=growth))
    assert command(tmp_path, "check", "scene.toml").returncode == DONE
    require_refused(tmp_path, changed(scene, growth={**growth, "division_deviation": 0.15}), "makes daughters as short as L/D = ", "capsule")


@pytest.mark.parametrize("diameters, model, parts", [
    ((1.0, 3.0), "capsule", ["growth.division_length = 2.9: is not above what two daughters need", "greater than 3"]),
    ((1.0, 1.2), "slender_body", ["makes daughters as short as L/D = 0.7083", "capsule"]),
    ((1.0, 0.02), "capsule", ["growth.rate = 0.2: lengthens cells so far", "lengthen by 0.2 D"]),
])
def test_growth_of_cells_from_a_file(tmp_path, diameters, model, parts):
    """What holds for cells of diameter 1 need not for all of the file."""
    lines = [f"{x},5,5,0,0,1,2,{diameter}" for x, diameter in zip((2, 7), diameters)]
    (tmp_path / "rods.csv").write_text("x,y,z,nx,ny,nz,length,diameter\n" + "\n".join(lines) + "\n")
    write_scene(tmp_path, changed(RODS, box={"volume_fraction": None, "edges": [30.0, 30.0, 30.0]}, mobility={"model": model},
                                  rods={"count": None, "start": "file", "file": "rods.csv"},
                                  growth={"rate": 0.2, "division_length": 2.9, "division_every": 1}))
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), *parts)


@pytest.mark.parametrize("growth", [None, {"rate": 0.1, "division_length": 5.0}])
def test_fastest_swimmers(tmp_path, growth):
    """Of 50 the fastest is some two deviations above the mean; of daughters that are to come, four count."""
    scene = changed(RODS, motion={"self_propulsion": 1.0, "self_propulsion_deviation": 7.0 if growth else 30.0})
    write_scene(tmp_path, changed(scene, growth=growth) if growth else scene)
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), "motion.self_propulsion = ", "takes a rod through others",
                         "(allowed: at most 25, or a step of at most ")


@pytest.mark.parametrize("table, key, example", [("rods", "count", "count = 2000"), ("rods", "length", "length = 5.0"),
                                                 ("time", "production", "production = 50.0")])
def test_missing_key(tmp_path, table, key, example):
    write_scene(tmp_path, changed(RODS, **{table: {key: None}}))
    line = scene_text(changed(RODS, **{table: {key: None}})).splitlines().index(f"[{table}]") + 1
    require_one_line(command(tmp_path, "check", "scene.toml"), f"scene.toml:{line}:1: {table}.{key}: is missing",
                     f"Add {example}")


@pytest.mark.parametrize("table, key, value, problem", [("time", "production", 1e-12, "is shorter than one step"),
                                                        ("output", "field_spacing", 1e-3, "makes too many cells"),
                                                        ("motion", "self_propulsion", 1e6, "takes a rod through others")])
def test_what_is_found_once_there_are_rods_has_its_place(tmp_path, table, key, value, problem):
    scene = changed(RODS, time={"step": None, "rms_step": 0.03}, output={"field_every": 5})
    scene = changed(scene, **{table: {key: value}})
    write_scene(tmp_path, scene)
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scene.toml"), f"jostle: scene.toml:{place_of(scene_text(scene), table, key)}: "
                         f"{table}.{key} = {value}: {problem}")


def test_thin_box(finished_copy):
    scene = changed(RODS, box={"volume_fraction": None, "edges": [30.0, 30.0, 0.9]})
    refuse(finished_copy, scene, f"scene.toml:{place_of(scene_text(scene), 'box', 'edges')}: box.edges = "
           "[30.0, 30.0, 0.9]: makes the box thinner than a rod's diameter: edge z is 0.9",
           "(allowed: edges of at least 1)", "Enlarge that edge")


def test_slender_body_of_short_rods(finished_copy):
    scene = changed(RODS, rods={"length": 0.8}, mobility={"model": "slender_body"})
    refuse(finished_copy, scene, f"scene.toml:{place_of(scene_text(scene), 'mobility', 'model')}: mobility.model = "
           '"slender_body": gives rods of L/D = 0.8 a negative drag', "(allowed: L/D greater than 0.824)",
           'Use model = "capsule"')
    write_scene(finished_copy, changed(scene, rods={"length": 0.83}))
    assert command(finished_copy, "check", "scene.toml").returncode == DONE


TRUNCATED = {
    "in a text": ('[rods]\ncount = 50\nlength = 2.0\nstart = "rand', "scene.toml:4:",
                  "the file ends in the middle of an entry", "is the file cut short?"),
    "in an array": ("[box]\nedges = [10.0, 10.", "scene.toml:2:", "the file ends in the middle of an entry"),
    "after =": ("[rods]\ncount =", "scene.toml:2:", "rods.count: the file ends in the middle of an entry"),
    "in a heading": ("seed = 1\n[rods", "scene.toml:2:", ""),
    "before the end": ("[rods]\ncount = 50\nlength = 2.0\n[box]\nvolume_fraction = 0.2\n", "scene.toml:",
                       "time.production: is missing"),
    "empty": ("", "scene.toml:1:1: ", "is empty"),
    "twice": ("seed = 1\nseed = 2\n", "scene.toml:2:", "is given twice"),
}


@pytest.mark.parametrize("name", TRUNCATED)
def test_truncated_scene(finished_copy, name):
    text, *parts = TRUNCATED[name]
    refuse(finished_copy, text, *parts)


def test_missing_scene(tmp_path):
    write_scene(tmp_path, RODS)
    for name in ("check", "run"):
        require_one_line(command(tmp_path, name, "scenes.toml"), "scenes.toml: scene: there is no such file",
                         'Did you mean "scene.toml"?')
        require_one_line(command(tmp_path, name, "."), "is a directory")
    (tmp_path / "binary.toml").write_bytes(b"\x00\x01\x02")
    require_one_line(command(tmp_path, "check", "binary.toml"), "binary.toml:1: scene: is not a text file")
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["binary.toml", "scene.toml"]


FILE_START = changed(RODS, rods={"count": None, "start": "file", "file": "rods.csv"},
                     box={"volume_fraction": None, "edges": [12.0, 12.0, 12.0]})
HEADER = "x,y,z,nx,ny,nz\n"
RODS_FILES = {
    "no such file": (None, "scene.toml:7:8: rods.file = \"rods.csv\": there is no such file: rods.csv"),
    "empty": ("", "rods.csv"),
    "no rods": (HEADER, "rods.csv", "the file holds no rods"),
    "missing column": ("x,y,z,nx,ny\n1,1,1,1,0\n", 'rods.csv:1: the column "nz" is missing',
                       "x,y,z,nx,ny,nz and optionally length,diameter,speed"),
    "speeds of rods that do not swim": ("x,y,z,nx,ny,nz,speed\n1,1,1,1,0,0,2\n", "motion.self_propulsion = 0",
                                        "rods.csv has a column speed"),
    "unknown column": ("x,y,z,nx,ny,nz,mass\n1,1,1,1,0,0,2\n", 'rods.csv:1: "mass" is no column of a rods file'),
    "column twice": ("x,y,z,nx,ny,nz,x\n1,1,1,1,0,0,2\n", 'rods.csv:1: the column "x" stands twice'),
    "bad number": (HEADER + "1,1,1,1,0,0\n5,5,five,1,0,0\n", "rods.csv:3: ", '"five"', "z"),
    "not finite": (HEADER + "1,1,1,1,0,0\n5,nan,5,1,0,0\n", "rods.csv:3: ", "nan", "y"),
    "cell too many": (HEADER + "1,1,1,1,0,0\n5,5,5,1,0,0,7\n", "rods.csv:3: 7 cells, but the header names 6"),
    "too large": (HEADER + "1e300,1,1,1,0,0\n", "rods.csv:2: x = 1e300 does not lie within 1e-30 and 1e30"),
    "too small": ("x,y,z,nx,ny,nz,diameter\n1,1,1,1,0,0,1e-40\n", "rods.csv:2: diameter = 1e-40"),
    "cell missing": (HEADER + "1,1,1,1,0,0\n5,5,5,1\n", "rods.csv:3: 4 cells, but the header names 6"),
    "no direction": (HEADER + "1,1,1,0,0,0\n", "rods.csv:2: ", "has no direction"),
    "negative length": ("x,y,z,nx,ny,nz,length\n1,1,1,1,0,0,-2\n", "rods.csv:2: ", "length = -2 is negative"),
    "no diameter": ("x,y,z,nx,ny,nz,diameter\n1,1,1,1,0,0,0\n", "rods.csv:2: ", "diameter = 0 is not positive"),
    "overlap": (HEADER + "1,1,1,1,0,0\n1,1.5,1,1,0,0\n", "scene.toml", 'rods.file = "rods.csv"',
                "overlap by up to 0.5", "(allowed: overlaps up to 0.001)"),
    "overlap through the box": (HEADER + "6,6,0.2,1,0,0\n6,6,11.9,1,0,0\n", "overlap by up to 0.7"),
    "far away": (HEADER + "1,1,1,1,0,0\n5,-1.3e7,5,1,0,0\n", "rods.csv = rod 1: lies far outside the box: y = -13000000",
                 "(allowed: -1.2e+07 to 1.2e+07)"),
    "other diameters": ("x,y,z,nx,ny,nz,diameter\n1,1,1,1,0,0,0.01\n5,5,5,1,0,0,0.5\n", "rods.diameter = 1: is no diameter of the rods",
                        "(allowed: 0.01 to 0.5)", "Set it to the mean"),
    "too thick for the box": ("x,y,z,nx,ny,nz,diameter\n6,6,6,1,0,0,12.5\n9,9,9,1,0,0,1\n", "thinner than a rod's diameter"),
}


@pytest.mark.parametrize("name", RODS_FILES)
def test_rods_file(finished_copy, name):
    text, *parts = RODS_FILES[name]
    if text is not None:
        (finished_copy / "rods.csv").write_text(text)
    write_scene(finished_copy, FILE_START)
    before = snapshot(finished_copy)
    require_one_line(command(finished_copy, "run", "scene.toml", "--out", "new"), *parts)
    require_one_line(command(finished_copy, "run", "scene.toml", "--out", "run", "--fresh"), *parts)
    require_one_line(command(finished_copy, "check", "scene.toml"), *parts)
    assert snapshot(finished_copy) == before


def test_rods_file_of_another_count(tmp_path):
    (tmp_path / "rods.csv").write_text(HEADER + "1,1,1,1,0,0\n5,5,5,1,0,0\n")
    write_scene(tmp_path, changed(FILE_START, rods={"count": 3}))
    require_one_line(command(tmp_path, "run", "scene.toml", "--out", "run"), "scene.toml", "rods.count = 3", "2 rods")
    assert not (tmp_path / "run").exists()


@pytest.mark.parametrize("written, shown", [
    ('"a\\nb.csv"', "a\\nb.csv"), ('"\\u0000"', "\\x00"), ('"\\u001b[31m.csv"', "\\x1b[31m.csv"), ('"\\u202e.csv"', "\\u202e.csv")])
def test_names_of_files_that_a_terminal_would_obey(tmp_path, written, shown):
    """They made two lines, none, or colours."""
    write_scene(tmp_path, changed(FILE_START, rods={"file": Verbatim(written)}))
    for name in ("check", "run"):
        result = command(tmp_path, name, "scene.toml")
        require_one_line(result, f"there is no such file: {shown}. Check the name")
        assert result.stderr[:-1].isprintable()


COMMAND_LINES = [
    [], ["run"], ["check"], ["verify"], ["walk", "scene.toml"], ["run", "scene.toml", "--thread", "1"],
    ["run", "scene.toml", "--threads"], ["run", "scene.toml", "--walltime", "3"], ["stress", "a.csv"],
    ["stress", "a.csv", "--bodies", "b.csv", "--volume", "abc"], ["export", "run"],
    ["run", "scene.toml", "--threads", "two"], ["run", "scene.toml", "--out"], ["run", "scene.toml", "other.toml"],
    ["run", "scene.toml", "--json", "--quiet"], ["check", "scene.toml", "--out", "run"], ["--quiet"],
]


@pytest.mark.parametrize("arguments", COMMAND_LINES, ids=" ".join)
def test_command_line(tmp_path, arguments):
    write_scene(tmp_path, RODS)
    before = snapshot(tmp_path)
    result = command(tmp_path, *arguments)
    assert result.returncode == BAD_INPUT, (result.returncode, result.stderr)
    require_one_line(result)
    assert snapshot(tmp_path) == before


def test_help_and_version(tmp_path):
    for arguments in (["--help"], ["run", "--help"], ["check", "--help"], ["verify", "--help"], ["--version"]):
        result = command(tmp_path, *arguments)
        assert result.returncode == DONE and result.stdout != "" and result.stderr == ""
    assert "Exit status: 0 done" in command(tmp_path, "--help").stdout
    assert command(tmp_path, "--version").stdout.startswith("jostle ")
