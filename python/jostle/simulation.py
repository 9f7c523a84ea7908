"""Simulations, step by step."""

import json
from pathlib import Path

import numpy as np

from . import _jostle
from ._arrays import whole_number, with_shape
from ._jostle import DiskError, refuse
from .own_columns import OwnColumns
from .own_motions import asking
from .recording import Recording
from .scene import Scene
from .start import core_with_rods
from .step_report import Clock, StepFailure, StepReport
from .stress import orientation_stress

CONTACT = np.dtype([("id_i", np.uint64), ("id_j", np.uint64), ("image", np.int32, 3), ("force", float), ("gap", float),
                    ("normal", float, 3), ("arm_i", float), ("arm_j", float), ("wall", np.int32), ("fixed", np.int64)])
LINEAGE = np.dtype([("birth", bool), ("id", np.uint64), ("mother", np.uint64), ("length", float)])


class Simulation:
    """Rods in a box that move by steps.

    Parameters
    ----------
    scene : Scene
        Is copied: later changes of it change nothing here.
    rods : optional
        Where they begin, in the place of `rods.start`: the folder of a run (its last state, to the last bit, with the swimmers' own
        speeds), a trajectory file (H5MD, GSD; its last frame), a Frame, or a dict of arrays centre, axis (N, 3), length, diameter and, if
        you like, speed (N), as for `jostle.analysis`. The box is that of the scene. A scene with springs takes a folder.
    motions : functions, or one function
        Motions of your own, beside those of the scene. `motion(rods, clock)` is called at every step with the rods
        before it, as `Simulation.rods` shows them, and returns velocities (N, 3), or velocities and angular velocities
        ((N, 3), (N, 3)), in the order of ids. What it raises ends the step, and nothing has changed. Random motions
        should draw from np.random.default_rng((seed, clock.step)): then runs can be repeated and resumed.

    Notes
    -----
    Arrays. `rods` shows the rods at one time as read-only arrays in the order of ids, without copying. They belong to
    that time: a step changes no array that you hold, but gives new ones, and they stay valid when the simulation is
    gone, when rows are renumbered and when cells divide or die. Keep `id` to follow a rod.

    Series. Every `output.series_every` steps a row is added to `series`, the one that `jostle run` writes, bit for bit.
    `summary()` averages them, and gives the error bars of summary.json.

    Threads. Steps are made without Python's global lock. Another thread that looks at the simulation then gets a
    RuntimeError. `set_thread_count` sets how many threads a step uses; results do not depend on it.

    Examples
    --------
    >>> scene = Scene(seed=3, box={"volume_fraction": 0.3}, rods={"count": 60, "length": 1.0},
    ...               time={"production": 1.0})
    >>> simulation = Simulation(scene)
    >>> rows = simulation.run(20)                         # simulation.run() makes all steps that the scene asks for
    >>> rows["step"], bool(rows["Z"][-1] > 1)
    (array([10., 20.]), True)
    >>> simulation.rods.centre.shape, simulation.clock.step
    ((60, 3), 20)
    """

    def __init__(self, scene, motions=(), *, rods=None):
        if not isinstance(scene, Scene):
            refuse("scene", f"a {type(scene).__name__}", "is no scene", "a Scene, as Scene.from_toml gives it")
        self._begin(_jostle.Simulation(scene._core) if rods is None else core_with_rods(scene, rods), motions)

    @classmethod
    def resume(cls, folder, motions=()):
        """Goes on from the last checkpoint in a folder: of `jostle run`, or of `save`. Nothing is written there.

        It goes on as if it had never stopped, bit for bit, for any number of threads. Motions of your own are not in
        a checkpoint: give them again. Raises InputError where there is no sound checkpoint.
        """
        simulation = cls.__new__(cls)
        simulation._begin(_jostle.Simulation.resume(str(folder)), motions)
        return simulation

    def _begin(self, core, motions):
        self._core = core
        self._recordings = []
        self._own = OwnColumns([column[0] for column in core.columns()])
        for motion in [motions] if callable(motions) else motions:
            self.add_motion(motion)

    def add_motion(self, motion):
        """Adds a motion of your own, felt from the next step on; see Simulation for what it is called with."""
        if not callable(motion):
            refuse("motion", repr(motion), "cannot be called", "a function of (rods, clock)")
        self._core.add_motion(asking(self._core, motion))  # not self: what the extension holds must not hold this object

    def step(self):
        """Makes one step, and tells of it. Raises StepFailure, and what motions raise.

        >>> simulation = Simulation(Scene(box={"edges": [9, 9, 9]}, rods={"count": 9, "length": 1},
        ...                               time={"production": 1}))
        >>> simulation.step().converged
        True
        """
        self._core.step()
        self._own.look(self)
        self._require_success()
        return self.report

    def run(self, steps=None, *, every=None, callback=None):
        """Makes steps, fewer if no cells are left, and returns the rows that they added to the series.

        Parameters
        ----------
        steps : int, >= 0
            By default as many as `jostle run` makes: until `time.equilibration` and `time.production` are over, or with
            equilibration = "auto" until the series has settled for so long.
        callback : function of the simulation, optional
            Called after every step whose number is a multiple of `every`.
        every : int, >= 1
            By default `output.series_every` of the scene.

        Ctrl-C ends it after the present step, by KeyboardInterrupt; so does what a callback raises. The simulation is
        then whole, and can go on; rows are in `series`. Raises StepFailure.

        >>> simulation = Simulation(Scene(box={"edges": [9, 9, 9]}, rods={"count": 9, "length": 1},
        ...                               time={"production": 1}))
        >>> seen = []
        >>> rows = simulation.run(8, every=3, callback=lambda simulation: seen.append(simulation.clock.step))
        >>> seen
        [3, 6]
        """
        to_the_end = steps is None
        left = 2**62 if to_the_end else whole_number("steps", steps, 0)
        every = self.scene.output.series_every if every is None else whole_number("every", every, 1)
        before = self._core.row_count()
        while left > 0 and len(self) > 0 and not (to_the_end and self._core.is_complete()):
            portion = left if callback is None else min(left, every - self.clock.step % every)
            portion = self._own.steps_to_next_row(self, portion)
            try:
                self._core.run(portion, to_the_end)
            finally:
                self._own.look(self)
            self._require_success()
            left -= portion
            if callback is not None and self.clock.step % every == 0:
                callback(self)
        return self.series[before:]

    def _require_success(self):
        if failure := self._core.failure():
            raise StepFailure(f"step {self.report.step} failed: {failure}", self.report)

    def __len__(self):
        """Number of rods."""
        return self._core.count()

    @property
    def scene(self):
        """A copy of the scene, with every default."""
        return Scene._of(self._core.scene())

    @property
    def rods(self):
        """The rods as they are now: read-only arrays, in the order of ids.

        id (N), uint64, permanent; centre (N, 3), length, inside the box along periodic directions; axis (N, 3), unit
        vectors; length, diameter (N), length; image (N, 3), int32, box edges crossed since the start.
        """
        return self._core.rods()

    @property
    def clock(self):
        """Steps done, simulated time, length of a step."""
        return Clock(*self._core.clock())

    @property
    def edges(self):
        """(3) array, length: edges of the box, whose lowest corner is the origin; of a flat box the last is 0."""
        return self._core.box()[0]

    @property
    def periodic(self):
        """Whether the box is periodic, along x, y, z."""
        return tuple(self._core.box()[1])

    @property
    def offset(self):
        """Length by which the copies above along y are displaced along x, where a flow shears the box; else 0."""
        return self._core.box()[3]

    @property
    def volume(self):
        """Of the box, length**3; of a flat box its area, length**2, which stresses refer to: force length**-1."""
        return self._core.box()[2]

    @property
    def dimensions(self):
        """2 of a flat box, whose rods are in the plane z = 0; else 3."""
        return 3 if self.edges[2] else 2

    @property
    def kT(self):
        """Of the Brownian motion; 0 where there is none."""
        return self._core.kT()

    @property
    def report(self):
        """StepReport of the last step; None before the first."""
        report = self._core.report()
        return report and StepReport(**report)

    @property
    def stress(self):
        """(3, 3) array, force length**-2: the whole stress, n kT I + orientation + collisions + springs (theory, eq. 1.19); None before
        the first step. The active stress of swimmers is no part of it.

        Positive in compression; collisions and springs are those of the last step, and noisy: means over many are in `series`.
        """
        report = self.report
        if not report:
            return None
        kinetic = report.rods * self.kT * np.diag([1.0, 1.0, self.dimensions - 2.0])
        return (kinetic + report.collision_virial + report.spring_virial) / self.volume + self.stress_orientation

    @property
    def stress_collision(self):
        """(3, 3) array, force length**-2: its part from the collisions of the last step; None before it."""
        report = self.report
        return report and report.collision_virial / self.volume

    @property
    def stress_orientation(self):
        """(3, 3) array, force length**-2: its part from the Brownian rotation of the rods as they are now."""
        return orientation_stress(self.rods, self.kT, self.volume, self.dimensions)

    @property
    def contacts(self):
        """Contacts of the last step that has been made, as a structured array, with the rods as they were before it, but for growth: cells
        lengthen as a step begins.

        id_i < id_j; image (3), box edges by which j is displaced; force >= 0; gap, length, before the step; normal (3),
        unit vector from i to j; arm_i, arm_j, length, along the axes from the centres; wall, -1 between rods. With a wall
        id_i = id_j is the rod, the normal is from the wall to it, and wall is 0, 1 for the lower and upper face across x, 2, 3
        across y, 4, 5 across z, 6 for a sphere or tube. With a fixed rod it is the same, arm_i is along the fixed rod, and fixed
        is its number in the file, from 0; -1 else.
        """
        columns = self._core.contacts()
        table = np.empty(len(columns["force"]), CONTACT)
        table["id_i"], table["id_j"] = columns.pop("id").T
        for name, values in columns.items():
            table[name] = values
        return table

    @property
    def lineage(self):
        """Who was born and who died after the last step: structured array of birth (else death), id, mother, length."""
        return np.array(self._core.lineage(), LINEAGE)

    @property
    def series(self):
        """All rows since this object was made, as a structured array: the columns of series.csv, then your own.

        `columns` tells their units and meanings.
        """
        return self._own.beside(self._core.series())

    @property
    def columns(self):
        """Of the series: name -> dict of unit, symbol, definition, sign."""
        return {name: dict(zip(("unit", "symbol", "definition", "sign"), rest))
                for name, *rest in [*self._core.columns(), *self._own.described()]}

    def add_column(self, name, function, unit="1", definition=""):
        """Adds a column of your own to the series: function(simulation), a number, is taken at every row from now on.

        name : str, an identifier that no column has yet; unit, definition : str, for `columns`

        It is called between two steps, when the row is made, and may look at all of the simulation. NaN stands in the rows before. Its
        mean over production, with the error bar of all other averages, is `summary()["columns"][name]`. What the function raises ends
        `run` or `step`, and leaves NaN in that row. It is in no checkpoint: add it again after `resume`. Raises InputError for a name
        that is taken or none, and for what the function returns unless it is a number.

        >>> scene = Scene(box={"edges": [9, 9, 9]}, rods={"count": 9, "length": 1}, time={"production": 1})
        >>> simulation = Simulation(scene)
        >>> simulation.add_column("cos2", lambda simulation: (simulation.rods.axis[:, 2]**2).mean())
        >>> simulation.run(20)["cos2"].shape
        (2,)
        """
        self._own.add(self, name, function, unit, definition)

    def record(self, file, every=None, *, replace=False):
        """Writes the rods as they are now, and after every step whose number is a multiple of `every`, to a trajectory file.

        Parameters
        ----------
        file : path
            Its ending says the format: .h5, H5MD as trajectory.h5 of a run; .gsd for OVITO and freud, which needs the package gsd.
        every : int, steps; by default as the scene says, about 100 frames (`output.trajectory_every`)
        replace : bool, whether a file of that name may be written over

        Returns
        -------
        Recording
            Its `close()` makes the file; so do the end of a `with` and the end of the program. Until then the frames stand in a journal
            beside it.

        Raises
        ------
        InputError
            For an unknown ending, a file that is there already, and gsd where it is not there.
        DiskError
            Also from the steps that follow; the simulation is then whole.

        >>> import tempfile
        >>> scene = Scene(box={"edges": [9, 9, 9]}, rods={"count": 9, "length": 1}, time={"production": 1})
        >>> simulation = Simulation(scene)
        >>> with tempfile.TemporaryDirectory() as folder:
        ...     with simulation.record(folder + "/rods.h5", every=5) as recording:
        ...         rows = simulation.run(20)
        ...     len(recording), recording.path.exists()
        (5, True)
        """
        self._recordings.append(Recording(self._core, file, every, replace))
        return self._recordings[-1]

    def summary(self):
        """Averages of the rows so far with their error bars: a dict, the content of summary.json (docs/guide/results.md).

        It holds mean, standard_error and n_eff of Z, pressure, stress, order and others over the rows of production, the
        verdict on equilibrium, and checks of the stress. Rows of before `resume` are not among them. Without equilibrium
        there are no error bars: standard_error is None, and `no_standard_error_because` tells why.

        Raises InputError where no row is of production yet.

        >>> scene = Scene(box={"volume_fraction": 0.1}, rods={"count": 50, "length": 0},
        ...               time={"equilibration": 1.0, "production": 60.0})
        >>> simulation = Simulation(scene)
        >>> rows = simulation.run()
        >>> Z = simulation.summary()["Z"]
        >>> bool(abs(Z["mean"] - 1.52) < 4 * Z["standard_error"])            # Carnahan and Starling
        True
        """
        return self._own.in_summary(json.loads(self._core.summary()), self._core.average_of)

    @property
    def field(self):
        """The last stress field that is complete, with `output.field_every`: the rows of field.csv as a structured array,
        means over the steps since the field before; None before the first."""
        rows = self._core.last_field()
        if len(rows) == 0:
            return None
        return rows.view(np.dtype([(column[0], float) for column in self._core.field_columns()]))[:, 0]

    def velocities(self, force=0.0, torque=0.0):
        """What forces and torques on the rods make of their velocities, by the mobility of the scene.

        force, torque : (N, 3) arrays, or what broadcasts to it; in the order of ids. Returns velocities and angular
        velocities, (N, 3) each. For motions that push: return simulation.velocities(force).

        >>> simulation = Simulation(Scene(box={"edges": [9, 9, 9]}, rods={"count": 9, "length": 0},
        ...                               time={"production": 1}))
        >>> velocity, _ = simulation.velocities(force=[3 * np.pi, 0, 0])  # Stokes: F = 3 pi mu D U
        >>> velocity[0].round(12)
        array([1., 0., 0.])
        """
        shape = (len(self), 3)
        found = self._core.velocities(with_shape("force", force, shape, repeat=True),
                                      with_shape("torque", torque, shape, repeat=True))
        return found[:, :3], found[:, 3:]

    def save(self, folder):
        """Writes a checkpoint into a folder, for `resume`; the one before is kept as checkpoint.previous.

        The folder is made if it is not there. That of a run of the command is refused. Raises DiskError, and within a
        motion RuntimeError: a step is then half done.
        """
        folder = Path(folder)
        if (folder / "run.json").exists():
            refuse("folder", str(folder), "holds a run of the command, whose checkpoint must fit its files",
                   suggestion="Give another folder")
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except (OSError, ValueError) as error:  # ValueError: the name holds a character 0
            raise DiskError(f"{str(folder)!r}: cannot make the folder: {getattr(error, 'strerror', error)}") from None
        self._core.save(str(folder))

    def __repr__(self):
        clock = self.clock
        return f"<jostle.Simulation of {len(self)} rods, step {clock.step}, time {clock.time:.6g}>"
