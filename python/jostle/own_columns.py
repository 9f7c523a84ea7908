"""Columns of the series that are functions of a user."""

import numpy as np

from ._arrays import number
from ._jostle import refuse
from .statistics import Average


class OwnColumns:
    """Values at the rows of a series, beside those of the extension; the first `names` of a row are its own."""

    def __init__(self, names):
        self._names = list(names)
        self._functions = {}  # name: (function, unit, definition)
        self._values = {}     # name: list, one a row
        self._rows = 0        # of the series that were looked at

    def add(self, simulation, name, function, unit, definition):
        if not isinstance(name, str) or not name.isidentifier():
            refuse("name", repr(name), "is no name for a column", "letters, digits and _, as \"cos2\"")
        if name in self._names or name in self._functions:
            refuse("name", repr(name), "is a column already")
        if not callable(function):
            refuse("function", repr(function), "cannot be called", "a function of the simulation")
        self._rows = simulation._core.row_count()
        self._functions[name] = (function, str(unit), str(definition))
        self._values[name] = [np.nan] * self._rows

    def steps_to_next_row(self, simulation, most):
        if not self._functions:
            return most
        every = simulation._core.scene().get("output.series_every")
        return min(most, every - simulation.clock.step % every)

    def look(self, simulation):
        """Calls the functions if there is a row that they have not seen."""
        if not self._functions:
            return
        rows = simulation._core.row_count()
        if rows == self._rows:
            return
        missed, self._rows = rows - self._rows, rows
        for values in self._values.values():  # first, so that all stay as long as the series, whatever the functions raise
            values.extend([np.nan] * missed)
        for name, (function, *_) in self._functions.items():
            self._values[name][-1] = number(f"column {name}", function(simulation))

    def described(self):
        """(name, unit, symbol, definition, sign) of each."""
        return [(name, unit, "", definition, "") for name, (_, unit, definition) in self._functions.items()]

    def beside(self, table):
        """The series (rows, columns) with these columns, as a structured array."""
        names = [*self._names, *self._functions]
        count = len(table)  # within a function the others may have a row more
        own = [np.array(values[:count] + [np.nan] * (count - len(values))) for values in self._values.values()]
        return np.ascontiguousarray(np.column_stack([table, *own])).view(np.dtype([(name, float) for name in names]))[:, 0]

    def in_summary(self, summary, average_of):
        """The summary with the averages of these columns, over the rows of production that have a value: average_of(rows)."""
        if not self._functions:
            return summary
        pressure = summary["pressure"]
        withheld = "" if summary["equilibrated"] else pressure.get("no_standard_error_because", "")
        summary["columns"] = {}
        for name, (_, unit, _) in self._functions.items():
            values = np.array(self._values[name])[-summary["production_rows"]:]
            summary["columns"][name] = _entry(values, unit, withheld, average_of)
        return summary


def _entry(values, unit, withheld, average_of):
    if np.isnan(values).all():
        return {"mean": None, "standard_error": None, "n_eff": 0.0, "unit": unit, "no_standard_error_because": "no row of production has it"}
    found = Average(**average_of(values))
    entry = {"mean": found.mean, "standard_error": found.standard_error, "n_eff": found.n_eff,
             "standard_deviation": found.standard_deviation, "correlation_time_rows": found.correlation_time_rows, "unit": unit}
    if withheld:
        entry["standard_error"] = None
    if entry["standard_error"] is None:
        entry["no_standard_error_because"] = withheld or found.no_standard_error_because
    return entry
