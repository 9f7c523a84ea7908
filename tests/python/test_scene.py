import copy
import os
from pathlib import Path

import numpy as np
import pytest
from conftest import RODS, command

import jostle
from jostle.scene import _TABLES

SCENES = Path(__file__).resolve().parents[2] / "scenes"
SMALL = {"box": {"edges": [9, 9, 9]}, "rods": {"count": 9, "length": 1}, "time": {"production": 1}}


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_scenes_of_the_command(path):
    scene = jostle.Scene.from_toml(path)
    assert jostle.Scene.from_toml(str(path)) == scene
    assert jostle.Scene.from_toml(path.read_text()) == scene
    assert jostle.Scene.from_toml(scene.to_toml()) == scene


def test_keywords_are_the_tables():
    tables = {"seed": 7, "box": {"volume_fraction": 0.25}, "rods": {"count": 50, "length": 2.0},
              "time": {"step": 0.02, "equilibration": 0.0, "production": 2.0},
              "output": {"series_every": 5, "trajectory_every": 12, "checkpoint_every": 32, "contacts": True}}
    assert jostle.Scene(**tables) == jostle.Scene.from_toml(RODS)
    assert jostle.Scene(**{**tables, "seed": 8}) != jostle.Scene.from_toml(RODS)


def test_every_key_is_read_and_written():
    scene = jostle.Scene.from_toml(SCENES / "run_and_tumble.toml")
    for table, keys in _TABLES.items():
        owner = getattr(scene, table) if table else scene
        for key in keys:
            value = getattr(owner, key)
            setattr(owner, key, value)  # None: left out, or "auto"
            assert getattr(owner, key) == value, (table, key)
            assert key in dir(owner)
    assert scene == jostle.Scene.from_toml(SCENES / "run_and_tumble.toml")


def test_values_of_every_kind():
    scene = jostle.Scene(**SMALL)
    scene.title = 'a "quoted" \\ tïtle'
    assert scene.title == 'a "quoted" \\ tïtle'
    scene.seed = np.int64(12)
    scene.rods.length = np.float32(0.5)
    scene.box.edges = np.array([4.0, 5.0, 6.0])
    scene.box.periodic = (True, np.bool_(False), True)
    scene.mobility.model = "slender_body"
    scene.time.equilibration = "auto"
    assert scene.seed == 12 and scene.rods.length == 0.5 and scene.box.edges == (4.0, 5.0, 6.0)
    assert scene.box.periodic == (True, False, True) and scene.mobility.model == "slender_body"
    assert scene.time.equilibration is None
    scene.time.equilibration = 3
    assert scene.time.equilibration == 3.0
    scene.time.equilibration = None
    assert scene.time.equilibration is None


def test_units():
    scene = jostle.Scene.from_toml(SCENES / "paper_cell_micro.toml")
    scene.rods.length = "300 nm"
    scene.motion.self_propulsion = "1 mm/s"
    assert (scene.rods.length, scene.motion.self_propulsion) == (0.3, 1000.0)
    with pytest.raises(jostle.InputError, match='rods.length = "3 s"'):
        scene.rods.length = "3 s"
    assert scene.rods.length == 0.3


@pytest.mark.parametrize("change, message", [
    (lambda scene: setattr(scene.rods, "length", "long"), 'rods.length = "long"'),
    (lambda scene: setattr(scene.rods, "length", None), "rods.length = None: must have a value"),
    (lambda scene: setattr(scene.rods, "length", 1j), "rods.length = 1j: is a complex"),
    (lambda scene: setattr(scene.rods, "count", 1.5), "rods.count = 1.5: is not a whole number"),
    (lambda scene: setattr(scene.rods, "count", -1), "rods.count = -1: is negative"),
    (lambda scene: setattr(scene.rods, "start", "randm"), 'Did you mean "random"'),
    (lambda scene: setattr(scene.box, "edges", [1, 2]), "box.edges"),
    (lambda scene: setattr(scene.motion, "brownian", 1), "motion.brownian = 1"),
    (lambda scene: setattr(scene, "seed", 2**64), "value = 18446744073709551616|seed"),
])
def test_a_value_that_does_not_fit_changes_nothing(change, message):
    scene = jostle.Scene(**SMALL)
    before = scene.copy()
    with pytest.raises(jostle.InputError, match=message):
        change(scene)
    assert scene == before


@pytest.mark.parametrize("table, key, value, message", [
    ("rods", "length", -1.0, "rods.length = -1: is negative .allowed: at least 0"),
    ("rods", "length", np.nan, "rods.length = nan: is not a finite number"),
    ("rods", "diameter", 0, "rods.diameter = 0: is zero .allowed: greater than 0"),
    ("rods", "count", 0, "rods.count = 0"),
    ("box", "volume_fraction", 0.2, r"box.edges = \[9, 9, 9\]: is given beside box.volume_fraction"),
    ("rods", "file", "x.csv", "rods.file = x.csv: is not used with rods.start"),
    ("motion", "tumble_rate", 1.0, "motion.tumble_rate = 1: is not used with motion.self_propulsion = 0"),
    ("contact", "overlap_limit", 1e-9, "contact.overlap_limit = 1e-09: is not larger"),
    ("growth", "death_rate", 3.0, "growth.death_rate = 3: is not used without growth.rate"),
    ("growth", "daughters", "opposite", "growth.daughters = opposite: is not used without growth.rate"),
    ("growth", "division_every", 5, "growth.division_every = 5: is not used without growth.rate"),
])
def test_validate(table, key, value, message):
    scene = jostle.Scene(**SMALL)
    scene.validate()
    setattr(getattr(scene, table), key, value)
    with pytest.raises(jostle.InputError, match=message):
        scene.validate()
    with pytest.raises(jostle.InputError, match=message):
        jostle.Simulation(scene)


@pytest.mark.parametrize("text", ["[rods]\ncount = 5\n", "seed = -1\n", "\n", "[box]\nvolume_fraction = 0.9\n[rods]\n"
                                  "count = 10\nlength = 2.0\n[time]\nproduction = 1.0\n", "[rods\n"])
def test_errors_have_the_text_of_the_command(tmp_path, monkeypatch, text):
    (tmp_path / "bad.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(jostle.InputError) as raised:
        jostle.Scene.from_toml("bad.toml")
    result = command(tmp_path, "check", "bad.toml")
    assert result.returncode == 2
    assert result.stderr == f"jostle: {raised.value}\n"
    assert raised.value.file == "bad.toml" and raised.value.line > 0


def test_soft_rods_have_no_contact_problem():
    scene = jostle.Scene(**{**SMALL, "contact": {"model": "wca"}})
    scene.validate()
    for table, key, value in (("solver", "method", "bbpgd"), ("solver", "tolerance", 1e-3), ("contact", "brownian_correction", False)):
        changed = scene.copy()
        setattr(getattr(changed, table), key, value)
        with pytest.raises(jostle.InputError, match=f"{table}.{key} = .*: is not used with contact.model"):
            changed.validate()


def test_names_that_are_not_utf_8():
    with pytest.raises(jostle.InputError, match=r"none\\xe9.toml"):
        jostle.Scene.from_toml(os.fsdecode(b"none\xe9.toml"))


def test_errors_tell_their_parts():
    with pytest.raises(ValueError) as raised:
        jostle.Scene(**{**SMALL, "rods": {"count": 9, "lenght": 1}})
    error = raised.value
    assert isinstance(error, jostle.InputError)
    assert (error.key, error.value, error.problem) == ("rods.lenght", "1", "is an unknown key")
    assert error.suggestion == 'Did you mean "length"?' and (error.file, error.line) == ("", 0)
    assert str(error).startswith("rods.lenght = 1: is an unknown key")


def test_names_that_are_none():
    scene = jostle.Scene(**SMALL)
    for action in (lambda: scene.rods.lenght, lambda: scene.lenght, lambda: setattr(scene.rods, "lenght", 1),
                   lambda: setattr(scene, "lenght", 1), lambda: setattr(scene, "rods", {})):
        with pytest.raises(AttributeError):
            action()
    with pytest.raises(jostle.InputError, match="there is no such file"):
        jostle.Scene.from_toml("no_such_scene.toml")
    for source in (None, 1, b"scene.toml"):
        with pytest.raises(jostle.InputError, match="source = .*: is no scene .allowed: the name of a file, or a text"):
            jostle.Scene.from_toml(source)
    with pytest.raises(jostle.InputError, match="holds a character 0"):
        jostle.Scene.from_toml("\0")
    with pytest.raises(jostle.InputError):
        jostle.Scene(**{"rods]\nseed": {"count": 1}})


def test_copies_are_apart():
    scene = jostle.Scene(**SMALL)
    for other in (scene.copy(), copy.copy(scene), copy.deepcopy(scene)):
        assert other == scene
        other.seed = 99
        assert other != scene
    simulation = jostle.Simulation(scene)
    simulation.scene.seed = 5
    assert simulation.scene == scene
    assert "count = 9" in repr(scene) and "count=9" in repr(scene.rods)


def test_all_mistakes_are_told_at_once():
    with pytest.raises(jostle.InputError) as refused:
        jostle.Scene.from_toml("[box]\nvolume_fraction = 1.5\n[rods]\ncount = 9\nlength = -1.0\n[time]\ndt = 0.1\nproduction = 1.0\n")
    mistakes = [refused.value, *refused.value.others]
    assert [one.key for one in mistakes] == ["box.volume_fraction", "rods.length", "time.dt"] and [one.line for one in mistakes] == [2, 5, 7]
    assert str(refused.value).splitlines()[1] == str(mistakes[1]) and mistakes[2].others == []


def test_ramps_are_lists_of_points():
    scene = jostle.Scene(box={"volume_fraction": 0.1}, rods={"count": 9, "length": 1.0}, time={"production": 1.0},
                  schedule={"kT": [[2.0, 0.5]], "edges": [[1, [9, 9, 9]], [2.5, np.array([8.0, 9.0, 9.0])]]})
    assert scene.schedule.kT == [(2.0, 0.5)]
    assert scene.schedule.edges == [(1.0, (9.0, 9.0, 9.0)), (2.5, (8.0, 9.0, 9.0))]
    scene.schedule.kT = scene.schedule.kT + [(3.0, 1.0)]
    assert "kT = [[2.0, 0.5], [3.0, 1.0]]" in scene.to_toml()
    scene.schedule.kT = None
    assert scene.schedule.kT is None and "kT = [[" not in scene.to_toml()
    with pytest.raises(jostle.InputError, match="is no point of a ramp"):
        scene.schedule.kT = [2.0, 0.5]
    scene.schedule.kT = [[2.0, 0.5], [1.0, 0.5]]
    with pytest.raises(jostle.InputError, match="is no later than the time of the point before"):
        scene.validate()
