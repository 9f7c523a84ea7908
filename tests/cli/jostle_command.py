"""What the tests of the command share: scenes as text, running, and looking at what a run left."""

import functools
import copy
import hashlib
import json
import os
import random
import signal
import subprocess
import time
from pathlib import Path

import h5py
import numpy as np

JOSTLE = os.environ.get("JOSTLE", "jostle")
DONE, BAD_INPUT, NUMERICS, DISK, STOPPED = 0, 2, 3, 4, 75

# Files that are the same for every way to the end of a run. trajectory.h5 is compared by its datasets.
RESULTS = ("scene.toml", "resolved.toml", "series.csv", "series.json", "contacts.csv", "contacts.json", "lineage.csv", "field.csv", "field.json", "checkpoint",
           "trajectory.journal", "summary.json")
NOTICES = ("jostle: going on from step ", "jostle: start in ", "jostle: annealing the start: ")
TIME_STEP = 0.02

# 50 short rods that touch often, every file written, no two of the intervals in step.
RODS = {
    "seed": 7,
    "box": {"volume_fraction": 0.25},
    "rods": {"count": 50, "length": 2.0},
    "time": {"step": TIME_STEP, "equilibration": 0.0, "production": 100 * TIME_STEP},
    "output": {"series_every": 5, "trajectory_every": 12, "checkpoint_every": 32, "contacts": True},
}
SPHERES = {
    "seed": 8,
    "box": {"volume_fraction": 0.3},
    "rods": {"count": 64, "length": 0.0},
    "time": {"step": 0.002, "equilibration": 0.0, "production": 0.2},
    "output": {"series_every": 4, "trajectory_every": 10, "checkpoint_every": 25},
}

started = []  # processes that `start` made


def changed(scene, **changes):
    """A copy of the scene; a table of `changes` is merged into its own, and None removes a key."""
    scene = copy.deepcopy(scene)
    for name, value in changes.items():
        if not isinstance(value, dict):
            scene[name] = value
            continue
        table = scene.setdefault(name, {})
        for key, entry in value.items():
            if entry is None:
                table.pop(key, None)
            else:
                table[key] = entry
    return scene


def with_steps(scene, steps):
    return changed(scene, time={"production": steps * scene["time"]["step"]})


class Verbatim(str):
    """A value that stands in the scene as it is, not as a TOML text."""


def toml_value(value):
    if isinstance(value, Verbatim):
        return str(value)
    return json.dumps(value) if isinstance(value, (str, bool, list)) else repr(value)


def scene_text(scene):
    lines = [f"{key} = {toml_value(value)}" for key, value in scene.items() if not isinstance(value, dict)]
    for name, table in scene.items():
        if isinstance(table, dict):
            lines.append(f"[{name}]")
            lines += [f"{key} = {toml_value(value)}" for key, value in table.items()]
    return "\n".join(lines) + "\n"


def place_of(text, table, key):
    """LINE:COLUMN of the value of a key in a scene."""
    current = ""
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("["):
            current = line.strip("[]")
        elif current == table and line.split(" = ")[0] == key:
            return f"{number}:{line.index(' = ') + 4}"
    raise KeyError(f"{table}.{key}")


def write_scene(folder, scene, name="scene.toml"):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_text(scene if isinstance(scene, str) else scene_text(scene))
    return folder / name


def run_arguments(*options, threads=1, out="run"):
    return ["run", "scene.toml", "--out", out, "--threads", str(threads), *options]


def command(folder, *arguments, **options):
    """Runs `jostle ARGUMENTS` in the folder to its end."""
    return subprocess.run([JOSTLE, *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=60,
                          **options)


def run(folder, *options, threads=1, **others):
    """Runs folder/scene.toml into folder/run: paths are relative so that every run has the same command line."""
    return command(folder, *run_arguments(*options, threads=threads), **others)


def finish(folder, *options, threads=1):
    result = run(folder, *options, threads=threads)
    assert result.returncode == DONE, result.stderr
    return folder / "run"


def start(folder, *options, threads=1, **others):
    """Starts such a run and does not wait for it; what is left of it after the test is ended by a fixture."""
    process = subprocess.Popen([JOSTLE, *run_arguments(*options, threads=threads)], cwd=folder, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, **others)
    started.append(process)
    return process


def wait_until(condition, process, seconds=60.0):
    """Waits for the condition while the process lives."""
    end = time.monotonic() + seconds
    while not condition():
        assert process.poll() is None, f"ended early with {process.returncode}: {process.stderr.read()}"
        assert time.monotonic() < end, "waited too long"
        time.sleep(0.001)


def kill(process, number=signal.SIGKILL):
    """Sends the signal, waits for the end, and returns (exit status, stdout, stderr)."""
    process.send_signal(number)
    stdout, stderr = process.communicate(timeout=60)
    return process.returncode, stdout, stderr


def rows_of(path):
    """Whole rows of a series so far, without the header."""
    return max(0, path.read_bytes().count(b"\n") - 1) if path.exists() else 0


def stop_and_kill(folder, *stops):
    """Runs folder/scene.toml, once for each of (rows, signal): when the series has more rows, the run gets the signal."""
    for rows, number in stops:
        process = start(folder)
        wait_until(lambda rows=rows: rows_of(folder / "run/series.csv") > rows, process)
        assert kill(process, number)[0] == (-number if number == signal.SIGKILL else STOPPED)
        assert command(folder, "verify", "run").returncode == DONE


@functools.lru_cache(maxsize=8)
def header_and_rows(text):
    """Of a CSV file: its header and its rows, read once."""
    header, *rows = (line.split(",") for line in text.splitlines())
    return header, rows


def column(path, name):
    header, rows = header_and_rows(path.read_text())
    place = header.index(name)
    return [float(row[place]) for row in rows]


def mean(folder, name):
    values = column(folder / "series.csv", name)
    return sum(values) / len(values)


CHECKPOINT_HEADER = 24  # bytes of a checkpoint before its fields; 8 of a checksum stand behind them


def fields_of_checkpoint(content):
    """{name: where its bytes begin} of the named fields: length of the name, the name, number of bytes, these."""
    fields, place = {}, CHECKPOINT_HEADER
    while place < len(content) - 8:
        end = place + 8 + int.from_bytes(content[place:place + 8], "little")
        fields[content[place + 8:end].decode()] = end + 8
        place = end + 8 + int.from_bytes(content[end:end + 8], "little")
    assert place == len(content) - 8
    return fields


def checkpoint_step(folder):
    content = (folder / "checkpoint").read_bytes()
    place = fields_of_checkpoint(content)["step"]
    return int.from_bytes(content[place:place + 8], "little")


def snapshot(path):
    """What is in a folder: content, length and time of change of everything.

    Left out is `lock`, in which whoever opens a run writes its process number.
    """
    found = {}
    for entry in sorted(Path(path).rglob("*")):
        if entry.name == "lock":
            continue
        status = entry.lstat()
        content = hashlib.sha256(entry.read_bytes()).hexdigest() if entry.is_file() else "folder"
        found[str(entry.relative_to(path))] = (content, status.st_size, status.st_mtime_ns, oct(status.st_mode))
    return found


def datasets(path):
    """Every dataset and attribute of an HDF5 file: type, shape and bytes."""
    found = {}

    def visit(name, entry):
        for key, value in entry.attrs.items():
            if key not in ("REFERENCE_LIST", "DIMENSION_LIST"):  # addresses within the file
                found[f"{name}@{key}"] = (str(np.asarray(value).dtype), np.asarray(value).tobytes())
        if isinstance(entry, h5py.Dataset):
            value = np.asarray(entry[()])
            found[name] = (str(entry.dtype), entry.shape, value.tobytes())

    with h5py.File(path, "r") as file:
        file.visititems(visit)
    return found


def require_same_results(folder, reference, same_command=True):
    """All results of two finished runs agree byte for byte, and no temporary file is left.

    trajectory.h5 tells the last command line; `same_command` false: that may differ.
    """
    for name in RESULTS:
        assert (folder / name).exists() == (reference / name).exists(), name
        if (reference / name).exists():
            assert (folder / name).read_bytes() == (reference / name).read_bytes(), f"{name} differs"
    assert (folder / "trajectory.h5").exists() == (reference / "trajectory.h5").exists()
    if (reference / "trajectory.h5").exists():
        ours, theirs = datasets(folder / "trajectory.h5"), datasets(reference / "trajectory.h5")
        assert ours.keys() == theirs.keys()
        for name in theirs:
            if name == "parameters/command_line" and not same_command:
                continue
            assert ours[name] == theirs[name], f"trajectory.h5: {name} differs"
    assert not list(folder.glob("*.tmp"))


def require_every_row(folder, every, steps):
    """The series has one row for each of every, 2 every, ... steps."""
    assert column(folder / "series.csv", "step") == list(range(every, steps + 1, every))


def lines_but_notices(stderr):
    """The lines of stderr without those that only say where a run begins."""
    return [line for line in stderr.splitlines() if not line.startswith(NOTICES)]


def require_one_line(result, *parts):
    """Refused as bad input, in one line on stderr that holds all parts, and nothing on stdout."""
    assert result.returncode == BAD_INPUT, (result.returncode, result.stdout, result.stderr)
    assert result.stdout == ""
    lines = lines_but_notices(result.stderr)
    assert result.stderr.endswith("\n") and len(lines) == 1, result.stderr
    assert lines[0].startswith("jostle: ")
    for part in parts:
        assert part in lines[0], f"{part!r} is not in: {result.stderr}"


def require_refused(folder, scene, *parts):
    """`jostle check` refuses the scene in one line that holds all parts."""
    write_scene(folder, scene)
    require_one_line(command(folder, "check", "scene.toml"), *parts)


def random_numbers():
    """A generator whose seed is printed, and can be given as JOSTLE_TEST_SEED to repeat a failure."""
    seed = int(os.environ.get("JOSTLE_TEST_SEED", random.SystemRandom().randrange(10**9)))
    print(f"JOSTLE_TEST_SEED={seed}")
    return random.Random(seed)


def flip_bit(path, bit):
    content = bytearray(path.read_bytes())
    content[bit // 8] ^= 1 << bit % 8
    path.write_bytes(content)
