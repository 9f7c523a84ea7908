#!/usr/bin/python3
"""Compares two tables of benchmark_step: benchmarks/ratios.py BEFORE.csv AFTER.csv prints AFTER/BEFORE for each phase.

Rows are matched by state, bodies and threads; rows that only one of the tables has are named. Ratios below 1 are gains.
Take both tables on one machine, in turns if it is shared.
"""

import csv
import sys

KEYS = ("state", "bodies", "threads")


def read(path):
    with open(path, newline="") as file:
        return {tuple(row[key] for key in KEYS): row for row in csv.DictReader(file)}


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.splitlines()[0])
    try:
        before, after = read(sys.argv[1]), read(sys.argv[2])
    except (OSError, KeyError) as error:
        sys.exit(f"ratios.py: cannot read the tables: {error}")
    columns = [name for name in next(iter(after.values()), {}) if name.endswith("_ns")]
    print(",".join((*KEYS, *columns)))
    for key, row in after.items():
        if key in before:
            ratios = [float(row[name]) / max(float(before[key][name]), 1e-9) for name in columns]
            print(",".join((*key, *(f"{ratio:.2f}" for ratio in ratios))))
    for key in sorted(set(before) ^ set(after)):
        print(f"only in one table: {', '.join(key)}", file=sys.stderr)


if __name__ == "__main__":
    main()
