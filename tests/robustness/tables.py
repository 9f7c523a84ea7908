"""Tables of contacts and bodies for `jostle stress`, CSV and HDF5, damaged in every way: a stress that is finite, or one clear line."""

import json
import shutil

import h5py
import numpy as np

from campaign import Defect, jostle, require_ending
from jostle_command import BAD_INPUT, DONE
from scenes import mutated, refuse_constant

CONTACTS = {"body_1": [0, 1, 2], "body_2": [1, 2, 0], "force_x": [1.0, 0.5, -1.0], "force_y": [0.0, 1.0, 2.0],
            "force_z": [0.1, 0.2, 0.3], "contact_x": [0.5, 1.0, 0.5], "contact_y": [0.0, 0.5, 0.5],
            "contact_z": [0.0, 0.0, 0.0]}
BODIES = {"id": [0, 1, 2], "x": [0.0, 1.0, 1.0], "y": [0.0, 0.0, 1.0], "z": [0.0, 0.0, 0.0],
          "shape": ["sphere", "spherocylinder", "box"], "diameter": [1.0, 1.0, ""], "length": ["", 2.0, ""],
          "axis_x": ["", 1.0, ""], "axis_y": ["", 0.0, ""], "axis_z": ["", 0.0, ""], "edge_x": ["", "", 1.0],
          "edge_y": ["", "", 1.0], "edge_z": ["", "", 2.0]}
ODD_CELLS = ["", "nan", "inf", "-inf", "1e308", "-1e308", "1e-320", "1e31", "x", "\x1b[2J", "0x10", "1,5", "9" * 400, "1e999",
             "-0", "2.5", "99999999999999999999", "sphere", "ellipsoid", "é", "\"", "'", " 1"]
ODD_OPTIONS = [["--box", "4", "4", "4"], ["--box", "1e200", "1e200", "1e200"], ["--box", "1e-120", "1", "1"],
               ["--volume", "64"], ["--volume", "1e-320"], ["--volume", "abc"], ["--volume", "nan"],
               ["--box", "4", "4", "4", "--periodic", ""], ["--box", "4", "4", "4", "--periodic", "xq"],
               ["--convention", "centre_line"], ["--convention", "x\x1b"], ["--per-body", "per_body.csv"], ["--json"]]


def csv(columns):
    rows = zip(*columns.values())
    return "\n".join([",".join(columns)] + [",".join(map(str, row)) for row in rows]) + "\n"


def changed(columns, random):
    """Cells replaced, columns lost, renamed or shortened."""
    columns = {name: list(column) for name, column in columns.items()}
    for _ in range(random.randrange(4)):
        name = random.choice(list(columns))
        how = random.randrange(6)
        if how < 3:
            columns[name][random.randrange(len(columns[name]))] = random.choice(ODD_CELLS)
        elif how == 3:
            del columns[name]
        elif how == 4:
            columns[mutated(name.encode(), random).decode(errors="replace") or "x"] = columns.pop(name)
        else:
            columns[name] = columns[name][:-1] or [1]
        if not columns:
            return {"x": [1]}
    return columns


def write_hdf5(path, columns, random):
    """Damage to HDF5 is to the file's bytes, or a column of another kind than it should be."""
    with h5py.File(path, "w", libver=random.choice(["earliest", "latest"])) as file:
        for name, column in columns.items():
            if "\x00" in name or not name or "/" in name or name in file:
                continue
            if random.random() < 0.04:
                file.create_group(name)
            elif random.random() < 0.04:
                file[name] = random.choice([np.zeros((2, 2)), np.float64(1.0), np.zeros(0), np.array([1j, 2j, 3j])])
            elif all(isinstance(cell, (int, float)) for cell in column):
                file[name] = column
            else:
                file[name] = np.array([str(cell).encode()[:40] for cell in column], dtype="S40")
        if random.random() < 0.3:
            file.attrs["length_unit"] = random.choice([b"um", "um", 1.0, np.zeros(3), "x" * 9000])
    if random.random() < 0.7:
        content = bytearray(path.read_bytes())
        for _ in range(random.randrange(1, 4)):
            content[random.randrange(len(content))] ^= 1 << random.randrange(8)
        path.write_bytes(content)


def cases(random, folder):
    """One pair of tables a case."""
    while True:
        place = folder / "tables"
        shutil.rmtree(place, ignore_errors=True)
        place.mkdir(parents=True)
        names = {}
        for name, columns in (("contacts", CONTACTS), ("bodies", BODIES)):
            columns = changed(columns, random) if random.random() < 0.8 else columns
            if random.random() < 0.5:
                names[name] = f"{name}.h5"
                write_hdf5(place / names[name], columns, random)
            else:
                names[name] = f"{name}.csv"
                content = csv(columns).encode()
                (place / names[name]).write_bytes(mutated(content, random) if random.random() < 0.3 else content)
        options = random.choice(ODD_OPTIONS) if random.random() < 0.6 else []
        yield lambda place=place, names=names, options=options: try_tables(place, names, options)


def try_tables(place, names, options):
    before = {path.name: path.read_bytes() for path in place.iterdir()}
    result = jostle(place, "stress", names["contacts"], "--bodies", names["bodies"], *options)
    if result.returncode == BAD_INPUT:
        require_refusal_by_rows(result)
    else:
        require_ending(result, DONE)
        per_body = place / "per_body.csv"
        if per_body.exists() and (b"nan" in per_body.read_bytes() or b"inf" in per_body.read_bytes()):
            raise Defect("per_body.csv holds a number that is not finite")
        if "--json" in options:
            json.loads(result.stdout, parse_constant=refuse_constant)
        elif b"nan" in result.stdout.replace(b"name", b"") or b" inf" in result.stdout or b"-inf" in result.stdout:
            raise Defect(f"a stress that is not finite, exit status 0: {result.stdout[:300]!r}")
    for name, content in before.items():
        if (place / name).read_bytes() != content:
            raise Defect(f"{name} was changed")


def require_refusal_by_rows(result):
    """Refused rows have a line each: each of them as clear as one alone."""
    if b"Sanitizer" in result.stderr:
        raise Defect(f"a sanitizer reports: {result.stderr[:2000]!r}")
    try:
        text = result.stderr.decode()
    except UnicodeDecodeError:
        raise Defect(f"a refusal that is no text: {result.stderr[:300]!r}") from None
    lines = text.splitlines()
    if not lines or not lines[0].startswith("jostle: ") or len(lines) > 30 or max(map(len, lines)) > 2000:
        raise Defect(f"an unclear refusal: {text[:500]!r}")
    if any(ord(sign) < 32 or ord(sign) == 127 for line in lines for sign in line):
        raise Defect(f"a refusal with control characters: {text[:300]!r}")
