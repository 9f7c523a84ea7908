"""A run of several ranks, one of which is killed at any moment: the run goes on with another number of ranks, and ends byte for byte as undisturbed.

mpirun is JOSTLE_MPIRUN (environment), or the one on the PATH; without any there are no cases.
"""

import os
import shutil
import signal
import subprocess
import time

os.environ.setdefault("JOSTLE_MPIRUN", shutil.which("mpirun") or "")

from campaign import Defect  # noqa: E402
from faults import prepared  # noqa: E402
from jostle_command import DONE, STOPPED, changed, finish, with_steps  # noqa: E402
from ranks_command import MPIRUN, SCENES, on_ranks, pid_of_rank, require_same_files, start_on_ranks  # noqa: E402

# A second or two of three ranks, and all kinds of what a rod carries.
KINDS = {name: changed(with_steps(SCENES[name], steps), output={"checkpoint_every": 25})
         for name, steps in {"dense": 250, "swimmers": 300, "warm": 250, "chains": 400, "dying": 150, "colony": 300}.items()}
MOST_RANKS = 5


def cases(random, folder):
    """One kill a case, every second time another one of the run that goes on."""
    references = {}
    while MPIRUN:
        name = random.choice(list(KINDS))
        if name not in references:
            place = prepared(folder / "killed_ranks/reference" / name, KINDS[name])
            began = time.monotonic()
            finish(place)
            references[name] = (place / "run", time.monotonic() - began)
        kills = [(ranks, random.randrange(ranks), random.uniform(0.0, 2.0))
                 for ranks in random.sample(range(2, MOST_RANKS + 1), random.choice([1, 2]))]
        last = random.choice([ranks for ranks in range(MOST_RANKS + 1) if ranks != kills[-1][0]])
        yield lambda: try_kills(folder, name, references[name], kills, last)


def try_kills(folder, name, reference, kills, last):
    """`kills`: (number of ranks, the rank, when, in the time that one process takes for the run)."""
    place = prepared(folder / "killed_ranks/work", KINDS[name])
    told = f"{name}, {', then '.join(f'rank {rank} of {ranks}' for ranks, rank, _ in kills)}, on with {last}"
    try:
        for ranks, rank, part in kills:
            kill_rank(start_on_ranks(place, ranks), rank, part * reference[1])
        result = on_ranks(place, last)
        assert result.returncode == DONE, result.stderr
        require_same_files(place / "run", reference[0])
    except (AssertionError, subprocess.TimeoutExpired) as difference:
        raise Defect(f"{told}: {difference}") from None


def kill_rank(launcher, rank, seconds):
    """After so long, or as soon as there is such a rank; the run may be done by then. The launcher ends the others."""
    time.sleep(seconds)
    while launcher.poll() is None:
        try:
            os.kill(pid_of_rank(launcher, rank), signal.SIGKILL)
            break
        except (AssertionError, ProcessLookupError):
            time.sleep(0.001)
    launcher.communicate(timeout=60)
    assert launcher.returncode != STOPPED, "a rank that was killed stops nothing in order"
