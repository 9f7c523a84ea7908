"""`jostle keys`: the list of what a scene may hold."""

import json

from jostle_command import DONE, RODS, changed, command, require_refused, write_scene


def keys(folder):
    result = command(folder, "keys", "--json")
    assert result.returncode == DONE
    return {key["key"]: key for key in json.loads(result.stdout)}


def test_every_key_of_a_resolved_scene_is_listed(tmp_path):
    write_scene(tmp_path, RODS)
    table, names = "", []
    for line in command(tmp_path, "check", "scene.toml").stdout.split("\n# what follows")[0].splitlines():
        if line.startswith("["):
            table = line.strip("[]") + "."
        elif " = " in line:
            names.append(table + line.split(" = ")[0])
    listed = keys(tmp_path)
    assert len(names) > 30 and set(names) <= set(listed)
    assert [line.split()[0] for line in command(tmp_path, "keys").stdout.splitlines()] == list(listed)


def test_listed_words_and_ends_are_those_that_the_scene_is_held_to(tmp_path):
    listed = keys(tmp_path)
    assert listed["rods.start"]["words"] == ["random", "aligned", "lattice", "file", "run"]
    assert listed["contact.overlap_limit"]["ends_included"] == [False, False]
    for key, beyond in (("solver.tolerance", listed["solver.tolerance"]["at_most"]),
                        ("rods.count", listed["rods.count"]["at_least"] - 1),
                        ("time.rms_step", 2 * listed["time.rms_step"]["at_most"])):
        table, name = key.split(".")
        scene = changed(RODS, **{table: {name: beyond, **({"step": None} if name == "rms_step" else {})}})
        require_refused(tmp_path, scene, key)
