"""Runs of the command, as they lie on the disk."""

from functools import cached_property

from ._jostle import refuse
from .profile import profile_of
from .run_folder import RunFolder, structured
from .scene import Scene
from .simulation import Simulation
from .trajectory import open_trajectory


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
    return Run(folder)


def _refuse(path, problem, advice):
    refuse("", "", problem, suggestion=advice, file=str(path))


class Run(RunFolder):
    """What a run left so far. Files are read when they are asked for, and then kept; `load` again for what came since.

    folder : Path
    summary : dict, summary.json: averages with standard errors; None until the run is done
    record : dict, run.json: version, processor, and every start of the command with its reason to end
    columns : dict, of the series: name -> dict of unit, symbol, definition, sign
    """

    def __init__(self, folder):
        super().__init__(folder, _refuse)

    @cached_property
    def scene(self):
        """Scene, with every default."""
        return Scene.from_toml(self.folder / "resolved.toml")

    @cached_property
    def series(self):
        """series.csv as a structured array, a row every `output.series_every` steps; `columns` tells what is in it."""
        return structured(self.series_columns)

    @property
    def series_frame(self):
        """The same as a pandas DataFrame; needs pandas."""
        import pandas
        return pandas.DataFrame(self.series)

    @cached_property
    def lineage(self):
        """lineage.csv, births and deaths, as a structured array; None where nothing grows."""
        return self._table_if_any("lineage.csv")

    @cached_property
    def contacts(self):
        """contacts.csv, contacts with a force, as a structured array; None without `output.contacts`."""
        return self._table_if_any("contacts.csv")

    @cached_property
    def field(self):
        """field.csv, means over cells of a grid, as a structured array; None without `output.field_every`."""
        return self._table_if_any("field.csv")

    def profile(self, axis, after=0.0):
        """Density and stress across the box, as across a slit: means over layers and over the fields of the run.

        Parameters
        ----------
        axis : "x", "y" or "z"
        after : float
            Fields that end later than this time are averaged over.

        Returns
        -------
        (layers) structured array
            x, y or z, the middle of a layer; number_density; stress_xx ... stress_zz, the whole stress: n kT + collision +
            orientation; and of each a column with `_error`, its standard error, nan where the run holds too few fields. In a slit
            in equilibrium the stress along the normal is the wall pressure in every layer but those at the walls, where it is
            smoothed over a cell.

        Raises
        ------
        InputError
            Without `output.field_every`, for another axis, where no field is late enough, and for runs with springs or torques, whose
            stress fields do not hold, or a kT that changes.
        """
        if axis not in ("x", "y", "z"):
            refuse("axis", repr(axis), "is none", '"x", "y" or "z"')
        tables = self.scene_tables
        if self.field is None:
            refuse("output.field_every", "0", "keeps no field that a profile could be made of", suggestion="Set it in the scene, and run anew")
        if tables.get("springs", {}).get("file") or tables.get("forces", {}).get("alignment_energy") or tables.get("schedule", {}).get("kT"):
            refuse("", "", "fields lack the stress of springs and torques, and a kT that changes", file=str(self.folder))
        if not (self.field["time"] > after).any():
            refuse("after", f"{after:g}", "leaves no field", f"less than {self.field['time'].max():g}")
        kT = tables["fluid"]["kT"] if tables.get("motion", {}).get("brownian", True) else 0.0
        return profile_of(self.field, axis, kT, tables["box"].get("dimensions", 3), after)

    @property
    def trajectory(self):
        """Trajectory, whose frames are read when they are asked for. InputError if the run keeps none."""
        return open_trajectory(self.folder)

    def resume(self, motions=()):
        """Simulation that goes on from the run's last checkpoint; nothing is written to the folder."""
        return Simulation.resume(self.folder, motions)

    def _table_if_any(self, name):
        return structured(self.table(name)) if (self.folder / name).exists() else None

    def __repr__(self):
        return f"<jostle.Run in {self.folder}>"
