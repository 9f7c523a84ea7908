"""What a run left, beside its trajectory: scene, series, averages, and how it ran."""

import io
import json
import tomllib
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from refusal import Refusal

SIGNS = ("run.json", "resolved.toml", "checkpoint", "trajectory.h5", "series.csv")
RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


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

    def unit(self, column):
        """Of a column, to be read by people; empty for a pure number."""
        return readable_unit(self.columns.get(column, {}).get("unit", "1"))


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


def readable_unit(unit):
    """pN um-2 as it is printed: pN µm⁻². The unit 1 is none."""
    if unit == "1":
        return ""
    factors = []
    for factor in unit.split():
        name = factor.rstrip("-0123456789")
        power = factor[len(name):]
        name = {"mu": "µ", "um": "µm"}.get(name, name)
        factors.append(name + superscript(power))
    return " ".join(factors)


def superscript(number):
    return str(number).translate(RAISED)


def _columns_of_text(text):
    lines = text.splitlines(keepends=True)
    if lines and not lines[-1].endswith("\n"):
        lines.pop()  # a run that goes on, or was killed, may be within a row
    if len(lines) < 2:
        raise ValueError("it has no row yet")
    rows = np.loadtxt(io.StringIO("".join(lines[1:])), delimiter=",", ndmin=2)
    return dict(zip(lines[0].strip().split(","), rows.T, strict=True))


def _read(path, parse):
    try:
        return parse(path.read_text())
    except OSError as error:
        raise Refusal(path, f"cannot be read: {error.strerror}", "`jostle verify` tells the state of a run") from None
    except ValueError as error:
        problem = " ".join(str(error).split())
        raise Refusal(path, f"cannot be used: {problem}", "`jostle verify` tells the state of a run") from None
