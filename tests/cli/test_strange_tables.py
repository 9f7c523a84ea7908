"""Tables that no sound program writes: `jostle stress` says in one line what is wrong, and does not fall."""

import shutil
from pathlib import Path

import h5py
import numpy as np
import pytest

from jostle_command import BAD_INPUT, DONE, command, require_one_line
from test_out_of_memory import at_most
from test_stress_command import TWO_SPHERES, XYZ, refusal, stress, write_csv, write_hdf5

INPUTS = Path(__file__).resolve().parent / "inputs"


@pytest.fixture
def folder(tmp_path):
    """CSV and HDF5 tables of two spheres."""
    for name, columns in TWO_SPHERES.items():
        write_csv(tmp_path / f"{name}.csv", columns)
        write_hdf5(tmp_path / f"{name}.h5", columns, length_unit="um")
    return tmp_path


def refused_hdf5(folder, bodies="bodies.h5", **options):
    return command(folder, "stress", "contacts.h5", "--bodies", bodies, **options)


def changed_csv(folder, name, column, value):
    columns = {key: list(values) for key, values in TWO_SPHERES[name].items()}
    columns[column][0] = value
    write_csv(folder / f"{name}.csv", columns)


def test_a_flipped_bit_in_hdf5(folder):
    """In this place Debian's HDF5 reads beyond its memory, and falls."""
    shutil.copy(INPUTS / "bodies_with_a_flipped_bit.h5", folder / "flipped.h5")
    before = sorted(folder.iterdir())
    require_one_line(refused_hdf5(folder, "flipped.h5"), "flipped.h5: the library that reads it failed", "is damaged")
    assert sorted(folder.iterdir()) == before  # no core file


def test_hdf5_in_which_the_library_walks_in_circles(folder):
    shutil.copy(INPUTS / "contacts_without_end.h5", folder / "contacts.h5")
    require_one_line(refused_hdf5(folder), "contacts.h5: the library that reads it failed (signal: CPU time limit exceeded)")


def test_hdf5_where_the_ends_of_children_are_not_waited_for(folder):
    """As under a starter that has SIGCHLD ignored."""
    import signal
    ignore = {"preexec_fn": lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN)}
    assert refused_hdf5(folder, **ignore).returncode == DONE
    shutil.copy(INPUTS / "bodies_with_a_flipped_bit.h5", folder / "flipped.h5")
    require_one_line(refused_hdf5(folder, "flipped.h5", **ignore), "the library that reads it failed")


@pytest.mark.parametrize("chunks", [None, (1000,)])
def test_hdf5_that_claims_more_rows_than_it_holds(folder, chunks):
    with h5py.File(folder / "contacts.h5", "a") as file:
        del file["force_x"]
        file.create_dataset("force_x", shape=(10**12,), dtype="f8", chunks=chunks)
    require_one_line(refused_hdf5(folder), "contacts.h5: cannot take the dataset force_x", "claims 1000000000000 rows")


def test_hdf5_that_holds_more_than_the_memory(folder):
    """In little room on the disk. The advice is not that for a scene."""
    with h5py.File(folder / "contacts.h5", "w") as file:
        for name in TWO_SPHERES["contacts"]:
            file.create_dataset(name, data=np.zeros(4_000_000), chunks=(100_000,), compression="gzip", compression_opts=1)
    result = refused_hdf5(folder, preexec_fn=at_most(200))
    assert (result.returncode, result.stdout) == (1, "")
    assert result.stderr == "jostle: out of memory: the tables hold more than there is room for\n"


def test_hdf5_columns_that_are_something_else(folder):
    """The column is named, and no other file is read."""
    (folder / "raw").write_bytes(np.ones(1).tobytes())
    with h5py.File(folder / "contacts.h5", "r+") as file:
        del file["force_x"]
    sound = (folder / "contacts.h5").read_bytes()

    def refused_with(change, problem):
        (folder / "contacts.h5").write_bytes(sound)
        with h5py.File(folder / "contacts.h5", "r+") as file:
            change(file)
        require_one_line(refused_hdf5(folder), "cannot take the dataset force_x as a column: " + problem)

    def link(path, file="bodies.h5"):
        return h5py.ExternalLink(file, path)

    def soft_link_to_link(file):
        file["there"] = link("/x")
        file["force_x"] = h5py.SoftLink("/there")

    def virtual(file):
        layout = h5py.VirtualLayout((1,), "f8")
        layout[0] = h5py.VirtualSource("bodies.h5", "x", shape=(2,))[0]
        file.create_virtual_dataset("force_x", layout)

    refused_with(lambda file: file.create_group("force_x"), "it is no dataset")
    refused_with(lambda file: file.__setitem__("force_x", link("/x")), "it is a link to another file")
    refused_with(soft_link_to_link, "it leads nowhere")
    refused_with(lambda file: file.__setitem__("force_x", h5py.SoftLink("/nowhere")), "it leads nowhere")
    refused_with(virtual, "its rows lie in another file")
    refused_with(lambda file: file.create_dataset("force_x", (1,), "f8", external="raw"), "its rows lie in another file")
    refused_with(lambda file: file.__setitem__("force_x", [[1.0]]), "it has not one dimension")


@pytest.mark.parametrize("kind", ["csv", "h5"])
@pytest.mark.parametrize("name, column", [("contacts", "force_y"), ("contacts", "contact_x"), ("bodies", "x"),
                                          ("bodies", "diameter")])
def test_numbers_of_absurd_size(folder, kind, name, column):
    """They gave nan with exit 0."""
    columns = {key: list(values) for key, values in TWO_SPHERES[name].items()}
    columns[column][0] = -1e31
    (write_csv if kind == "csv" else write_hdf5)(folder / f"{name}.{kind}", columns)
    result = command(folder, "stress", f"contacts.{kind}", "--bodies", f"bodies.{kind}")
    require_one_line(result, f"{name}.{kind}", f"{column} = -1e+31 is beyond 1e30 in size")


def test_numbers_as_large_and_small_as_may_be(folder):
    changed_csv(folder, "contacts", "force_x", 1e30)
    assert stress(folder, "--box", 1e-30, 1e30, 1e30, "--periodic", "none")["stress"][0][0] == pytest.approx(1.0)
    changed_csv(folder, "contacts", "force_y", 1e-200)  # left by rounding
    assert stress(folder)["stress"][0] == [2.0, pytest.approx(5e-201), 0.0]
    found = stress(folder, "--box", 1e-30, 1e-30, 1e-30, "--periodic", "none")
    assert found["volume"] == pytest.approx(1e-90) and found["stress"][0][0] == pytest.approx(2e90)


def test_bodies_of_absurd_size(folder):
    changed_csv(folder, "bodies", "diameter", 1e-31)
    require_one_line(command(folder, "stress", "contacts.csv", "--bodies", "bodies.csv"), "diameter = 1e-31",
                     "1e-30 to 1e30")


def test_a_stress_beyond_doubles(folder):
    bodies = {key: TWO_SPHERES["bodies"][key] for key in ("id", *XYZ)}
    for element in ("xx", "xy", "xz", "yy", "yz", "zz"):
        bodies[f"second_moment_{element}"] = [1e-310 if element[0] == element[1] else 0.0] * 2
    write_csv(folder / "bodies.csv", bodies)
    require_one_line(command(folder, "stress", "contacts.csv", "--bodies", "bodies.csv"),
                     "stress: is beyond the numbers that a computer can hold")


HOSTILE = b"\x1b[31m\xff\x00 \xc2\x9b\xe2\x80\xae" + b"x" * 5000
SHOWN = "\\x1b[31m\\xff\\x00 \\u009b\\u202exxx"


def require_harmless(text):
    assert all(character == "\n" or character.isprintable() for character in text), ascii(text)
    assert all(len(line) < 1000 for line in text.splitlines())


def output_of(folder, *arguments):
    """Standard error as it is: it must be UTF-8."""
    result = command(folder, "stress", *arguments)
    require_harmless(result.stdout + result.stderr)
    return result


def test_what_tables_say_does_not_reach_the_terminal_as_it_is(folder):
    header, row = (folder / "contacts.csv").read_bytes().splitlines()
    bodies = (folder / "bodies.csv").read_bytes()
    arguments = ("contacts.csv", "--bodies", "bodies.csv")

    (folder / "contacts.csv").write_bytes(header + b"\n" + row[:-3] + HOSTILE + b"\n")  # a cell
    result = output_of(folder, *arguments)
    assert result.returncode == BAD_INPUT and f'"{SHOWN}' in result.stderr

    (folder / "contacts.csv").write_bytes(header.replace(b"force_x", HOSTILE) + b"\n" + row + b"\n")  # a name
    result = output_of(folder, *arguments)
    assert result.returncode == BAD_INPUT and f'"{SHOWN}' in result.stderr

    (folder / "contacts.csv").write_bytes(header + b"," + HOSTILE + b"\n" + row + b",7\n")  # a column passed over
    result = output_of(folder, *arguments)
    assert result.returncode == DONE and SHOWN in result.stdout

    (folder / "contacts.csv").write_bytes(b"# length_unit: " + HOSTILE + b"\n" + header + b"\n" + row + b"\n")  # a unit
    result = output_of(folder, *arguments)
    assert result.returncode == DONE
    result = output_of(folder, *arguments, "--per-body", "per_body.csv", "--force-unit", "N")
    assert (folder / "per_body.csv").read_text().splitlines()[0].startswith(f"# length_unit: {SHOWN}")

    (folder / "bodies.csv").write_bytes(bodies.replace(b"sphere", HOSTILE))  # a word
    (folder / "contacts.csv").write_bytes(header + b"\n" + row + b"\n")
    result = output_of(folder, *arguments)
    assert result.returncode == BAD_INPUT and f'shape = "{SHOWN}' in result.stderr


def test_what_hdf5_says_does_not_reach_the_terminal_as_it_is(folder):
    with h5py.File(folder / "contacts.h5", "a") as file:
        file.create_dataset("a\x1b[31m\nb", data=[1.0])
        file.attrs["length_unit"], file.attrs["force_unit"] = "\x1b]0;owned\x07", "N"
    with h5py.File(folder / "bodies.h5", "a") as file:
        del file.attrs["length_unit"]
    result = output_of(folder, "contacts.h5", "--bodies", "bodies.h5")
    assert result.returncode == DONE
    assert "a\\x1b[31m\\nb" in result.stdout and "\\x1b]0;owned\\x07" in result.stdout


def test_a_table_of_a_thousand_columns(folder):
    write_csv(folder / "contacts.csv", {f"column_{k}": [1] for k in range(1000)})
    message = refusal(folder)
    assert len(message) < 2000 and "and 960 more" in message
