"""A scene at many values of its keys: `jostle sweep`, from Python."""

import csv
import os
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ._arrays import whole_number
from ._jostle import DiskError, refuse
from .run import load
from .scene import Scene, _toml

BAD_INPUT, NUMERICS, DISK, STOPPED = 2, 3, 4, 75
_NUMBERS = "0123456789-+.nN"


@dataclass(frozen=True)
class Sweep:
    """The runs of a sweep, one a row of sweep.csv (docs/guide/sweeps.md).

    folder : Path
    rows : list of dict, column -> number, text, or None where there is no such number; "status" is "done" or tells why not
    """
    folder: Path
    rows: list

    def __len__(self):
        return len(self.rows)

    def __getitem__(self, column):
        """(runs) array of a column of the table; of numbers, NaN where there is none, or else of texts."""
        known = {name for row in self.rows for name in row}
        if not {column, column.removesuffix("_standard_error"), column.removesuffix("_n_eff")} & known:
            refuse("column", repr(column), "is none of the table", ", ".join(list(self.rows[0])[:12]) + " ..." if self.rows else "")
        values = [row.get(column) for row in self.rows]
        if any(isinstance(value, str) for value in values):
            return np.array(["" if value is None else str(value) for value in values])
        return np.array([np.nan if value is None else value for value in values], float)

    @property
    def runs(self):
        """list of Run, of the runs that have begun."""
        return [load(self.folder / row["folder"]) for row in self.rows if (self.folder / row["folder"]).exists()]

    @property
    def failed(self):
        """dict, name of its folder -> why, of the runs that are not done."""
        return {row["folder"]: row["status"] for row in self.rows if row["status"] != "done"}

    def __repr__(self):
        return f"<jostle.Sweep of {len(self)} runs in {self.folder}>"


def sweep(scene, values=None, *, out=None, replicas=1, processes=None, zip=False, plot=(), progress=False):  # noqa: A002
    """Runs a scene at many values of its keys and with many seeds, side by side; what is done is not run again.

    Parameters
    ----------
    scene : path of a scene file, or Scene
    values : dict, key -> list of values, as {"box.volume_fraction": [0.1, 0.2]}; every combination is run
    out : path, the folder for runs and tables; for a file by default its name with .sweep. Of a Scene the text goes to OUT.toml.
    replicas : int, runs of each point, with seeds that follow the scene's
    processes : int, runs at a time; by default one a processor
    zip : bool, the first values of all keys together, then the second, and so on
    plot : names of averages to draw, as "Z"
    progress : bool, print how far it is

    Returns
    -------
    Sweep
        Also where runs failed: look at `failed`. The same call goes on with what is not done, and tries these again.

    Raises
    ------
    InputError
        For what `jostle sweep` refuses, in its words, and where there is no command jostle: it is looked for by the environment variable
        JOSTLE, beside this Python, on PATH and in the build folder.
    DiskError
        Where it cannot write.
    KeyboardInterrupt
        By Ctrl-C: all runs have then written their checkpoints.

    Examples
    --------
    >>> import tempfile
    >>> scene = Scene(box={"volume_fraction": 0.1}, rods={"count": 40, "length": 0}, time={"rms_step": 0.08, "production": 20.0})
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = sweep(scene, {"box.volume_fraction": [0.05, 0.1]}, out=folder + "/spheres", processes=1)  # doctest: +SKIP
    >>> found["volume_fraction"], found["Z"].round(1)                                                     # doctest: +SKIP
    (array([0.05, 0.1 ]), array([1.2, 1.5]))
    """
    options = _options(values or {}, replicas, processes, zip, plot)
    command = _command()
    path, out, made = _scene_file(scene, out)
    words = [command, "sweep", str(path), *options, "--out", str(out)]
    with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                          errors="replace") as running:
        told = _listen(running, progress)
    if made and not Path(out).exists():
        path.unlink()
    _refuse_what_failed(running.returncode, told, out)
    return Sweep(Path(out), _rows(Path(out) / "sweep.csv"))


def _options(values, replicas, processes, together, plot):
    words = ["--replicas", str(whole_number("replicas", replicas, 1))]
    for key, of_key in values.items():
        if isinstance(of_key, (str, bytes)) or not np.iterable(of_key) or len(of_key) == 0:
            refuse(f"values[{key!r}]", repr(of_key), "is no list of values", "a list, as [0.1, 0.2]")
        words += ["--set", f"{key}={','.join(_toml(key, value) for value in of_key)}"]
    if processes is not None:
        words += ["--processes", str(whole_number("processes", processes, 1))]
    for name in [plot] if isinstance(plot, str) else plot:
        words += ["--plot", str(name)]
    return words + (["--zip"] if together else [])


def _scene_file(scene, out):
    """The file of the scene, the folder for the sweep, and whether the file was made."""
    if not isinstance(scene, Scene):
        return scene, Path(scene).stem + ".sweep" if out is None else out, False
    if out is None:
        refuse("out", "", "is missing: a Scene has no name", "the name of a folder", "Give out=\"rods.sweep\"")
    scene = scene.copy()
    scene.validate()
    folder = Path(scene._core.path).parent
    for table in ("rods", "springs"):
        name = getattr(scene, table).file
        if name:
            setattr(getattr(scene, table), "file", str((folder / name).absolute()))
    path, text = Path(f"{os.fspath(out).rstrip('/')}.toml"), scene.to_toml()
    try:
        if path.exists() and path.read_text(errors="replace") != text and not Path(out).exists():
            refuse("out", f"{str(out)!r}", f"its scene would go to {path}, which is another file", suggestion="Give another folder")
        made = not path.exists()
        path.write_text(text)
    except OSError as error:
        raise DiskError(f"{str(path)!r}: cannot write it: {error.strerror}") from None
    return path, out, made


def _command():
    built = Path(__file__).resolve().parents[2] / "apps" / "jostle"
    for found in (os.environ.get("JOSTLE"), Path(sys.executable).parent / "jostle", shutil.which("jostle"), built):
        if found and os.access(found, os.X_OK):
            return str(found)
    refuse("jostle", "", "there is no such command, and it runs the sweep", suggestion="Install it, or set JOSTLE to where it is")


def _listen(running, progress):
    """Lines on standard error; Ctrl-C, which reaches the command, too, is waited for."""
    told, stopped = [], False
    while True:
        try:
            line = running.stderr.readline()
            if not line:
                break
            told.append(line.rstrip("\n"))
            if progress:
                print(told[-1], file=sys.stderr, flush=True)
        except KeyboardInterrupt:
            stopped = True
    running.wait()
    if stopped:
        raise KeyboardInterrupt
    return told


def _refuse_what_failed(status, told, out):
    if status in (0, NUMERICS) and (Path(out) / "sweep.csv").exists():
        return
    said = "\n".join(told)
    words = said[said.rfind("jostle: ") + len("jostle: "):] if "jostle: " in said else f"it ended with status {status}: {said}"
    if status == BAD_INPUT:
        refuse("", "", words)
    if status == STOPPED:
        raise KeyboardInterrupt
    raise DiskError(words) if status == DISK else RuntimeError(f"jostle sweep: {words}")


def _rows(path):
    with open(path, newline="", encoding="utf-8", errors="surrogateescape") as file:
        return [{name: _cell(text) for name, text in row.items()} for row in csv.DictReader(file)]


def _cell(text):
    if text == "":
        return None
    try:
        return float(text) if text[0] in _NUMBERS else text
    except ValueError:
        return text
