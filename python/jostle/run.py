"""Runs of the command, as they lie on the disk."""

import io
import json
from functools import cached_property
from pathlib import Path

import numpy as np

from ._jostle import refuse
from .scene import Scene
from .simulation import Simulation
from .trajectory import open_trajectory

_SIGNS = ("run.json", "series.csv", "checkpoint")
_ADVICE = "`jostle verify` tells the state of a run"


def load(folder):
    """The run in a folder that `jostle run` made: done, stopped, or still going on.

    Parameters
    ----------
    folder : path

    Returns
    -------
    Run

    Raises
    ------
    InputError
        Where there is no run. A file that is damaged or not there yet is told when it is asked for.

    Examples
    --------
    >>> run = load("rods.run")                                   # doctest: +SKIP
    >>> run.series["Z"].mean(), run.summary["Z"]["standard_error"]   # doctest: +SKIP
    >>> for frame in run.trajectory: ...                         # doctest: +SKIP
    >>> load("nowhere")
    Traceback (most recent call last):
    jostle.InputError: nowhere: there is no such folder. Give the folder that `jostle run` named
    """
    folder = Path(folder)
    if not folder.is_dir():
        refuse("", "", "there is no such folder", suggestion="Give the folder that `jostle run` named",
               file=str(folder))
    if not any((folder / name).exists() for name in _SIGNS):
        refuse("", "", "this is not the folder of a run", suggestion="Give the folder that `jostle run` named",
               file=str(folder))
    return Run(folder)


class Run:
    """What a run left so far. Files are read when they are asked for, and then kept; `load` again for what came since.

    folder : Path
    """

    def __init__(self, folder):
        self.folder = folder

    @cached_property
    def scene(self):
        """Scene, with every default."""
        return Scene.from_toml(self.folder / "resolved.toml")

    @cached_property
    def series(self):
        """series.csv as a structured array, a row every `output.series_every` steps; `columns` tells what is in it."""
        return _table(self.folder / "series.csv")

    @property
    def series_frame(self):
        """The same as a pandas DataFrame; needs pandas."""
        import pandas
        return pandas.DataFrame(self.series)

    @cached_property
    def columns(self):
        """Of the series: name -> dict of unit, symbol, definition, sign."""
        described = _read(self.folder / "series.json", json.loads)
        return {column.pop("name"): column for column in described["columns"]}

    @cached_property
    def summary(self):
        """summary.json, averages with standard errors, as a dict; None until the run is done."""
        path = self.folder / "summary.json"
        return _read(path, json.loads) if path.exists() else None

    @cached_property
    def record(self):
        """run.json as a dict: version, processor, and every start of the command with its reason to end."""
        return _read(self.folder / "run.json", json.loads)

    @cached_property
    def lineage(self):
        """lineage.csv, births and deaths, as a structured array; None where nothing grows."""
        path = self.folder / "lineage.csv"
        return _table(path) if path.exists() else None

    @cached_property
    def contacts(self):
        """contacts.csv, contacts with a force, as a structured array; None without `output.contacts`."""
        path = self.folder / "contacts.csv"
        return _table(path) if path.exists() else None

    @property
    def trajectory(self):
        """Trajectory, whose frames are read when they are asked for. InputError if the run keeps none."""
        return open_trajectory(self.folder)

    def resume(self, motions=()):
        """Simulation that goes on from the run's last checkpoint; nothing is written to the folder."""
        return Simulation.resume(self.folder, motions)

    def __repr__(self):
        return f"<jostle.Run in {self.folder}>"


def _table(path):
    return _read(path, _rows)


def _rows(text):
    """Whole lines of a table: a run that goes on, or was killed, may be within its last one."""
    lines = text[:text.rfind("\n") + 1].splitlines()
    if not lines:
        raise ValueError("it has no header yet")
    names = lines[0].split(",")
    table = np.loadtxt(io.StringIO("\n".join(lines[1:])), delimiter=",", ndmin=2) if lines[1:] else np.empty((0, 0))
    if len(lines) > 1 and table.shape[1] != len(names):
        raise ValueError(f"it has {len(names)} names for {table.shape[1]} columns")
    found = np.empty(len(table), [(name, float) for name in names])
    for k, name in enumerate(names):
        found[name] = table[:, k] if len(table) else 0.0
    return found


def _read(path, parse):
    try:
        return parse(path.read_text())
    except OSError as error:
        refuse("", "", f"cannot be read: {error.strerror}", suggestion=_ADVICE, file=str(path))
    except ValueError as error:
        refuse("", "", f"cannot be used: {' '.join(str(error).split())}", suggestion=_ADVICE, file=str(path))
