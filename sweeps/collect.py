"""jostle collect: one table of runs that exist.

    collect.py --out=DIR [--plot=NAME ...] --against=KEY -- FOLDER...

Empty --out: the table is printed. Called by the command, which has read the command line.
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "presentation"))

import refusal  # noqa: E402  (the path comes first)
from refusal import Refusal  # noqa: E402

NEEDED = {"numpy": "python3-numpy", "scipy": "python3-scipy"}
NEEDED_TO_DRAW = {"matplotlib": "python3-matplotlib"}


def arguments():
    parser = argparse.ArgumentParser()
    for name in ("out", "against"):
        parser.add_argument(f"--{name}", default="")
    parser.add_argument("--plot", action="append", default=[])
    parser.add_argument("folders", nargs="+")
    return parser.parse_args()


def collect():
    options = arguments()
    import runs_table

    folders = runs_table.run_folders(options.folders)
    keys, scenes = runs_table.differing_keys(folders)
    rows = [{**runs_table.row_of(folder), **{key: scene.get(key, "") for key in [*keys, "seed"]}} for folder, scene in zip(folders, scenes)]
    if len({row["seed"] for row in rows}) > 1:
        keys = [*keys, "seed"]
    if not options.out:
        if options.plot:
            raise Refusal("--plot", "needs a folder for the picture", "Give --out DIR")
        print(runs_table.csv_text(rows, runs_table.columns(rows, keys)), end="")
        return
    refusal.require_modules({**NEEDED, **(NEEDED_TO_DRAW if options.plot else {})})
    import outcome
    from output_place import place, replaced_folder

    outcome.require(options.plot, options.against, keys)
    target = place(options.out, "")
    with replaced_folder(target, is_ours) as folder:
        text = outcome.leave(rows, keys, options.plot, options.against, runs_table.units_of(folders), folder)
    print(text)


def is_ours(folder):
    """Whether the folder holds tables and pictures of them, and nothing else."""
    return (folder / "sweep.csv").exists() and all(path.suffix in (".csv", ".png", ".svg") for path in folder.iterdir())


if __name__ == "__main__":
    raise SystemExit(refusal.exit_status(collect))
