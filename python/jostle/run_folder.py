"""What the command left in the folder of a run. Needs NumPy alone: the programs of presentation/, sweeps/ and studies/
read by this file, too, without the extension."""

import io
import json
import tomllib
from functools import cached_property
from pathlib import Path

import numpy as np

SIGNS = ("run.json", "resolved.toml", "checkpoint", "trajectory.h5", "series.csv")
WHICH = "Give the folder that `jostle run` named"
VERIFY = "`jostle verify` tells the state of a run"


class RunFolder:
    """Files of a run that is done, was stopped, or goes on. They are read when they are asked for, and kept.

    folder : Path
    refuse : function of (path, problem, advice) that raises the caller's own error
    """

    def __init__(self, folder, refuse):
        self.folder = require_run_folder(folder, refuse)
        self._refuse = refuse

    @cached_property
    def scene_tables(self):
        """{table: {key: value}} of the scene, with every default."""
        return self._read("resolved.toml", tomllib.loads)

    @cached_property
    def series_columns(self):
        """{name: (rows) array} of the series."""
        return self.table("series.csv")

    @cached_property
    def columns(self):
        """{name: {unit, symbol, definition, sign}} of the series."""
        described = self._read("series.json", json.loads)
        return {column.pop("name"): column for column in described["columns"]}

    @cached_property
    def summary(self):
        """summary.json as a dict; None until the run is done."""
        return self._read("summary.json", json.loads) if (self.folder / "summary.json").exists() else None

    @cached_property
    def record(self):
        """run.json as a dict: version, processor, and every start of the command with its reason to end."""
        return self._read("run.json", json.loads)

    @cached_property
    def fixed_rods(self):
        """{x, y, z, nx, ny, nz, length, diameter: (rods) array} of rods that do not move; None where there are none."""
        return self.table("fixed.csv") if (self.folder / "fixed.csv").exists() else None

    def table(self, name):
        """{name: (rows) array} of a table: series.csv, contacts.csv, lineage.csv, field.csv."""
        return self._read(name, columns_of)

    def _read(self, name, parse):
        path = self.folder / name
        try:
            return parse(path.read_text())
        except OSError as error:
            self._refuse(path, f"cannot be read: {error.strerror}", VERIFY)
        except ValueError as error:
            self._refuse(path, f"cannot be used: {' '.join(str(error).split())}", VERIFY)


def require_run_folder(folder, refuse):
    folder = Path(folder)
    if not folder.exists():
        refuse(folder, "there is no such folder", WHICH)
    if not folder.is_dir() or not any((folder / name).exists() for name in SIGNS):
        refuse(folder, "this is not the folder of a run", WHICH)
    return folder


def columns_of(text):
    """{name: (rows) array} of the whole lines of a table: a run that goes on, or was killed, may be within its last one."""
    lines = text[:text.rfind("\n") + 1].splitlines()
    if not lines:
        raise ValueError("it has no header yet")
    names = lines[0].split(",")
    if len(lines) == 1:
        return {name: np.empty(0) for name in names}
    rows = np.loadtxt(io.StringIO("\n".join(lines[1:])), delimiter=",", ndmin=2)
    if rows.shape[1] != len(names):
        raise ValueError(f"it has {len(names)} names for {rows.shape[1]} columns")
    return dict(zip(names, rows.T))


def structured(columns):
    """(rows) structured array of {name: (rows) array}."""
    found = np.empty(len(next(iter(columns.values()))), [(name, float) for name in columns])
    for name, values in columns.items():
        found[name] = values
    return found
