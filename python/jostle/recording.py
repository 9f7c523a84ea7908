"""Frames of a simulation, written while it goes on."""

import weakref
from pathlib import Path

from . import _jostle
from ._arrays import whole_number
from ._jostle import refuse
from .gsd_trajectory import require_gsd

ENDINGS = {".h5": "H5MD", ".h5md": "H5MD", ".gsd": "GSD"}


class Recording:
    """A trajectory file that a simulation writes; made by `Simulation.record`.

    path : Path; the file is there once the recording is closed
    journal : Path of its frames until then, beside it: what is left of a program that is killed, and can be analysed, too
    """

    def __init__(self, core, path, every, replace):
        self.path = Path(path)
        if self.path.suffix not in ENDINGS:
            refuse("file", f"{str(path)!r}", "has an ending that names no format", ", ".join(ENDINGS))
        self.journal = self.path.with_name(self.path.name + ".journal")
        for place in (self.path, self.journal):
            if place.exists() and not replace:
                refuse("file", f"{str(place)!r}", "is there already", suggestion="Give another name, or replace=True")
        every = 0 if every is None else whole_number("every", every, 1)
        if every == 0 and core.scene().get("output.trajectory_every") == 0:
            refuse("every", "", "is missing, and the scene keeps no frames: output.trajectory_every = 0", "a number of steps")
        if self.path.suffix == ".gsd":
            require_gsd(self.path)
        number = core.record(str(self.journal), every)
        self._frames = lambda: core.frames_of(number)
        self._end = weakref.finalize(self, _end, core, number, self.path, self.journal)

    def close(self):
        """Ends the recording and makes the file. Raises DiskError, and then the journal is still there.

        It is done by itself at the end of a `with`, where recording and simulation are gone, and when the program ends.
        """
        self._end()

    def __len__(self):
        """Number of frames so far."""
        return self._frames()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        return f"<jostle.Recording of {len(self)} frames in {self.path if not self._end.alive else self.journal}>"


def _end(core, number, path, journal):
    if ENDINGS[path.suffix] == "H5MD":
        core.end_recording(number, str(path))
    else:
        from . import gsd_frames
        from .trajectory import JournalTrajectory
        core.end_recording(number, "")
        beside = path.with_name(path.name + ".tmp")
        try:
            beside.touch()
            gsd_frames.write(beside, JournalTrajectory(journal))
            beside.replace(path)
        except OSError as error:
            beside.unlink(missing_ok=True)
            raise _jostle.DiskError(f"{str(path)!r}: cannot write it: {error.strerror}") from None
    journal.unlink(missing_ok=True)
