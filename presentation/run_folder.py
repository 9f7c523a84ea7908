"""What a run left, beside its trajectory, as pages, films, tables of runs and studies look at it."""

import importlib.util
from pathlib import Path

import units
from refusal import Refusal


def of_the_package(name):
    """A module of the Python package that needs no extension, from its file: the package itself does."""
    path = Path(__file__).resolve().parents[1] / "python" / "jostle" / f"{name}.py"
    spec = importlib.util.spec_from_file_location(f"jostle_{name}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


_reader = of_the_package("run_folder")
RunFolder, structured = _reader.RunFolder, _reader.structured


def _refuse(path, problem, advice):
    raise Refusal(path, problem, advice) from None


class Run(RunFolder):
    """Raises Refusal where a file cannot be used.

    scene : {table: {key: value}}, with every default
    series : {column: numbers, one a row}, at least one row
    """

    def __init__(self, folder):
        super().__init__(folder, _refuse)

    @property
    def scene(self):
        return self.scene_tables

    @property
    def series(self):
        if len(next(iter(self.series_columns.values()))) == 0:
            _refuse(self.folder / "series.csv", "cannot be used: it has no row yet", _reader.VERIFY)
        return self.series_columns

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

    @property
    def dimensions(self):
        return self.scene.get("box", {}).get("dimensions", 3)

    @property
    def fraction(self):
        """What phi is."""
        return "area fraction" if self.dimensions == 2 else "volume fraction"

    def in_unit(self, column):
        """(factor, unit) by which people read a column of the series: factor times the number is in the unit."""
        return self.readable(self.columns.get(column, {}).get("unit", "1"))

    def readable(self, unit):
        """The same of a unit as the files write it."""
        return units.readable(unit, self.scene)


def require_run_folder(folder):
    return _reader.require_run_folder(folder, _refuse)


def read_run(folder):
    """The run in a folder, all of whose small files are sound; its summary is {} if it is not done."""
    run = Run(folder)
    run.summary = run.summary or {}
    _ = run.scene, run.series, run.columns, run.record
    return run
