"""Calls of the Python module that nobody would make on purpose, many in one interpreter: an answer, or one of the documented errors; never an end of the interpreter.

A case is a seed; misuse_calls.py makes the calls of it.
"""

import os
import subprocess
import sys
from pathlib import Path

from campaign import Defect, MOST_SECONDS, PATIENCE

MODULE = Path(os.environ["JOSTLE"]).parents[1] / "python"
CALLS = Path(__file__).with_name("misuse_calls.py")


def cases(random, folder):
    folder.mkdir(parents=True, exist_ok=True)
    while True:
        seed = random.randrange(10**9)
        yield lambda: try_calls(seed, folder)


def try_calls(seed, folder):
    environment = {**os.environ, "PYTHONPATH": str(MODULE), "PYTHONFAULTHANDLER": "1", "OMP_NUM_THREADS": "1"}
    try:
        result = subprocess.run([sys.executable, CALLS, str(seed)], cwd=folder, capture_output=True, text=True,
                                timeout=PATIENCE * MOST_SECONDS, env=environment, errors="backslashreplace")
    except subprocess.TimeoutExpired as hung:
        raise Defect(f"calls of seed {seed}: no end; the last was {(hung.stdout or b'')[-300:]!r}") from None
    if result.returncode != 0:
        last = result.stdout.splitlines()[-1:] or ["none"]
        raise Defect(f"calls of seed {seed}: status {result.returncode} in {last[0][:400]}: {result.stderr[-600:]}")
