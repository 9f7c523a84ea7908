"""A run that is killed, or whose disk fails, at each call that changes a file: the same command goes on and ends as if nothing had been.

fault.c is preloaded, counts those calls and spoils one of them.
"""

import errno
import shutil
import signal
import subprocess
from pathlib import Path

from campaign import Defect, jostle, require_ending
from jostle_command import DISK, DONE, require_same_results, scene_text

import folders

KINDS = {name: {**scene, "output": {**scene["output"], "series_every": 10, "trajectory_every": 25}}
         for name, scene in folders.KINDS.items()}
ERRORS = (errno.ENOSPC, errno.EIO, errno.EDQUOT, errno.EROFS, errno.EINTR)
ARGUMENTS = ("run", "scene.toml", "--out", "run", "--threads", "1")


def interposer(folder):
    """Compiles fault.c; the path of the library to preload."""
    library = folder / "fault.so"
    if not library.exists():
        folder.mkdir(parents=True, exist_ok=True)
        source = Path(__file__).with_name("fault.c")
        subprocess.run(["cc", "-O1", "-Wall", "-Werror", "-shared", "-fPIC", "-o", library, source, "-ldl"], check=True)
    return library


def prepared(place, scene):
    shutil.rmtree(place, ignore_errors=True)
    place.mkdir(parents=True)
    (place / "scene.toml").write_text(scene_text(scene))
    return place


def with_fault(place, library, kind, at):
    """The command with the k-th call spoiled."""
    return jostle(place, *ARGUMENTS, environment={"LD_PRELOAD": str(library), "JOSTLE_FAULT": str(kind),
                                                  "JOSTLE_FAULT_AT": str(at)})


def counted(place, library):
    """A whole run; how many calls it makes."""
    count = place / "count"
    require_ending(jostle(place, *ARGUMENTS, environment={"LD_PRELOAD": str(library), "JOSTLE_FAULT_COUNT": str(count)}), DONE)
    return int(count.read_text().split()[-1])


def cases(random, folder):
    """One fault a case, of a run from its beginning; every second time another fault of the run that goes on."""
    library = interposer(folder / "faults")
    references = {}
    for name, scene in KINDS.items():
        place = prepared(folder / "faults/reference" / name, scene)
        references[name] = (place / "run", counted(place, library))
    while True:
        name = random.choice(list(KINDS))
        kinds = ["kill", "torn", "short", random.choice(ERRORS), -errno.ENOSPC]
        faults = [(random.choice(kinds), random.randint(1, references[name][1])) for _ in range(random.choice([1, 2]))]
        yield lambda: try_faults(folder, library, name, references[name][0], faults)


def try_faults(folder, library, name, reference, faults):
    place = prepared(folder / "faults/work", KINDS[name])
    told = f"{name}, {', then '.join(f'{kind} at call {at}' for kind, at in faults)}"
    try:
        for kind, at in faults:
            result = with_fault(place, library, kind, at)
            require_ending(result, DONE, DISK, -signal.SIGKILL)
            if kind in ("kill", "torn") and result.returncode == DISK:
                raise Defect("a disk error without one")
            if (place / "run/checkpoint").exists():
                require_ending(jostle(place, "verify", "run"), DONE)
        require_ending(jostle(place, *ARGUMENTS), DONE)
        require_same_results(place / "run", reference)
    except AssertionError as difference:
        raise Defect(f"{told}: {difference}") from None
    except Defect as defect:
        raise Defect(f"{told}: {defect}") from None
