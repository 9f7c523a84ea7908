"""What SECURITY.md says of the program: how it is built, and what it never does."""

import ast
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from jostle_command import DONE, JOSTLE, RODS, command, finish, write_scene

ROOT = Path(__file__).resolve().parents[2]
BINARIES = [Path(shutil.which(JOSTLE) or JOSTLE)]
BINARIES += sorted((BINARIES[0].parents[1] / "python/jostle").glob("_jostle.*.so"))

# Functions of the C library that would open a network, start a shell, or make a file in a shared place.
NEVER = {"socket", "connect", "bind", "listen", "accept", "getaddrinfo", "gethostbyname", "sendto", "sendmsg",
         "system", "popen", "wordexp", "posix_spawn", "posix_spawnp", "execlp", "execvp", "execvpe",
         "tmpfile", "tmpfile64", "tmpnam", "tempnam", "mktemp", "mkstemp", "mkstemp64", "mkdtemp", "shm_open"}


def read_elf(binary, *options):
    return subprocess.run(["readelf", "--wide", *options, binary], check=True, capture_output=True, text=True,
                          timeout=60).stdout


def imported(binary):
    return {line.split()[-1].split("@")[0] if "@" in line.split()[-1] else line.split()[7].split("@")[0]
            for line in read_elf(binary, "--dyn-syms").splitlines() if re.search(r" UND \S", line)}


@pytest.fixture(params=BINARIES, ids=lambda path: path.name)
def binary(request):
    if any(name.startswith(("__asan_", "__tsan_", "__ubsan_")) for name in imported(request.param)):
        pytest.skip("a build with sanitizers has checks of its own")
    return request.param


def test_position_independent(binary):
    assert re.search(r"Type:\s+DYN", read_elf(binary, "--file-header"))
    if ".so" not in binary.name:
        assert re.search(r"\(FLAGS_1\).*\bPIE\b", read_elf(binary, "--dynamic"))


def test_tables_of_functions_are_read_only(binary):
    """Full RELRO: the segment, and every function found when the program is loaded."""
    assert re.search(r"^\s*GNU_RELRO\b", read_elf(binary, "--program-headers"), re.MULTILINE)
    dynamic = read_elf(binary, "--dynamic")
    assert re.search(r"\(FLAGS\).*\bBIND_NOW\b", dynamic) and re.search(r"\(FLAGS_1\).*\bNOW\b", dynamic)


def test_no_memory_can_be_written_and_executed(binary):
    segments = re.findall(r"^\s*(\S+)\s+(?:0x\S+\s+){5}([R ][W ][E ])", read_elf(binary, "--program-headers"), re.MULTILINE)
    assert any(name == "GNU_STACK" for name, _ in segments)
    assert [name for name, flags in segments if "W" in flags and "E" in flags] == []


def test_calls_of_the_c_library_know_the_room(binary):
    """_FORTIFY_SOURCE: calls like printf and memcpy have become those that check."""
    checked = {name for name in imported(binary) if name.endswith("_chk")}
    assert any("printf" in name for name in checked) and len(checked) >= 2, checked


def test_no_network_no_shell_no_temporary_names(binary):
    assert imported(binary) & NEVER == set()


FOREIGN = {"socket", "ssl", "http", "urllib", "ftplib", "smtplib", "requests", "tempfile", "pickle", "shelve", "ctypes"}
PROGRAMS = sorted(ROOT.glob("presentation/*.py")) + sorted(ROOT.glob("python/jostle/*.py"))


@pytest.mark.parametrize("program", PROGRAMS, ids=lambda path: path.name)
def test_python_programs(program):
    """The same of the modules that they import, and of their calls: no shell, nothing made into code."""
    allowed = {"tempfile"} if program.name in ("output_place.py", "report.py") else set()  # only ever beside the output
    for node in ast.walk(ast.parse(program.read_text())):
        if isinstance(node, ast.Import):
            assert not {name.name.split(".")[0] for name in node.names} & (FOREIGN - allowed), program
        elif isinstance(node, ast.ImportFrom):
            assert (node.module or "").split(".")[0] not in FOREIGN - allowed, program
        elif isinstance(node, ast.Call):
            called = ast.unparse(node.func)
            assert called not in ("eval", "exec", "compile", "os.system", "os.popen"), program
            assert not any(keyword.arg == "shell" for keyword in node.keywords), program


def test_a_report_of_a_run_that_goes_on_needs_no_shared_place(torn_copy):
    """It makes a trajectory of what the journal holds so far."""
    (torn_copy / "run/trajectory.h5").unlink(missing_ok=True)
    before = {path.name for path in (torn_copy / "run").iterdir()}
    result = command(torn_copy, "report", "run", "--out", "page", "--width", "100", env={**os.environ, "TMPDIR": "/nowhere"})
    assert result.returncode == DONE and (torn_copy / "page/report.html").exists(), result.stderr
    assert {path.name for path in (torn_copy / "run").iterdir()} == before
    assert not list(torn_copy.glob(".*"))


def test_nothing_is_left_in_shared_places(tmp_path):
    """A run, its exports and its report write to its folder alone; TMPDIR, HOME and the folder from which they start stay
    as they were."""
    work, home = tmp_path / "work", tmp_path / "home"
    for folder in (work, home, tmp_path / "tmp", tmp_path / "start"):
        folder.mkdir()
    write_scene(work, RODS)
    shared = {**os.environ, "TMPDIR": str(tmp_path / "tmp"), "HOME": str(home), "PYTHONDONTWRITEBYTECODE": "1"}
    finish(work)
    before = {path.name for path in Path("/tmp").iterdir()}
    for words in (["export", work / "run", "--to", "xyz"], ["export", work / "run", "--to", "vtk"],
                  ["report", work / "run", "--width", "100"], ["verify", work / "run"]):
        result = command(tmp_path / "start", *words, env=shared)
        assert result.returncode == DONE, result.stderr
    for folder in (tmp_path / "tmp", tmp_path / "start"):
        assert list(folder.iterdir()) == []
    made = {path.name for path in Path("/tmp").iterdir()} - before
    assert not [name for name in made if "povray" in name or "matplotlib" in name or "jostle" in name]
