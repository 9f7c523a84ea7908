"""Scenes that nobody would write: keys from the program's own list, values of every kind, and damage to the text.

`check` accepts or refuses each in one line, and what it accepts `run` can do, or fails at with a reason.
"""

import json
import math
import shutil

from campaign import Defect, jostle, require_ending
from jostle_command import BAD_INPUT, DONE, NUMERICS, STOPPED, scene_text

RUN_SECONDS = "0:00:02"
MOST_ROWS = 2000
SMALL = {"seed": 1, "box": {"volume_fraction": 0.2}, "rods": {"count": 12, "length": 2.0}, "time": {"production": 1.0}}
BASES = [
    SMALL,
    {**SMALL, "rods": {"count": 12, "length": 0.0}, "box": {"edges": [3.0, 4.0, 5.0], "periodic": [True, False, True]}},
    {**SMALL, "motion": {"self_propulsion": 0.1, "tumble_rate": 0.05, "reversal_rate": 0.01}},
    {**SMALL, "rods": {"count": 3, "length": 2.0}, "growth": {"rate": 0.2, "division_length": 4.0, "death_rate": 0.01},
     "box": {"edges": [30.0, 30.0, 30.0], "periodic": [False, False, False]}, "time": {"step": 0.01, "production": 1.0}},
    {**SMALL, "contact": {"model": "wca", "energy": 1.0}, "time": {"rms_step": 0.01, "production": 0.1}},
    {**SMALL, "output": {"trajectory_every": 5, "contacts": True, "field_every": 20, "stress_per_rod": True,
                         "stress_conventions": True}},
    {**SMALL, "motion": {"self_propulsion": 0.1}, "schedule": {"volume_fraction": [[0.5, 0.4]], "kT": [[0.3, 2.0], [0.6, 1.0]],
                                                               "self_propulsion": [[0.2, 0.1], [0.7, 0.5]]}},
    {**SMALL, "rods": {"start": "file", "file": "rods.csv", "length": 2.0}},
    {**SMALL, "rods": {"start": "file", "file": "rods.csv", "length": 2.0}, "springs": {"file": "springs.csv"}},
    {**SMALL, "units": {"system": "micro"}, "rods": {"count": 12, "length": "2 um", "diameter": "1 um"},
     "fluid": {"viscosity": "1 mPa s", "kT": "4.11e-3 pN um"}, "time": {"production": "1 s"}},
]
RODS_FILE = "x,y,z,nx,ny,nz\n1,1,1,1,0,0\n1,3,1,1,0,0\n1,5,1,0,0,1\n"
SPRINGS_FILE = "rod_1,rod_2,s_1,s_2,rest_length,stiffness\n0,1,1,1,2,1\n"
ODD_VALUES = [0, -1, 1, 0.0, -0.0, 1e-320, 1e-31, 1e-30, 1e30, 1e31, 1e308, 2**31, 2**53, 2**63 - 1, True, "auto", "", "x",
              "\x1b[31m", "a\nb", "\x00", "é" * 300, [], [1], [1, 2, 3], [1.0, 2.0, -3.0], [True, False, True], ["x", 1, 2.0],
              "1 um", "1 parsec", "-3 nm", "1e400 um"]
VERBATIM = ["nan", "inf", "-inf", "{}", "{a = 1}", "1979-05-27", "0x7fffffffffffffff", "99999999999999999999", "''", "[[]]",
            "1e999", "", "=", "\"\\u0000\""]


def keys():
    """The program's own list of the keys of a scene."""
    result = jostle(".", "keys", "--json")
    require_ending(result, DONE)
    return json.loads(result.stdout)


def fitting_value(key, random):
    """A value of the kind that the key wants, mostly within its range."""
    kind = key["kind"]
    if kind == "word":
        return random.choice(key["words"])
    if kind == "true or false":
        return random.random() < 0.5
    if kind == "three of true or false":
        return [random.random() < 0.5 for _ in range(3)]
    if kind == "text":
        return random.choice(["rods.csv", "springs.csv", "missing.csv", ".", "title"])
    if kind == "whole number":
        return random.choice([key["at_least"], key["at_most"], random.randrange(1, 40), 10**random.randrange(19)])
    if key.get("auto") and random.random() < 0.2:
        return "auto"
    if kind == "three numbers":
        return three_numbers_near(key, random)
    if kind.startswith("[time, "):
        value = three_numbers_near if "three" in kind else number_near
        times = [10.0**random.uniform(-3, 2) for _ in range(random.randrange(1, 4))]
        return [[time, value(key, random)] for time in (sorted(times) if random.random() < 0.8 else times)]
    return number_near(key, random)


def three_numbers_near(key, random):
    return [number_near(key, random) for _ in range(3)]


def number_near(key, random):
    lower, upper = key["at_least"], key["at_most"]
    ends = [lower, upper, math.nextafter(lower, -math.inf), math.nextafter(upper, math.inf)]
    if random.random() < 0.2:
        return random.choice(ends)
    return random.choice([1.0, -1.0] if random.random() < 0.1 else [1.0]) * 10.0**random.uniform(-3, 2)


def scene(known_keys, random):
    """The text of a scene: one of the bases with some keys changed, added or taken away."""
    tables = {name: dict(table) if isinstance(table, dict) else table for name, table in random.choice(BASES).items()}
    tables["seed"] = random.randrange(100)
    for _ in range(random.randrange(4)):
        key = random.choice(known_keys)
        table, _, name = key["key"].rpartition(".")
        target = tables.setdefault(table, {}) if table else tables
        chance = random.random()
        if chance < 0.6:
            target[name] = fitting_value(key, random)
        elif chance < 0.8:
            target[name] = random.choice(ODD_VALUES)
        elif chance < 0.9:
            target.pop(name, None)
        else:
            target[mutated(name.encode(), random).decode(errors="replace")] = 1
    text = scene_text(tables)
    if random.random() < 0.15:
        line = random.randrange(text.count("\n"))
        lines = text.splitlines()
        lines[line] = lines[line].split("=")[0] + "= " + random.choice(VERBATIM)
        text = "\n".join(lines) + "\n"
    content = text.encode()
    return mutated(content, random) if random.random() < 0.2 else content


def mutated(content, random):
    """Some bytes flipped, cut, doubled or replaced."""
    content = bytearray(content)
    for _ in range(random.randrange(1, 4)):
        place = random.randrange(len(content) + 1)
        how = random.randrange(5)
        if how == 0 and place < len(content):
            content[place] ^= 1 << random.randrange(8)
        elif how == 1:
            del content[place:place + random.randrange(1, 9)]
        elif how == 2:
            content[place:place] = content[place:place + random.randrange(1, 30)]
        elif how == 3:
            content[place:place] = bytes(random.randrange(256) for _ in range(random.randrange(1, 5)))
        else:
            del content[place:]
    return bytes(content)


def cases(random, folder):
    """One scene a case."""
    known_keys = keys()
    while True:
        place = folder / "scene"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        (place / "rods.csv").write_text(RODS_FILE)
        (place / "springs.csv").write_text(SPRINGS_FILE)
        (place / "scene.toml").write_bytes(scene(known_keys, random))
        yield lambda place=place: try_scene(place)


def try_scene(place):
    checked = jostle(place, "check", "scene.toml")
    require_ending(checked, DONE, BAD_INPUT)
    if checked.returncode == BAD_INPUT:
        refused = jostle(place, "run", "scene.toml")
        if refused.returncode != BAD_INPUT or refused.stderr != checked.stderr:
            raise Defect(f"check refuses, run ends with {refused.returncode}: {refused.stderr[:300]!r}")
        if (place / "scene.run").exists():
            raise Defect("a refused scene left a folder")
        return
    round_trip(place, checked.stdout.decode())
    ran = jostle(place, "run", "scene.toml", "--walltime", RUN_SECONDS)
    # A start that cannot be made is found by `run` alone.
    require_ending(ran, DONE, NUMERICS, STOPPED, BAD_INPUT)
    if ran.returncode != BAD_INPUT:
        require_sound_folder(place, ran)


def round_trip(place, printed):
    """The resolved scene that `check` prints is a scene, and prints itself."""
    resolved = printed.split("\n# what follows from it")[0]
    (place / "resolved.toml").write_text(resolved)
    again = jostle(place, "check", "resolved.toml")
    require_ending(again, DONE)
    if again.stdout.decode().split("\n# what follows from it")[0] != resolved:
        raise Defect("the resolved scene resolves to another")


def require_sound_folder(place, ran):
    verified = jostle(place, "verify", "scene.run")
    require_ending(verified, DONE)
    rows = (place / "scene.run/series.csv").read_bytes()
    require_finite(rows.decode())
    if ran.returncode == DONE:
        if (place / "scene.run/summary.json").exists():
            json.loads((place / "scene.run/summary.json").read_text(), parse_constant=refuse_constant)
        again = jostle(place, "run", "scene.toml", "--walltime", RUN_SECONDS)
        require_ending(again, DONE)
    elif ran.returncode == STOPPED and rows.count(b"\n") < MOST_ROWS:
        again = jostle(place, "run", "scene.toml", "--walltime", RUN_SECONDS)
        require_ending(again, DONE, NUMERICS, STOPPED)
    if not (place / "scene.run/series.csv").read_bytes().startswith(rows):
        raise Defect("going on changed rows that had been written")


def require_finite(series):
    """Of all columns but the active stress, which is no number before its lag is over."""
    names, *lines = series.splitlines()
    for line in lines:
        for name, cell in zip(names.split(","), line.split(",")):
            if "active" not in name and not math.isfinite(float(cell)):
                raise Defect(f"series.csv: {name} is {cell}")


def refuse_constant(name):
    raise Defect(f"JSON holds {name}")
