"""What a run left, beside its trajectory: scene, series, averages, and how it ran."""

import io
import json
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import units
from refusal import Refusal

SIGNS = ("run.json", "resolved.toml", "checkpoint", "trajectory.h5", "series.csv")


@dataclass
class Run:
    folder: Path
    scene: dict     # with every default
    series: dict    # column name -> numbers, one a row
    columns: dict   # column name -> what series.json tells of it
    summary: dict   # empty if the run is not done
    record: dict    # run.json

    @property
    def title(self):
        return self.scene.get("title") or self.folder.resolve().name

    @property
    def propelled(self):
        return self.scene.get("motion", {}).get("self_propulsion", 0) != 0

    @property
    def grows(self):
        return self.scene.get("growth", {}).get("rate", 0) != 0

    @property
    def is_colony(self):
        """Whether cells multiply: then there is no state that lasts, and nothing to average."""
        number = self.series["N"]
        return self.grows and number[-1] >= 1.5 * number[0]

    def in_unit(self, column):
        """(factor, unit) by which people read a column of the series: factor times the number is in the unit."""
        return self.readable(self.columns.get(column, {}).get("unit", "1"))

    def readable(self, unit):
        """The same of a unit as the files write it."""
        return units.readable(unit, self.scene)

    def table(self, name):
        """Columns of another table of the run, as those of the series; none if it has no row."""
        return _read(self.folder / name, lambda text: _columns_of_text(text, empty=True))


def require_run_folder(folder):
    folder = Path(folder)
    if not folder.exists():
        raise Refusal(folder, "there is no such folder", "Give the folder that `jostle run` named")
    if not folder.is_dir() or not any((folder / name).exists() for name in SIGNS):
        raise Refusal(folder, "this is not the folder of a run", "Give the folder that `jostle run` named")
    return folder


def read_run(folder):
    folder = require_run_folder(folder)
    described = _read(folder / "series.json", json.loads)
    return Run(folder=folder, scene=_read(folder / "resolved.toml", tomllib.loads),
               series=_read(folder / "series.csv", _columns_of_text),
               columns={column["name"]: column for column in described["columns"]},
               summary=_read(folder / "summary.json", json.loads) if (folder / "summary.json").exists() else {},
               record=_read(folder / "run.json", json.loads))


def _columns_of_text(text, empty=False):
    lines = text.splitlines(keepends=True)
    if lines and not lines[-1].endswith("\n"):
        lines.pop()  # a run that goes on, or was killed, may be within a row
    names = lines[0].strip().split(",") if lines else []
    if len(lines) < 2:
        if empty:
            return {name: np.empty(0) for name in names}
        raise ValueError("it has no row yet")
    rows = np.loadtxt(io.StringIO("".join(lines[1:])), delimiter=",", ndmin=2)
    return dict(zip(names, rows.T, strict=True))


def _read(path, parse):
    try:
        return parse(path.read_text())
    except OSError as error:
        raise Refusal(path, f"cannot be read: {error.strerror}", "`jostle verify` tells the state of a run") from None
    except ValueError as error:
        problem = " ".join(str(error).split())
        raise Refusal(path, f"cannot be used: {problem}", "`jostle verify` tells the state of a run") from None
