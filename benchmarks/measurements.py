"""Tables of measurements: the CSV of a machine, one number a row, and what the benchmark programs print, one measurement a row.

A key is (part, case, bodies, threads, quantity): part is one of benchmarks/run, case a state, solver or kernel. Values are numbers,
but for the part "machine".
"""

import csv

COLUMNS = ("part", "case", "bodies", "threads", "quantity", "value")
NAMES_OF_CASE = ("state", "contact_kind", "solver", "kernel", "program")  # columns of printed tables that make up the case


def melted(rows, part):
    """Of printed tables (dictionaries of text), one measurement a row: {key: value}, all text."""
    values = {}
    for row in rows:
        case = ", ".join(row[name] for name in NAMES_OF_CASE if row.get(name))
        for quantity, value in row.items():
            if quantity not in (*NAMES_OF_CASE, "bodies", "threads") and value not in ("", None):
                values[part, case, row.get("bodies", ""), row.get("threads", "1"), quantity] = value
    return values


def read(path):
    """{key: text} of a machine's CSV, or of a table that one of the benchmark programs has printed; ValueError if it is neither."""
    with open(path, newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        rows = list(reader)
        columns = tuple(reader.fieldnames or ())
    if any(None in row or None in row.values() for row in rows):
        raise ValueError(f"{path}: a row is longer or shorter than the header")
    if columns == COLUMNS:
        return {tuple(row[name] for name in COLUMNS[:-1]): row["value"] for row in rows}
    if not any(name in columns for name in NAMES_OF_CASE):
        raise ValueError(f"{path}: no table of measurements: its header is {','.join(columns) or 'empty'}")
    return melted(rows, "")


def write(path, values):
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        writer.writerows((*key, value) for key, value in values.items())


class Machine:
    """Measurements of one machine, by part."""

    def __init__(self, path):
        self.path = path
        self.values = read(path)

    def cases(self, part):
        """(case, bodies, threads) of a part, in order."""
        return list(dict.fromkeys((key[1], int(key[2] or 0), int(key[3])) for key in self.values if key[0] == part))

    def number(self, part, case, quantity, bodies=None, threads=1):
        """The number, or None if it was not measured. Without `bodies`, of the first that fits."""
        for (its_part, its_case, its_bodies, its_threads, its_quantity), value in self.values.items():
            if ((its_part, its_case, its_quantity, int(its_threads)) == (part, case, quantity, threads)
                    and bodies in (None, int(its_bodies or 0))):
                return float(value)
        return None

    def text(self, quantity):
        """Of the part "machine"."""
        return self.values.get(("machine", "", "", "1", quantity), "")
