"""What the campaigns share: a case that failed, running the command within limits, and what every run of it must keep."""

import os
import re
import resource
import signal
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "cli"))
from jostle_command import BAD_INPUT, DISK, JOSTLE, NOTICES  # noqa: E402

MOST_MEMORY = 2 * 1024**3  # bytes of address space that one command may take
MOST_SECONDS = 60.0  # of processor time
PATIENCE = 10.0  # by the clock it may take so many times as long: other programs may keep the machine busy
MISTAKE = re.compile(rb"\S+\.toml:\d+:\d+: ")  # begins the line of a further mistake: file, line, column


class Defect(Exception):
    """A promise of the program that a case broke, in one sentence."""


def limit(seconds):
    resource.setrlimit(resource.RLIMIT_CPU, (int(seconds), int(seconds) + 1))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if not sanitized():
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


def jostle(folder, *arguments, environment=None, seconds=MOST_SECONDS):
    """Runs the command to its end in the folder. Defect if it hangs."""
    told = f"no end within {seconds:.0f} s: {' '.join(map(str, arguments))}"
    try:
        result = subprocess.run([JOSTLE, *map(str, arguments)], cwd=folder, capture_output=True, timeout=PATIENCE * seconds,
                                stdin=subprocess.DEVNULL, preexec_fn=lambda: limit(seconds),
                                env={**os.environ, "OMP_NUM_THREADS": "1", **(environment or {})})
    except subprocess.TimeoutExpired:
        raise Defect(told) from None
    if result.returncode == -signal.SIGXCPU:
        raise Defect(told)
    return result


def sanitized():
    """Whether the command was built with the address sanitizer, which reserves more address space than any limit."""
    return not {"asan", "fuzz"}.isdisjoint(Path(JOSTLE).resolve().parts)


def require_ending(result, *allowed):
    """The exit status is one of those allowed; a refusal is one clear line; errors of sanitizers are found."""
    errors = result.stderr.decode(errors="backslashreplace")
    if b"Sanitizer" in result.stderr or b"runtime error:" in result.stderr:
        raise Defect(f"a sanitizer reports: {errors[:2000]}")
    if result.returncode not in allowed:
        raise Defect(f"exit status {result.returncode}, allowed {allowed}: {errors[:500]}")
    if result.returncode in (BAD_INPUT, DISK):
        require_clear_lines(result.stderr)


def require_clear_lines(stderr):
    """`jostle: ...`, and one line for each further mistake of a scene, with its place; each as `require_clear_line` has it."""
    notices = tuple(notice.encode() for notice in NOTICES)
    lines = [line for line in stderr.split(b"\n") if line and not line.startswith(notices)]
    if not lines or not lines[0].startswith(b"jostle: ") or any(MISTAKE.match(line) is None for line in lines[1:]):
        raise Defect(f"a refusal is not one line, nor one for each mistake: {stderr[:500]!r}")
    for line in lines:
        require_clear_line(line)


def require_clear_line(line):
    """Valid text without control characters, not endless, and more than a name."""
    if not 20 <= len(line) <= 2000:
        raise Defect(f"a refusal of {len(line)} bytes: {line[:200]!r}")
    try:
        text = line.decode()
    except UnicodeDecodeError:
        raise Defect(f"a refusal that is no text: {line[:500]!r}") from None
    if any(ord(sign) < 32 or ord(sign) == 127 for sign in text):
        raise Defect(f"a refusal with control characters: {line[:500]!r}")
