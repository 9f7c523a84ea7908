"""Where `jostle stress --per-body` writes: files whole or not at all, and devices, pipes and links as a shell's > does."""

import os
import stat
import subprocess
import threading

import pytest

from jostle_command import BAD_INPUT, DISK, DONE, JOSTLE, command
from test_full_disk import file_size_limit
from test_stress_command import TWO_SPHERES, write_csv

HEADER = "id,stress_xx,"


@pytest.fixture
def folder(tmp_path):
    for name, columns in TWO_SPHERES.items():
        write_csv(tmp_path / f"{name}.csv", columns)
    return tmp_path


def written_to(folder, place, **options):
    return command(folder, "stress", "contacts.csv", "--bodies", "bodies.csv", "--per-body", place, **options)


def leftovers(folder):
    return [path.name for path in folder.rglob("*.tmp")]


def test_a_file(folder):
    target = folder / "out.csv"
    (folder / "out.csv.tmp").write_text("mine")
    assert written_to(folder, "out.csv").returncode == DONE
    assert target.read_text().startswith(HEADER) and target.read_text().count("\n") == 3
    assert (folder / "out.csv.tmp").read_text() == "mine" and leftovers(folder) == ["out.csv.tmp"]


def test_a_file_keeps_its_permissions(folder):
    target = folder / "out.csv"
    target.write_text("old")
    target.chmod(0o640)
    first = target.stat().st_ino
    assert written_to(folder, "out.csv").returncode == DONE
    assert stat.S_IMODE(target.stat().st_mode) == 0o640 and target.stat().st_ino != first  # replaced, not overwritten


@pytest.mark.parametrize("target, is_there", [("elsewhere/target.csv", True), ("elsewhere/target.csv", False)])
def test_a_link(folder, target, is_there):
    (folder / "elsewhere").mkdir()
    (folder / "middle.csv").symlink_to(target)
    (folder / "link.csv").symlink_to(folder / "middle.csv")
    if is_there:
        (folder / target).write_text("old")
    assert written_to(folder, "link.csv").returncode == DONE
    assert (folder / "link.csv").is_symlink() and (folder / "middle.csv").is_symlink()
    assert (folder / target).read_text().startswith(HEADER) and not (folder / target).is_symlink()
    assert leftovers(folder) == []


def test_links_in_a_ring(folder):
    (folder / "a.csv").symlink_to("b.csv")
    (folder / "b.csv").symlink_to("a.csv")
    result = written_to(folder, "a.csv")
    assert result.returncode == DISK and "symbolic link" in result.stderr


def test_a_pipe(folder):
    os.mkfifo(folder / "pipe")
    read = []
    reader = threading.Thread(target=lambda: read.append((folder / "pipe").read_text()), daemon=True)
    reader.start()
    assert written_to(folder, "pipe").returncode == DONE
    reader.join(timeout=10)
    assert read[0].startswith(HEADER) and stat.S_ISFIFO((folder / "pipe").stat().st_mode)


@pytest.mark.parametrize("name, number", [("null", 3), ("full", 7)])
def test_a_device(folder, name, number):
    device = folder / name
    try:
        os.mknod(device, stat.S_IFCHR | 0o666, os.makedev(1, number))
        open(device, "wb").close()
    except OSError:
        pytest.skip("no devices can be made here")
    result = written_to(folder, name)
    assert result.returncode == (DONE if name == "null" else DISK)
    assert stat.S_ISCHR(device.stat().st_mode) and leftovers(folder) == []


@pytest.mark.parametrize("to_file", [True, False])
def test_standard_output(folder, to_file):
    """The table, then what is printed; also where it goes to a file."""
    (folder / "stdout").symlink_to("/proc/self/fd/1")  # what /dev/stdout is
    words = [JOSTLE, "stress", "contacts.csv", "--bodies", "bodies.csv", "--per-body", "stdout"]
    with open(folder / "out.txt", "w+") as file:
        result = subprocess.run(words, cwd=folder, stdout=file if to_file else subprocess.PIPE, timeout=60, check=True)
        file.seek(0)
        text = file.read() if to_file else result.stdout.decode()
    assert text.startswith(HEADER) and "1 contacts of 2 bodies" in text
    assert (folder / "stdout").is_symlink()


def test_what_cannot_be_written_stays_as_it_was(folder):
    (folder / "sub").mkdir()
    result = written_to(folder, "sub")
    assert result.returncode == BAD_INPUT and "is a folder" in result.stderr
    target = folder / "out.csv"
    target.write_text("old")
    result = written_to(folder, "out.csv", preexec_fn=file_size_limit(20))
    assert result.returncode == DISK and "File too large" in result.stderr and "checkpoint" not in result.stderr
    assert target.read_text() == "old" and leftovers(folder) == []


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write to every file")
def test_a_write_protected_file_stays(folder):
    (folder / "out.csv").write_text("old")
    (folder / "out.csv").chmod(0o444)
    assert written_to(folder, "out.csv").returncode == DISK
    assert (folder / "out.csv").read_text() == "old"
