"""What lineage.csv tells of the cells that are there at a time: generation, age, family."""

import numpy as np

FAMILIES = 8  # the daughters of a few founders are told apart until there are so many


class Lineage:
    """Goes through births and deaths in the order of time. A cell that divides lives on behind her daughter under her id."""

    def __init__(self, run, frames):
        rows = run.table("lineage.csv")
        self._events = list(zip(rows["step"], rows["time"], rows["birth"], rows["id"].astype(int), rows["mother"].astype(int)))
        self._next = 0
        known = {cell for frame in frames for cell in frame.id.tolist()} | {mother for *_, mother in self._events}
        founders = sorted(known - {cell for *_, birth, cell, _ in self._events if birth})
        self._of = {cell: (0, 0.0, family) for family, cell in enumerate(founders)}  # generation, birth, family
        self._families = len(self._of)

    def at(self, frame):
        """generation, age, family of the frame's cells, (N) each. Frames must be asked for in the order of time."""
        while self._next < len(self._events) and self._events[self._next][0] <= frame.step:
            self._take(*self._events[self._next])
            self._next += 1
        unknown = (0, np.nan, 0)
        generation, born, family = np.array([self._of.get(cell, unknown) for cell in frame.id.tolist()]).reshape(-1, 3).T
        return generation, frame.time - born, family

    def _take(self, _, time, birth, cell, mother):
        if not birth:
            self._of.pop(cell, None)
            return
        generation, _, family = self._of[mother]
        self._of[mother] = (generation + 1, time, family)
        if self._families < FAMILIES:
            family = self._families
            self._families += 1
        self._of[cell] = (generation + 1, time, family)
