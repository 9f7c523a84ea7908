"""Damage to the folder of a run: every kind, in every file. Going on either ends as an undisturbed run does, byte for byte, or refuses and does no
harm: with the files as they were before the damage it then goes on to the same end.
"""

import shutil

from campaign import Defect, jostle, require_ending
from jostle_command import BAD_INPUT, DISK, DONE, RODS, changed, require_same_results, scene_text, with_steps

KINDS = {
    "rods": RODS,
    "cells": {"seed": 3, "box": {"edges": [30.0, 30.0, 30.0], "periodic": [False, False, False]},
              "rods": {"count": 4, "length": 2.0},
              "growth": {"rate": 1.0, "division_length": 4.0, "death_rate": 0.02},
              "time": {"step": 0.02, "equilibration": 0.0, "production": 2.0},
              "output": {"series_every": 5, "trajectory_every": 12, "checkpoint_every": 32}},
    "swimmers": changed(RODS, motion={"self_propulsion": 0.5, "tumble_rate": 0.05},
                        output={"field_every": 25, "stress_per_rod": True}),
}
OTHER_SEED = 99


class Folders:
    """For each kind of run: one finished, one stopped on its way, and one of another seed to take files from."""

    def __init__(self, folder):
        self.place = folder / "folders"
        shutil.rmtree(self.place, ignore_errors=True)
        for name, scene in KINDS.items():
            self.make(f"{name}/finished", scene)
            self.make(f"{name}/other", changed(scene, seed=OTHER_SEED))
            self.make(f"{name}/stopped", with_steps(scene, 50))  # its production is another: going on needs the longer one
            (self.place / name / "stopped/scene.toml").write_text(scene_text(scene))

    def make(self, name, scene):
        (self.place / name).mkdir(parents=True)
        (self.place / name / "scene.toml").write_text(scene_text(scene))
        require_ending(jostle(self.place / name, "run", "scene.toml", "--out", "run", "--threads", "1"), DONE)

    def copy(self, name):
        work = self.place / "work"
        shutil.rmtree(work, ignore_errors=True)
        shutil.copytree(self.place / name, work, symlinks=True)
        return work


def damage(path, other, random):
    """Changes one file in one way; returns the way, in words."""
    content = path.read_bytes()
    how = random.choice(["flip", "flip", "flip", "cut", "empty", "delete", "append", "zero", "swap", "folder", "link"])
    place = random.randrange(max(1, len(content)))
    if how == "flip" and content:
        bit = random.randrange(8)
        path.write_bytes(content[:place] + bytes([content[place] ^ 1 << bit]) + content[place + 1:])
        return f"bit {bit} of byte {place} flipped"
    if how == "cut":
        path.write_bytes(content[:place])
        return f"cut to {place} of {len(content)} bytes"
    if how == "append":
        added = random.randbytes(random.randrange(1, 200))
        path.write_bytes(content + added)
        return f"{len(added)} bytes appended"
    if how == "zero":
        end = min(len(content), place + random.randrange(1, 4096))
        path.write_bytes(content[:place] + bytes(end - place) + content[end:])
        return f"bytes {place} to {end} zeroed"
    if how == "swap" and other.exists():
        path.write_bytes(other.read_bytes())
        return "that of a run with another seed"
    path.unlink()
    if how == "empty":
        path.write_bytes(b"")
    elif how == "folder":
        path.mkdir()
    elif how == "link":
        path.symlink_to("/dev/null")
    return how


def go_on(work):
    result = jostle(work, "run", "scene.toml", "--out", "run", "--threads", "1")
    require_ending(result, DONE, BAD_INPUT, DISK)
    return result.returncode


def put_back(path, content):
    if path.is_dir():
        path.rmdir()
    elif path.is_symlink():
        path.unlink()
    path.write_bytes(content)


def cases(random, folder):
    """One damaged file a case, sometimes two."""
    runs = Folders(folder)
    while True:
        kind = random.choice(list(KINDS))
        work = runs.copy(f"{kind}/{random.choice(['finished', 'stopped'])}")
        ways, sound = [], {}
        for _ in range(1 if random.random() < 0.8 else 2):
            files = sorted(path for path in (work / "run").iterdir() if path.is_file() and not path.is_symlink())
            path = random.choice(files)
            sound.setdefault(path, path.read_bytes())
            ways.append(f"{kind}, {path.name}: " + damage(path, runs.place / kind / "other/run" / path.name, random))
        yield lambda: try_folder(work, sound, runs.place / kind / "finished/run", "; ".join(ways))


def try_folder(work, sound, reference, ways):
    """`sound`: the damaged files by name, as they were."""
    try:
        require_ending(jostle(work, "verify", "run"), DONE, BAD_INPUT, DISK)
        if go_on(work) != DONE:
            for path, content in sound.items():
                put_back(path, content)
            if go_on(work) != DONE:
                raise Defect("refused, also after what was damaged was put back")
        require_same_results(work / "run", reference)
    except AssertionError as difference:
        raise Defect(f"{ways}: exit status 0, and {difference}") from None
    except Defect as defect:
        raise Defect(f"{ways}: {defect}") from None
