"""Files of a run that are truncated, damaged or of another run: found, told, exit 2, and nothing has changed."""

import ctypes
import json
import math
import re
import shutil
import struct

import pytest

from jostle_command import (CHECKPOINT_HEADER, DONE, RODS, changed, checkpoint_step, command, datasets, fields_of_checkpoint, finish, flip_bit, random_numbers,
                            require_one_line, require_same_results, run, snapshot, write_scene)

FLIPS = 12
SEAL = 24  # bytes at the end of trajectory.h5: mark, length, checksum


def refuse(folder, *parts, verify=True):
    """The run does not go on and `verify` finds the damage; nothing is touched."""
    before = snapshot(folder)
    require_one_line(run(folder), *parts)
    if verify:
        require_found(folder, parts[0])
    assert snapshot(folder) == before, "the folder was touched"


def require_found(folder, *parts):
    """`verify` tells the damage in one line on stderr; on stdout it may have told what is sound."""
    result = command(folder, "verify", "run")
    assert all(": sound" in line for line in result.stdout.splitlines())
    result.stdout = ""
    require_one_line(result, *parts)


def sealed(payload_and_header):
    """A checkpoint with its checksum made new, as another version of the program would write it."""
    library = ctypes.CDLL("libxxhash.so.0")
    library.XXH3_64bits.restype = ctypes.c_uint64
    library.XXH3_64bits.argtypes = (ctypes.c_char_p, ctypes.c_size_t)
    content = bytes(payload_and_header)
    return content + library.XXH3_64bits(content, len(content)).to_bytes(8, "little")


@pytest.mark.parametrize("table, key, value, said", [
    ("fluid", "viscosity", 2.0, "was 1 and is 2"), ("rods", "count", 51, "was 50 and is 51"),
    ("time", "step", 0.01, "was 0.02 and is 0.01"), ("solver", "tolerance", 2e-5, "was 1e-05 and is 2e-05"),
    ("output", "series_every", 10, "was 5 and is 10"), ("output", "stress_conventions", True, "was false and is true"),
    ("output", "stress_per_rod", True, "was false and is true")])
def test_checkpoint_of_another_scene(torn_copy, table, key, value, said):
    scene = changed(RODS, **{"seed": RODS["seed"], table: {key: value}})
    write_scene(torn_copy, scene)
    refuse(torn_copy, f"run/checkpoint: the checkpoint is of another scene: {table}.{key} {said}. Restore the scene, "
           "give another folder with --out, or start again with --fresh", verify=False)


def test_all_keys_that_differ_are_counted(finished_copy):
    write_scene(finished_copy, changed(RODS, seed=8, rods={"length": 3.0}, title="another"))
    refuse(finished_copy, "of another scene: seed was 7 and is 8, and 1 other key differs.", verify=False)


def test_scene_written_in_another_way_is_the_same(finished_copy, finished):
    scene = (finished_copy / "scene.toml").read_text()
    (finished_copy / "scene.toml").write_text("# the same\n" + scene.replace("length = 2.0", "length = 2"))
    assert run(finished_copy).returncode == DONE
    assert (finished_copy / "run/checkpoint").read_bytes() == (finished / "run/checkpoint").read_bytes()


def test_checkpoint_of_another_version(torn_copy):
    path = torn_copy / "run/checkpoint"
    content = bytearray(path.read_bytes()[:-8])
    assert sealed(content) == path.read_bytes(), "the checksum is that of the format"
    other, this = content[8] + 1, content[8]
    content[8] = other
    path.write_bytes(sealed(content))
    refuse(torn_copy, f"run/checkpoint: the checkpoint has format version {other}, this jostle reads version {this}")


def forge(path, change):
    """Changes a checkpoint, and makes its checksum anew."""
    content = bytearray(path.read_bytes())
    change(content, fields_of_checkpoint(content))
    path.write_bytes(sealed(content[:-8]))


@pytest.mark.parametrize("field, value", [("time", math.nan), ("box.edges", math.nan), ("box.edges", 1e300), ("box.edges", -1.0),
                                          ("box.edges", 0.0), ("rods.centre", math.nan), ("rods.centre", 1e30),
                                          ("rods.axis", 1e300), ("rods.length", math.inf), ("rods.length", -2.0),
                                          ("rods.diameter", 0.0), ("rods.id", 50), ("rods.id", 2**63), ("step", 2**64 - 1)])
def test_forged_checkpoint(torn_copy, field, value):
    """Absurd numbers under a right checksum: one clear refusal, not a crash."""
    def change(content, fields):
        content[fields[field]:fields[field] + 8] = struct.pack("<d" if isinstance(value, float) else "<Q", value)

    forge(torn_copy / "run/checkpoint", change)
    refuse(torn_copy, "run/checkpoint: the checkpoint ", "again with --fresh")


@pytest.mark.parametrize("size", [2**40, 2**63, 2**64 - 1, 8, 0])
def test_forged_length(torn_copy, size):
    """An array that claims more bytes than there are, or fewer than the other arrays have."""
    def change(content, fields):
        content[fields["rods.length"] - 8:fields["rods.length"]] = struct.pack("<Q", size)

    forge(torn_copy / "run/checkpoint", change)
    refuse(torn_copy, "run/checkpoint: the checkpoint is damaged", "again with --fresh")


@pytest.mark.parametrize("field", ["time", "rods.axis", "springs.s_1", "scene"])
def test_renamed_field(torn_copy, field):
    def change(content, fields):
        place = fields[field] - 8 - len(field)
        content[place:place + len(field)] = b"x" * len(field)

    forge(torn_copy / "run/checkpoint", change)
    refuse(torn_copy, f'run/checkpoint: the checkpoint is damaged: it has no field "{field}"', "again with --fresh")


def test_sum_that_is_missing(torn_copy):
    def change(content, fields):
        place = fields["sums.residual"] - 8 - len("residual")
        content[place:place + len("residual")] = b"x" * len("residual")

    forge(torn_copy / "run/checkpoint", change)
    refuse(torn_copy, 'checkpoint: it lacks the sum "residual" of a run of this scene', verify=False)


@pytest.mark.parametrize("left", [0, 7, CHECKPOINT_HEADER, 100, 0.5, -9, -1])
def test_truncated_checkpoint(torn_copy, left):
    path = torn_copy / "run/checkpoint"
    content = path.read_bytes()
    path.write_bytes(content[:int(left * len(content)) if isinstance(left, float) else left])
    refuse(torn_copy, "run/checkpoint: the checkpoint is", "start again with --fresh")


def test_checkpoint_with_bytes_after_it(torn_copy):
    with open(torn_copy / "run/checkpoint", "ab") as file:
        file.write(b"\0")
    refuse(torn_copy, "run/checkpoint: the checkpoint is damaged")


def test_something_else_in_place_of_the_checkpoint(torn_copy):
    shutil.copy(torn_copy / "run/series.csv", torn_copy / "run/checkpoint")
    refuse(torn_copy, "run/checkpoint: is not a checkpoint of jostle")


def test_flipped_bits_in_the_checkpoint(torn_copy):
    random = random_numbers()
    path = torn_copy / "run/checkpoint"
    size = path.stat().st_size
    in_header = [8 * place + random.randrange(8) for place in (0, 8, 12, 16, 23)]
    for bit in in_header + [random.randrange(8 * CHECKPOINT_HEADER, 8 * size) for _ in range(FLIPS)]:
        flip_bit(path, bit)
        refuse(torn_copy, "run/checkpoint: ")
        flip_bit(path, bit)


def test_the_checkpoint_before_is_offered(torn_copy, torn):
    """It is not taken without asking; removing the damaged one, as the message says, goes on from it."""
    path = torn_copy / "run/checkpoint"
    shutil.copy(path, torn_copy / "run/checkpoint.previous")
    step = checkpoint_step(torn_copy / "run")
    flip_bit(path, 8 * 500)
    refuse(torn_copy, "run/checkpoint: the checkpoint is damaged", f"checkpoint.previous (step {step}), is sound",
           "remove run/checkpoint to go on from there")
    path.unlink()
    result = run(torn_copy, "--walltime", "0:00:01")
    assert f"going on from step {step}\n" in result.stderr
    assert checkpoint_step(torn_copy / "run") == step + 1


def checkpointed_bytes(folder, name):
    """How much of a growing file the checkpoint of `torn` stands for: whole rows or frames up to its step."""
    step = checkpoint_step(folder)
    if name == "trajectory.journal":
        frame = 72 + 52 * RODS["rods"]["count"] + 8
        return 16 + frame * (1 + step // RODS["output"]["trajectory_every"])
    lines = (folder / name).read_bytes().splitlines(keepends=True)
    return sum(len(line) for k, line in enumerate(lines) if k == 0 or int(line.split(b",")[0]) <= step)


GROWING = ["series.csv", "contacts.csv", "trajectory.journal"]


@pytest.mark.parametrize("name", GROWING)
def test_flipped_bits_before_the_checkpoint(torn_copy, name):
    """All of the files go on beyond the checkpoint; finding one damaged must not cut the others."""
    random = random_numbers()
    path = torn_copy / "run" / name
    size = checkpointed_bytes(torn_copy / "run", name)
    assert 0 < size < path.stat().st_size
    for bit in [0, 8 * size - 1] + [random.randrange(8 * size) for _ in range(FLIPS)]:
        flip_bit(path, bit)
        refuse(torn_copy, f"run/{name}", "start again with --fresh")
        flip_bit(path, bit)


@pytest.mark.parametrize("name", GROWING)
def test_truncated_before_the_checkpoint(torn_copy, name):
    path = torn_copy / "run" / name
    size = checkpointed_bytes(torn_copy / "run", name)
    for left in (0, 10, size // 2, size - 1):
        path.write_bytes(path.read_bytes()[:left])
        refuse(torn_copy, f"run/{name}", "--fresh")


@pytest.mark.parametrize("name", GROWING)
def test_missing(torn_copy, name):
    (torn_copy / "run" / name).unlink()
    refuse(torn_copy, f"run/{name}: there is no such file")


@pytest.mark.parametrize("name", GROWING)
def test_damage_beyond_the_checkpoint_is_cut_away(torn_copy, name):
    path = torn_copy / "run" / name
    size = checkpointed_bytes(torn_copy / "run", name)
    flip_bit(path, 8 * size + 8 * 40)
    step = checkpoint_step(torn_copy / "run")
    result = run(torn_copy, "--walltime", "0:00:01")
    assert f"going on from step {step}\n" in result.stderr, result.stderr
    assert command(torn_copy, "verify", "run").returncode == DONE


def test_journal_of_another_run(finished_copy, tmp_path):
    """As long, with as many rods, frames at the same steps, every checksum right: and yet of another seed."""
    write_scene(tmp_path / "other", changed(RODS, seed=8))
    theirs, ours = finish(tmp_path / "other") / "trajectory.journal", finished_copy / "run/trajectory.journal"
    assert theirs.stat().st_size == ours.stat().st_size
    shutil.copy(theirs, ours)
    refuse(finished_copy, "run/trajectory.journal: the trajectory is of another run", "Put the file back")


# What makes each of them wrong, beside being cut or missing.
TEXTS = {
    "scene.toml": ("length = 2.0", "length = 2.5"),
    "resolved.toml": ("production = 2", "production = 3"),
    "series.json": ('"unit"', '"unti"'),
    "contacts.json": ("contact force", "contact farce"),
    "run.json": ('"steps": ', '"steps": "many", "other": '),
    "summary.json": ('"max_overlap"', '"max_overlup"'),
}


@pytest.mark.parametrize("name", TEXTS)
@pytest.mark.parametrize("damage", ["missing", "empty", "cut", "changed"])
def test_files_that_are_written_anew(finished_copy, finished, name, damage):
    path = finished_copy / "run" / name
    text = path.read_text()
    if damage == "missing":
        path.unlink()
    elif damage == "changed":
        assert TEXTS[name][0] in text
        path.write_text(text.replace(*TEXTS[name]))
    else:
        path.write_text("" if damage == "empty" else text[:len(text) // 2])
    before = snapshot(finished_copy)
    require_found(finished_copy, f"run/{name}")
    assert snapshot(finished_copy) == before
    finish(finished_copy)
    require_same_results(finished_copy / "run", finished / "run")
    assert command(finished_copy, "verify", "run").returncode == DONE


@pytest.mark.parametrize("name", ["run.json", "summary.json"])
def test_a_bit_of_a_json_file(finished_copy, name):
    """Each digit counts, and each bit: the file ends with a checksum."""
    random = random_numbers()
    path = finished_copy / "run" / name
    text = path.read_text()
    assert re.search(r',\n  "checksum": "[0-9a-f]{16}"\n}\n$', text)
    digits = [place for place, sign in enumerate(text) if sign in "0123456789"]
    for place in random.sample(digits, 10):
        path.write_text(text[:place] + str((int(text[place]) + 1) % 10) + text[place + 1:])
        require_found(finished_copy, f"run/{name}: is damaged: it does not fit its checksum", "it writes this file anew")
    path.write_text(text)
    for _ in range(10):
        bit = random.randrange(8 * len(text.encode()))
        flip_bit(path, bit)
        require_found(finished_copy, f"run/{name}: is damaged")
        flip_bit(path, bit)
    assert command(finished_copy, "verify", "run").returncode == DONE


def test_a_run_whose_scene_was_removed_goes_on(torn_copy):
    for name in ("scene.toml", "resolved.toml", "series.json", "run.json"):
        (torn_copy / "run" / name).unlink()
    assert run(torn_copy, "--walltime", "0:00:01").returncode == 75
    assert (torn_copy / "run/scene.toml").read_bytes() == (torn_copy / "scene.toml").read_bytes()
    assert command(torn_copy, "verify", "run").returncode == DONE


@pytest.mark.parametrize("record", ['{"sessions": 5}', '{"sessions": "x"}', '{"sessions": {"a": 1}}', '{"sessions": true}',
                                    '{"sessions": [1, [2], null]}', "[]", "5", "{", "", '{"sessions": ' + 200_000 * "[",
                                    '{"sessions": ' + 200_000 * "[" + 200_000 * "]" + "}"], ids=lambda text: text[:30])
def test_a_record_that_is_none(finished_copy, finished, record):
    """It is only history: a run goes on without it."""
    path = finished_copy / "run/run.json"
    path.write_text(record)
    require_found(finished_copy, "run/run.json: is damaged")
    finish(finished_copy)
    require_same_results(finished_copy / "run", finished / "run")
    assert len(json.loads(path.read_text())["sessions"]) == 1


def test_bytes_after_the_trajectory_or_a_seal_that_is_cut(finished_copy):
    path = finished_copy / "run/trajectory.h5"
    content = path.read_bytes()
    for changed_content in (content + b"ab", content[:-1], content[:-SEAL + 3], content + content[-SEAL:], content[:-SEAL] + SEAL * b"x"):
        path.write_bytes(changed_content)
        require_found(finished_copy, "run/trajectory.h5: the trajectory is damaged")
    path.write_bytes(content[:-SEAL])  # as another program leaves it that wrote into it
    assert command(finished_copy, "verify", "run").returncode == DONE


def test_flipped_bits_in_trajectory(finished_copy, finished):
    """`verify` finds every one; running the finished run again makes the file anew from its journal."""
    random = random_numbers()
    path = finished_copy / "run/trajectory.h5"
    size = path.stat().st_size
    for bit in [8 * (size - 1)] + [random.randrange(8 * (size - SEAL)) for _ in range(FLIPS)]:
        flip_bit(path, bit)
        before = snapshot(finished_copy)
        require_found(finished_copy, "run/trajectory.h5: the trajectory is damaged",
                      "Make it again from the journal by running the same command")
        assert snapshot(finished_copy) == before
        flip_bit(path, bit)
    flip_bit(path, 8 * (size // 2))
    assert run(finished_copy).returncode == DONE
    assert datasets(path) == datasets(finished / "run/trajectory.h5")
    require_same_results(finished_copy / "run", finished / "run")


def test_truncated_trajectory(finished_copy):
    path = finished_copy / "run/trajectory.h5"
    content = path.read_bytes()
    for left in (0, 100, len(content) // 2, len(content) - SEAL - 1):
        path.write_bytes(content[:left])
        require_found(finished_copy, "run/trajectory.h5: the trajectory is damaged")


def test_fresh_helps_out_of_any_damage(finished_copy, finished):
    for name in ("checkpoint", "series.csv", "trajectory.journal"):
        (finished_copy / "run" / name).write_bytes(b"")
    finish(finished_copy, "--fresh")
    require_same_results(finished_copy / "run", finished / "run", same_command=False)
